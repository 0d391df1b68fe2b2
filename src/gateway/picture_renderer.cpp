// See picture_renderer.h.
#include "gateway/picture_renderer.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/check.h"
#include "core/float_env.h"
#include "render/camera_scene.h"
#include "visuals/visual_fetch.h"
#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

constexpr std::int64_t kEvery_ms = 100;  // between the beginnings of two sets
constexpr int kNice = 5;                 // the run's threads come first

std::int64_t picture_clock_ms() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::vector<std::uint8_t> picture_message(const CameraPicture& picture, const PictureWish& wish,
                                          const PictureRenderer::Job& job) {
    namespace protocol = viewer_protocol;
    std::vector<std::uint8_t> bytes(protocol::kPictureBytes + picture.about.size() + picture.bytes.size());
    const auto put = [&](std::size_t at, const auto& value) {
        std::memcpy(bytes.data() + at, &value, sizeof(value));
    };
    put(protocol::kPictureKindAt, protocol::kPictureKind);
    put(protocol::kPictureSceneAt, job.scene->number);
    put(protocol::kPictureTickAt, static_cast<double>(job.tick));
    put(protocol::kPictureTimeAt, static_cast<double>(job.tick) * job.scene->model->dt_s);
    put(protocol::kPictureRobotAt, wish.robot.value);
    put(protocol::kPictureSensorAt, wish.sensor);
    put(protocol::kPictureAboutBytesAt, static_cast<std::uint32_t>(picture.about.size()));
    const auto file = std::copy(picture.about.begin(), picture.about.end(),
                                bytes.begin() + static_cast<std::ptrdiff_t>(protocol::kPictureBytes));
    std::copy(picture.bytes.begin(), picture.bytes.end(), file);
    return bytes;
}

std::string no_pictures_line(const Error& error, std::uint32_t scene) {
    using Json = nlohmann::ordered_json;
    return Json{{"type", "no_pictures"}, {"scene", scene}, {"text", error.text()}, {"code", error.code}}.dump(
        -1, ' ', false, Json::error_handler_t::replace);
}

[[noreturn]] void no_camera_asks_for(const std::string& what) {
    check_failed(__FILE__, __LINE__, "the sensor is a camera", "it asks for " + what);
}

}  // namespace

/// What the thread keeps from one set to the next: trees and decoded pictures of the present scene.
struct PictureRenderer::Studio final : SensorSources {
    std::uint32_t scene = 0;
    std::unique_ptr<CameraScene> cameras;
    const Job* job = nullptr;

    RayScene& ray_scene() override { no_camera_asks_for("rays against collision shapes"); }
    StepProbe& step_probe() override { no_camera_asks_for("the next tick"); }
    const RobotState& state_of(RobotId robot) override { return job->states[robot.index()]; }
    Result<const CameraScene*> camera_scene() override { return cameras.get(); }

    Result<> prepare(const Job& next) {
        job = &next;
        if (!cameras || scene != next.scene->number) {
            cameras.reset();
            auto visuals = visual_world(*next.visuals, *next.scene->model);
            if (!visuals) return visuals.error();
            cameras = std::make_unique<CameraScene>(next.scene->model, std::move(visuals).value(), 1u);
            scene = next.scene->number;
        }
        std::vector<const RobotState*> states;
        for (const RobotState& state : next.states) states.push_back(&state);
        cameras->update(states);
        return Ok{};
    }

    /// Tells of each picture when it is done.
    void render(const Job& next, const std::function<void(PictureNews)>& tell) {
        const std::uint32_t number = next.scene->number;
        if (const Result<> prepared = prepare(next); !prepared)
            return tell({number, {}, {}, no_pictures_line(prepared.error(), number)});
        for (const PictureWish& wish : next.wishes) {
            if (!has_camera(*next.scene->model, wish)) continue;
            const SensorQuery query{
                *next.scene->model,    wish.robot, wish.sensor, state_of(wish.robot), next.tick,
                next.scene->file.seed, *this};
            const Result<CameraPicture> picture = take_picture(wish, query);
            if (picture)
                tell({number, wish, picture_message(picture.value(), wish, next), {}});
            else
                tell({number, wish, {}, no_pictures_line(picture.error(), number)});
        }
    }
};

PictureRenderer::PictureRenderer(std::function<void()> bell)
    : bell_(std::move(bell)), thread_([this] { work(); }) {}

PictureRenderer::~PictureRenderer() {
    {
        const std::scoped_lock lock(mutex_);
        ends_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

bool PictureRenderer::is_free() const {
    const std::scoped_lock lock(mutex_);
    return !busy_ && picture_clock_ms() >= free_from_ms_;
}

void PictureRenderer::begin(Job job) {
    {
        const std::scoped_lock lock(mutex_);
        ROBOSS_CHECK(!busy_, "a set of pictures is under way");
        busy_ = true;
        job_ = std::move(job);
    }
    wake_.notify_one();
}

std::vector<PictureNews> PictureRenderer::take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(done_, {});
}

/// After a set it rests as long as the set took: at most half of one processor is used.
void PictureRenderer::work() {
    (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);  // of this thread, on Linux
    const ExactFloatScope exact;
    Studio studio;
    for (;;) {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [this] { return job_ || ends_; });
        if (ends_) return;
        const Job job = *std::exchange(job_, std::nullopt);
        lock.unlock();
        const std::int64_t began_ms = picture_clock_ms();
        studio.render(job, [this](PictureNews news) {
            {
                const std::scoped_lock mine(mutex_);
                done_.push_back(std::move(news));
            }
            bell_();
        });
        const std::int64_t ended_ms = picture_clock_ms();
        lock.lock();
        busy_ = false;
        free_from_ms_ = std::max(began_ms + kEvery_ms, 2 * ended_ms - began_ms);
    }
}

}  // namespace roboss
