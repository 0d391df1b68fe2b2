#include "cell.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/fixed_math.h"

namespace arm_cell {
namespace {

constexpr double kTravel = kBeltTop + 0.13;  // m, of the hand's tip: a box in it passes over those on belts
constexpr double kFingertips = 0.008;        // m, above the belt when they close
constexpr double kCupGap = 0.002;            // m, between the cup and the box when it begins to suck
constexpr double kRelease = 0.002;           // m, above the belt at which a box is let go
constexpr double kEyeHeight = 0.09;          // m, above the tip
constexpr double kSettle = 0.30;             // s, until what lies on a stopped belt rests
constexpr double kCloseTime = 0.25, kOpenTime = 0.15;  // s
constexpr double kThinnest = 0.015;                    // m, of a finger's opening when a box is between them
constexpr double kBlind = 0.05;      // s without seeing the box after which it counts as dropped
constexpr double kGain = 8;          // 1/s, of the joints' position errors
constexpr double kAtTarget = 0.002;  // rad or m

}  // namespace

Joints Cell::rest() {
    return *inverse({0.38, 0.12, kTravel, 0}, 0);
}

void Cell::enter(Phase phase, double time_s) {
    state.phase = phase;
    state.phase_since = time_s;
}

bool Cell::start(Phase phase, const HandPose& pose, const Readings& readings) {
    const auto goal = inverse(pose, phase == Phase::kReach ? 0 : state.motion.to[3]);
    if (!goal) return false;
    state.motion = motion(state.motion.to, *goal, readings.time_s + kPeriod);
    enter(phase, readings.time_s);
    return true;
}

bool Cell::arrived(const Readings& readings) const {
    if (readings.time_s < state.motion.end_s()) return false;
    for (std::size_t i = 0; i < readings.q.size(); ++i)
        if (std::fabs(readings.q[i] - state.motion.to[i]) > kAtTarget) return false;
    return true;
}

/// Of the tip when the hand takes the box from the belt.
double Cell::grip_height() const {
    return gripper_ == Gripper::kFingers ? kBeltTop + kFingertips : state.box.top + kCupGap;
}

bool Cell::holds(const Readings& readings) const {
    if (gripper_ == Gripper::kSuction) return readings.eye < kEyeHeight + 2 * kCupGap + 0.002;
    return readings.opening > kThinnest && readings.eye < kEyeHeight - 0.03;
}

bool Cell::closes() const {
    switch (state.phase) {
        case Phase::kClose:
        case Phase::kLift:
        case Phase::kCarry:
        case Phase::kSetDown:
            return true;
        default:
            return false;
    }
}

bool Cell::wants_scan(double time_s) const {
    return state.phase == Phase::kIdle && state.belt == Belt::kStopped && time_s >= state.motion.end_s();
}

bool Cell::wants_touch(double time_s) const {
    return gripper_ == Gripper::kFingers && state.phase == Phase::kClose &&
           time_s - state.phase_since >= kCloseTime;
}

void Cell::move_belt(const Readings& readings) {
    const auto change = [&](Belt belt) { state.belt = belt, state.belt_since = readings.time_s; };
    if (state.belt == Belt::kRuns && readings.barrier_broken) change(Belt::kStopping);
    if (state.belt == Belt::kStopping && readings.time_s - state.belt_since >= kSettle)
        change(Belt::kStopped);
    if (state.belt == Belt::kDiscards && !readings.barrier_broken) change(Belt::kRuns);
}

/// In Idle: fetches the box that the scanner sees, or goes to where the arm waits.
void Cell::decide(const Readings& readings, const std::optional<SeenBox>& seen) {
    if (wants_scan(readings.time_s)) {
        if (seen) state.box = *seen;
        if (seen && start(Phase::kReach, {seen->x, seen->y, kTravel, seen->yaw}, readings)) return;
        ++state.discarded;
        state.belt = Belt::kDiscards;
    }
    const bool waits = state.motion.to == rest();
    if (!waits && state.belt != Belt::kStopped && arrived(readings))
        state.motion = motion(state.motion.to, rest(), readings.time_s + kPeriod);
}

void Cell::put_down(double time_s) {
    ++state.moved;
    if (state.last_moved >= 0) {
        const double cycle = time_s - state.last_moved;
        state.cycle_sum += cycle;
        state.cycle_least = std::min(state.cycle_least, cycle);
        state.cycle_most = std::max(state.cycle_most, cycle);
    }
    state.last_moved = time_s;
}

/// From a phase that is over to the next one. Targets after Reach are within reach: they lie below and above
/// it, or on the out belt.
void Cell::leave(const Readings& readings, bool touched) {
    const SeenBox& box = state.box;
    const double time_s = readings.time_s;
    switch (state.phase) {
        case Phase::kReach:
            start(Phase::kLower, {box.x, box.y, grip_height(), box.yaw}, readings);
            return;
        case Phase::kLower:
            enter(Phase::kClose, time_s);
            return;
        case Phase::kClose:
            state.felt = time_s;
            if (holds(readings) && touched) {
                start(Phase::kLift, {box.x, box.y, kTravel + (grip_height() - kBeltTop), box.yaw}, readings);
            } else {
                ++state.missed;
                enter(Phase::kOpen, time_s);
            }
            return;
        case Phase::kLift:
            state.belt = Belt::kRuns;
            start(Phase::kCarry, {kPlaceX, -kBeltAside, state.motion.to[2] + kTipHeight, 0}, readings);
            return;
        case Phase::kCarry:
            start(Phase::kSetDown, {kPlaceX, -kBeltAside, grip_height() + kRelease, 0}, readings);
            return;
        case Phase::kSetDown:
            if (holds(readings))
                put_down(time_s);
            else
                ++state.dropped;
            enter(Phase::kOpen, time_s);
            return;
        case Phase::kOpen: {
            const HandPose here = forward(state.motion.to);
            start(Phase::kRise, {here.x, here.y, kTravel, here.yaw}, readings);
            return;
        }
        case Phase::kRise:
            enter(Phase::kIdle, time_s);
            return;
        case Phase::kIdle:
            return;
    }
}

void Cell::move_arm(const Readings& readings, const std::optional<SeenBox>& seen, bool touched) {
    const double time_s = readings.time_s, in_phase = time_s - state.phase_since;
    if (state.phase == Phase::kIdle) return decide(readings, seen);
    const bool carries = closes() && state.phase != Phase::kClose;
    if (carries && holds(readings)) state.felt = time_s;
    if (carries && time_s - state.felt > kBlind && arrived(readings)) {
        ++state.dropped;
        state.belt = state.phase == Phase::kLift ? Belt::kRuns : state.belt;
        return enter(Phase::kOpen, time_s);
    }
    const bool over = state.phase == Phase::kClose  ? in_phase >= kCloseTime
                      : state.phase == Phase::kOpen ? in_phase >= kOpenTime
                                                    : arrived(readings);
    if (over) leave(readings, touched);
}

Orders Cell::step(const Readings& readings, const std::optional<SeenBox>& seen, bool touched) {
    // First the belt if it looks at the light barrier, and the arm in the state that the wants_...() looked
    // at.
    const bool sees_barrier = wants_barrier();
    move_arm(readings, seen, touched);
    if (sees_barrier || state.belt == Belt::kStopping) move_belt(readings);
    Orders orders;
    // They act from one period later, for one period.
    const double time_s = readings.time_s;
    const Joints now = state.motion.at(time_s), first = state.motion.at(time_s + kPeriod),
                 last = state.motion.at(time_s + 2 * kPeriod);
    for (std::size_t i = 0; i < now.size(); ++i)
        orders.velocity[i] = (last[i] - first[i]) / kPeriod + kGain * (now[i] - readings.q[i]);
    orders.belt_runs = state.belt == Belt::kRuns || state.belt == Belt::kDiscards;
    orders.hand_closes = closes();
    return orders;
}

std::string summary(const CellState& state) {
    char text[240];
    const int cycles = state.moved - 1;
    std::snprintf(
        text, sizeof text,
        "\"moved\": %d, \"dropped\": %d, \"missed\": %d, \"discarded\": %d, \"cycle_s\": {\"mean\": %.3f, "
        "\"least\": %.3f, \"most\": %.3f}",
        state.moved, state.dropped, state.missed, state.discarded,
        cycles > 0 ? state.cycle_sum / cycles : 0.0, cycles > 0 ? state.cycle_least : 0.0, state.cycle_most);
    return text;
}

}  // namespace arm_cell
