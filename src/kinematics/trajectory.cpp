// See trajectory.h.
#include "kinematics/trajectory.h"

#include <algorithm>
#include <string>

#include "core/check.h"
#include "math/array_rows.h"

namespace roboss {
namespace {

struct Sample {
    double x = 0, v = 0, a = 0;
};

/// The share s of the time that has passed, 0 to 1, and how long all of it lasts.
struct Clock {
    explicit Clock(std::span<const double> times)
        : start(times.front()), duration(times.back() - times.front()) {
        ROBOSS_CHECK(duration > 0, std::to_string(duration) + " s");
    }
    double share(double time) const { return std::clamp((time - start) / duration, 0.0, 1.0); }
    double start, duration;  // s
};

/// x0 + h0 s + c3 s^3 + c4 s^4 + c5 s^5, where h = v duration: the only quintic with x0, v0 and no
/// acceleration at s = 0 and with x1, v1 and no acceleration at s = 1.
Sample quintic(double x0, double x1, double v0, double v1, double s, double duration) {
    const double d = x1 - x0, h0 = v0 * duration, h1 = v1 * duration;
    const double c3 = 10 * d - 6 * h0 - 4 * h1, c4 = -15 * d + 8 * h0 + 7 * h1, c5 = 6 * d - 3 * h0 - 3 * h1;
    return {x0 + s * (h0 + s * s * (c3 + s * (c4 + s * c5))),
            (h0 + s * s * (3 * c3 + s * (4 * c4 + s * 5 * c5))) / duration,
            s * (6 * c3 + s * (12 * c4 + s * 20 * c5)) / (duration * duration)};
}

/// A way of 1 with a speed that rises, stays and falls.
Sample trapezoid(double s, double ramp) {
    const double speed = 1 / (1 - ramp);
    if (s < ramp) return {0.5 * speed * s * s / ramp, speed * s / ramp};
    if (s <= 1 - ramp) return {speed * (s - 0.5 * ramp), speed};
    return {1 - 0.5 * speed * (1 - s) * (1 - s) / ramp, speed * (1 - s) / ramp};
}

}  // namespace

void joint_trajectory(const JointMotion& motion, std::span<const double> times, const JointSamples& out) {
    const std::size_t columns = motion.q0.size(), size = times.size() * columns;
    ROBOSS_CHECK(
        motion.q1.size() == columns && out.q.size() == size && out.v.size() == size && out.a.size() == size,
        std::to_string(columns) + " columns");
    const Clock clock(times);
    for (std::size_t t = 0; t < times.size(); ++t) {
        const double s = clock.share(times[t]);
        for (std::size_t c = 0; c < columns; ++c) {
            const Sample at = quintic(motion.q0[c], motion.q1[c], motion.v0.empty() ? 0.0 : motion.v0[c],
                                      motion.v1.empty() ? 0.0 : motion.v1[c], s, clock.duration);
            out.q[t * columns + c] = at.x, out.v[t * columns + c] = at.v, out.a[t * columns + c] = at.a;
        }
    }
}

void cartesian_trajectory(const Pose& X0, const Pose& X1, double ramp, std::span<const double> times,
                          std::span<double> poses, std::span<double> twists) {
    ROBOSS_CHECK(ramp >= 0 && ramp <= 0.5, std::to_string(ramp));
    ROBOSS_CHECK(poses.size() == times.size() * 7 && twists.size() == times.size() * 6,
                 std::to_string(times.size()));
    const Clock clock(times);
    const Vec3 way = X1.p - X0.p, turn = logarithm(X1.q * conjugate(X0.q));
    for (std::size_t t = 0; t < times.size(); ++t) {
        const Sample at = trapezoid(clock.share(times[t]), ramp);
        const Vec3 p = X0.p + way * at.x, v = way * (at.v / clock.duration),
                   w = turn * (at.v / clock.duration);
        const Quat q = normalized(exponential(turn * at.x) * X0.q);
        put_row(Pose{p, q}, &poses[t * 7]);
        put_row(v, w, &twists[t * 6]);
    }
}

}  // namespace roboss
