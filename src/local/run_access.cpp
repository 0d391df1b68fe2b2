// See run_access.h.
#include "local/run_access.h"

#include <utility>

#include "render/view.h"

namespace roboss {

RunAccess::RunAccess(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

RunAccess::~RunAccess() = default;

std::uint64_t RunAccess::hash() const {
    std::vector<std::uint64_t> hashes;
    for (std::size_t r = 0; r < states().size(); ++r)
        hashes.push_back(state_hash(RobotId(r), tick(), states()[r]));
    return world_hash(model_->hash, hashes);
}

Result<Sample> RunAccess::read(RobotId robot, std::size_t sensor) {
    if (robot.index() >= states().size())
        return Error{"there is no robot number " + std::to_string(robot.value),
                     "the world has " + std::to_string(states().size()), "no-robot"};
    return measure({*model_, robot, sensor, state(robot), tick(), seed(), *this});
}

Result<std::vector<RadioMessage>> RunAccess::received(RobotId robot, std::size_t sensor) {
    if (robot.index() >= states().size()) return read(robot, sensor).error();
    Tick& until = heard_.try_emplace({robot, sensor}, heard_from_).first->second;
    const Tick since = std::exchange(until, tick());
    return receive({*model_, robot, sensor, state(robot), tick(), seed(), *this, since});
}

std::vector<Result<Sample>> RunAccess::read_all(std::span<const std::uint32_t> robots,
                                                std::span<const std::size_t> sensors) {
    ROBOSS_CHECK(robots.size() == sensors.size(), std::to_string(sensors.size()) + " sensors");
    std::vector<SensorQuery> queries;
    for (std::size_t i = 0; i < robots.size(); ++i) {
        const RobotId robot(robots[i]);
        if (robot.index() >= states().size()) return {read(robot, sensors[i])};
        queries.push_back({*model_, robot, sensors[i], state(robot), tick(), seed(), *this});
    }
    return measure_all(queries);
}

std::vector<const RobotState*> RunAccess::pointers() const {
    std::vector<const RobotState*> all;
    for (const RobotState& state : states()) all.push_back(&state);
    return all;
}

RayScene& RunAccess::ray_scene() {
    if (!rays_) rays_ = std::make_unique<RayScene>(model_), rays_->set_threads(ray_threads());
    if (!rays_are_new_) {  // once made, several threads may ask (measure_all)
        rays_->update(pointers());
        rays_are_new_ = true;
    }
    return *rays_;
}

void RunAccess::set_visuals(render::VisualsOf visuals, unsigned threads) {
    visuals_ = std::move(visuals);
    camera_threads_ = threads;
    cameras_.reset();
    cameras_are_new_ = false;
}

Result<const CameraScene*> RunAccess::camera_scene() {
    if (!visuals_) return SensorSources::camera_scene();
    if (!cameras_) {
        auto made = make_camera_scene(visuals_, model_, camera_threads_);
        if (!made) return made.error();
        cameras_ = std::move(made).value();
    }
    if (!cameras_are_new_) cameras_->update(pointers());
    cameras_are_new_ = true;
    return cameras_.get();
}

Result<Image<std::uint8_t>> RunAccess::picture(const Transform& X_WC, const CameraOptics& optics) {
    const Result<const CameraScene*> scene = camera_scene();
    if (!scene) return scene.error();
    return render::picture(*scene.value(), {X_WC, optics, {}});
}

StepProbe& RunAccess::step_probe() {
    if (!probe_) probe_ = std::make_unique<StepProbe>(*model_);
    if (!probe_is_new_) probe_->step(tick(), pointers());
    probe_is_new_ = true;
    return *probe_;
}

}  // namespace roboss
