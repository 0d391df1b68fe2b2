// See stage.h.
#include "physics/stage.h"

#include <numeric>

namespace roboss {

const char* stage_name(Stage stage) {
    switch (stage) {
        case Stage::kOrders:
            return "orders";
        case Stage::kOnboard:
            return "on-board controllers";
        case Stage::kBroadPhase:
            return "broad phase";
        case Stage::kKinematics:
            return "forward kinematics";
        case Stage::kWaking:
            return "wake sleepers";
        case Stage::kNarrowPhase:
            return "narrow phase";
        case Stage::kIslands:
            return "contact islands";
        case Stage::kRows:
            return "constraint rows";
        case Stage::kVelocities:
            return "solve velocities";
        case Stage::kDisplacements:
            return "solve displacements";
        case Stage::kIntegration:
            return "integrate";
        case Stage::kGuards:
            return "guards";
        case Stage::kSleep:
            return "put to sleep";
        case Stage::kReport:
            return "report";
    }
    return "";
}

std::uint64_t StageTimes::sum() const {
    return std::accumulate(ns.begin(), ns.end(), std::uint64_t{0});
}

StageTimes& StageTimes::operator+=(const StageTimes& other) {
    for (std::size_t i = 0; i < kStages; ++i) ns[i] += other.ns[i];
    return *this;
}

void StageClock::take_up(Stage stage) {
    const std::uint64_t now_ns = now_();
    times_->ns[static_cast<std::size_t>(stage_)] += now_ns - since_ns_;
    since_ns_ = now_ns;
    stage_ = stage;
}

}  // namespace roboss
