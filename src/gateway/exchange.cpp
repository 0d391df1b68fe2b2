// Everything under one mutex, held for moves only.
#include "gateway/exchange.h"

#include <algorithm>
#include <utility>

namespace roboss {

bool needs_everybody(const Model& model, RobotId robot) {
    constexpr std::size_t kSmallWorld = 100;  // robots
    const std::vector<SensorInfo>& sensors = model.type_of(robot).sensors;
    return model.robots.size() <= kSmallWorld ||
           std::any_of(sensors.begin(), sensors.end(),
                       [](const SensorInfo& s) { return s.spec.kind().needs_all_states; });
}

namespace {

constexpr std::size_t kCallsMax = 2'000, kLinesMax = 10'000;

}  // namespace

void Exchange::set_bell(std::function<void()> bell) {
    const std::scoped_lock lock(mutex_);
    bell_ = std::move(bell);
}

News Exchange::take_news() {
    const std::scoped_lock lock(mutex_);
    rung_ = false;
    News news{std::exchange(scene_, nullptr),
              std::exchange(visuals_, std::nullopt),
              {},
              std::exchange(exact_, {}),
              std::exchange(lines_, {})};
    for (auto& [sender, views] : std::exchange(views_, {})) news.views.push_back(std::move(views));
    return news;
}

void Exchange::watch(const WatchRequest& request) {
    const std::scoped_lock lock(mutex_);
    if (watch_request_ == request) return;
    watch_request_ = request;
    stirred_.store(true, std::memory_order_release);
}

bool Exchange::call(PageCall call) {
    const std::scoped_lock lock(mutex_);
    if (calls_.size() >= kCallsMax) return false;
    calls_.push_back(std::move(call));
    stirred_.store(true, std::memory_order_release);
    return true;
}

WatchRequest Exchange::take_watch_request() {
    const std::scoped_lock lock(mutex_);
    stirred_.store(false, std::memory_order_release);
    return watch_request_;
}

std::vector<PageCall> Exchange::take_calls() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(calls_, {});
}

void Exchange::ring(std::unique_lock<std::mutex>& lock) {
    if (rung_ || !bell_) return;
    rung_ = true;
    const std::function<void()> bell = bell_;
    lock.unlock();
    bell();
}

void Exchange::show(std::shared_ptr<const ShownScene> scene) {
    std::unique_lock lock(mutex_);
    scene_ = std::move(scene);
    visuals_.reset();
    views_.clear();
    exact_.clear();
    ring(lock);
}

void Exchange::show(ShownVisuals visuals) {
    std::unique_lock lock(mutex_);
    visuals_ = std::move(visuals);
    ring(lock);
}

void Exchange::show(const Address& sender, ViewStates views) {
    std::unique_lock lock(mutex_);
    views_[sender] = std::move(views);
    ring(lock);
}

void Exchange::show(StateBlock exact) {
    std::unique_lock lock(mutex_);
    if (!exact_.empty() && exact_.front().tick != exact.tick) exact_.clear();
    exact_.push_back(std::move(exact));
    ring(lock);
}

void Exchange::send(Line line) {
    std::unique_lock lock(mutex_);
    if (lines_.size() >= kLinesMax) return;
    lines_.push_back(std::move(line));
    ring(lock);
}

}  // namespace roboss
