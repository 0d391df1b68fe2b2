// The stages of a tick (tick.h has their order), and how long each takes. The step itself reads no clock: it
// is given one where a run is profiled.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace roboss {

enum class Stage : std::uint8_t {
    kOrders,         // orders of the tick change states
    kOnboard,        // on-board controllers
    kBroadPhase,     // which robots may meet; pairs of robots whose bounds overlap
    kKinematics,     // poses, velocities, shapes and interaction bounds
    kWaking,         // of sleepers
    kNarrowPhase,    // contacts and near misses
    kIslands,        // contact islands
    kRows,           // mass matrices and constraint rows
    kVelocities,     // the solver
    kDisplacements,  // of the tick, where they are not the velocities
    kIntegration,    // coordinates and velocities move
    kGuards,         // of momentum, energy and late penetration
    kSleep,          // what has been at rest falls asleep
    kReport,         // impulses for the next tick, counts, states that are not finite
};
inline constexpr std::size_t kStages = 14;

/// As profiles print it: "forward kinematics".
const char* stage_name(Stage stage);

/// Time by stage, ns.
struct StageTimes {
    std::array<std::uint64_t, kStages> ns{};

    std::uint64_t of(Stage stage) const { return ns[static_cast<std::size_t>(stage)]; }
    std::uint64_t sum() const;
    StageTimes& operator+=(const StageTimes& other);
    bool operator==(const StageTimes&) const = default;
};

using StageNow = std::uint64_t (*)();  // a monotone time in ns

/// Attributes the time of one call of step_island to stages: each lasts until the next begins. Costs one
/// reading of the clock a stage, or one predicted branch if it is off.
class StageClock {
  public:
    void start(StageNow now, StageTimes& times) {
        now_ = now, times_ = &times;
        if (now_ != nullptr) since_ns_ = now_();
    }
    [[gnu::always_inline]] void enter(Stage stage) {
        if (now_ != nullptr) [[unlikely]]
            take_up(stage);
    }
    bool is_on() const { return now_ != nullptr; }
    void stop() {
        if (now_ != nullptr) take_up(Stage::kOrders);
        now_ = nullptr, times_ = nullptr;
    }

  private:
    void take_up(Stage stage);  // out of line: lanes call it, too

    StageNow now_ = nullptr;
    StageTimes* times_ = nullptr;
    Stage stage_ = Stage::kOrders;
    std::uint64_t since_ns_ = 0;
};

}  // namespace roboss
