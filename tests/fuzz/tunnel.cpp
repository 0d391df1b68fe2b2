// Property: nothing passes through anything. Three signs that it did: the way of a tick leads deep through
// another shape and nothing was felt; two shapes swapped sides in a tick; something is behind a wall.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "fuzz/property.h"
#include "fuzz/shot.h"
#include "fuzz/swept.h"

namespace roboss::fuzz {
namespace {

constexpr double kFelt = 2e-3;   // m: a hit that is deeper must be felt
constexpr double kSlack = 1e-3;  // m: of a path that is straight within a tick where the true one has a kink

/// Keeps the worst of the signs; each is relative to what is allowed.
class Judge {
  public:
    void see(double relative, Tick tick, const char* text, double metres) {
        if (!(relative > finding.figure)) return;
        finding.figure = relative, finding.tick = tick, finding.failed = relative > 1;
        char buffer[120];
        std::snprintf(buffer, sizeof buffer, "%s, %.3g mm; relative to what is allowed:", text, 1e3 * metres);
        finding.text = buffer;
    }
    Finding finding;
};

Vec3 centre_of(const RobotState& state) {
    return base_pose(state).p;
}

/// How far the last robot is behind the wall, m; negative: in front of it, or beside its extent.
double behind(const Wall& wall, const std::vector<RobotState>& states) {
    Pose X_WP = wall.X_WP;
    if (wall.robot.valid()) X_WP = base_pose(states[wall.robot.index()]);
    const Vec3 at = rotate(conjugate(X_WP.q), centre_of(states.back()) - X_WP.p);
    if (std::fmax(std::fabs(at.y), std::fabs(at.z)) > wall.half_extent) return -1;
    return at.x;
}

/// How far any robot is outside of the room, m.
double outside(double room, const std::vector<RobotState>& states) {
    double most = -room;
    for (const RobotState& state : states) {
        const Vec3 p = centre_of(state);
        most = std::fmax(most, std::fmax(std::fabs(p.x), std::fmax(std::fabs(p.y), std::fabs(p.z))) - room);
    }
    return most;
}

void judge_sides(const Flight& flight, Judge& judge) {
    constexpr double kThrough = 0.005;  // m: half of a wall of 1 cm
    const Shot& shot = flight.shot();
    if (shot.wall) {
        const double way = behind(*shot.wall, flight.states());
        if (way > 0) judge.see(1 + way / kThrough, flight.tick(), "behind the wall", way);
    }
    if (shot.room) {
        const double way = outside(*shot.room, flight.states());
        judge.see(way / kThrough, flight.tick(), "out of the room", way);
    }
}

double overlap_of(SweptDistance& swept) {
    constexpr double kDeep = -1, kResolution = 5e-4;  // m
    return -swept.least_gap(kDeep, kResolution);
}

/// Two signs in the way of the last tick. What turns further in it than the ranges of the engine say is left
/// to judge_sides: a path between two states is not the one that was taken, and the fine one is too coarse.
void judge_ways(const Flight& flight, SweptDistance& swept, Judge& judge) {
    constexpr double kTurnMost = 0.5;  // rad
    const double before = flight.turn(flight.before());
    if (std::fmax(before, flight.turn(flight.states())) < kTurnMost) {
        swept.clear();
        swept.add_between(flight.before(), flight.states(), Flight::kFine);
        const double overlap = overlap_of(swept);
        if (overlap > 0)
            judge.see(overlap / (0.5 * swept.least_width() + kSlack), flight.tick(), "deep interpenetration",
                      overlap);
    }
    if (flight.change() != 0 || before > Flight::kTurnMost) return;
    // Who begins the tick in an overlap may well leave it without an impulse.
    swept.clear();
    swept.add_between(flight.before(), flight.before(), 1);
    const double at_first = std::fmax(0.0, overlap_of(swept));
    swept.clear();
    for (const std::vector<RobotState>& states : flight.fine_way()) swept.add(states);
    const double missed = overlap_of(swept) - at_first;
    if (missed > 0) judge.see(missed / kFelt, flight.tick(), "an impact had no effect", missed);
}

}  // namespace

Finding run_tunnel(const Request& request) {
    Flight flight(request.setting);
    SweptDistance swept(flight.model(), flight.shot().stand_ins);
    Judge judge;
    while (!flight.over()) {
        flight.step();
        if (!flight.finite())
            return {true, std::numeric_limits<double>::infinity(), flight.tick(), "not finite"};
        judge_sides(flight, judge);
        if (flight.shot().has_oracle) judge_ways(flight, swept, judge);
        if (!request.print_line) continue;
        const Vec3 p = centre_of(flight.states().back());
        char buffer[160];
        std::snprintf(buffer, sizeof buffer,
                      "%6lld  last robot at %.5f %.5f %.5f  change of velocity %-10.4g worst %-8.3g",
                      static_cast<long long>(flight.tick()), p.x, p.y, p.z, flight.change(),
                      judge.finding.figure);
        request.print_line(buffer);
    }
    return judge.finding;
}

}  // namespace roboss::fuzz
