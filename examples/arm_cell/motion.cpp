#include "motion.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"

namespace arm_cell {

HandPose forward(const Joints& q) {
    const double both = q[0] + q[1];
    return {kUpperArm * roboss::fixed_cos(q[0]) + kForearm * roboss::fixed_cos(both),
            kUpperArm * roboss::fixed_sin(q[0]) + kForearm * roboss::fixed_sin(both), kTipHeight + q[2],
            roboss::wrap_angle(both + q[3])};
}

// The triangle of both arms and the line from shoulder to hand: law of cosines (Craig, Introduction to
// Robotics, 2005, section 4.4).
std::optional<Joints> inverse(const HandPose& pose, double wrist) {
    const double square = pose.x * pose.x + pose.y * pose.y;
    const double cosine = (square - kUpperArm * kUpperArm - kForearm * kForearm) / (2 * kUpperArm * kForearm);
    const double lift = pose.z - kTipHeight;
    if (!(std::fabs(cosine) <= 1) || lift > 0 || lift < -kLiftStroke) return std::nullopt;
    const double sine = std::sqrt(1 - cosine * cosine);
    const double elbow = roboss::fixed_atan2(sine, cosine);
    const double shoulder =
        roboss::wrap_angle(roboss::fixed_atan2(pose.y, pose.x) -
                           roboss::fixed_atan2(kForearm * sine, kUpperArm + kForearm * cosine));
    if (elbow > kElbowLimit || std::fabs(shoulder) > kShoulderLimit) return std::nullopt;
    double turn = pose.yaw - shoulder - elbow;
    turn += roboss::kPi * std::round((wrist - turn) / roboss::kPi);
    while (turn > kWristLimit) turn -= roboss::kPi;
    while (turn < -kWristLimit) turn += roboss::kPi;
    return Joints{shoulder, elbow, lift, turn};
}

// s(u) = 10 u^3 - 15 u^4 + 6 u^5 has its largest slope at the middle, 15/8, and its largest second derivative
// at u = (3 - sqrt 3) / 6, 10 / sqrt 3.
Motion motion(const Joints& from, const Joints& to, double begin_s) {
    Motion result{from, to, begin_s, 0};
    for (std::size_t i = 0; i < from.size(); ++i) {
        const double way = std::fabs(to[i] - from[i]);
        result.length_s = std::max({result.length_s, 1.875 * way / kJointLimits[i].velocity,
                                    std::sqrt(5.773502691896258 * way / kJointLimits[i].acceleration)});
    }
    return result;
}

Joints Motion::at(double time_s) const {
    if (time_s >= end_s()) return to;
    const double u = std::max(0.0, (time_s - begin_s) / length_s);
    const double share = u * u * u * (10 + u * (6 * u - 15));
    Joints q = from;
    for (std::size_t i = 0; i < q.size(); ++i) q[i] += share * (to[i] - from[i]);
    return q;
}

}  // namespace arm_cell
