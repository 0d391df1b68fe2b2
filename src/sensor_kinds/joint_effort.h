// The effort sensor of joints (<roboss:sensor type="joint_effort">): what a torque sensor in the joint reads.
#pragma once

#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What it measures: the mean over the tick that begins at `tick`.
struct JointEffortReading {
    /// By joint: N m about its axis (N along it, of prismatic joints), as it acts on the child link. Motor,
    /// springs, friction and limits together.
    std::vector<double> efforts;
    Tick tick = 0;  ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"efforts", "N m"}, r.efforts);
    }
};

/// Of joints with one axis of the robot that carries it. Noise is drawn for each joint.
struct JointEffortSpec {
    using Reading = JointEffortReading;  ///< what it measures

    JointNames joints;  ///< that it measures
    NoiseSpec noise;    ///< N m, or N

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 51,
                                      .name = "joint_effort",
                                      .phrase = "a joint effort sensor",
                                      .sdf_types = "joint_effort",
                                      .ours = true,
                                      .needs_all_states = true};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joints", "joint"}, s.joints);
        visit({"noise", "noise"}, s.noise);
    }
    /// Compares all members.
    friend bool operator==(const JointEffortSpec&, const JointEffortSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        if (joints.empty()) problems.push_back({"names no <joint>", "Write the joints that it measures."});
    }
};

}  // namespace roboss
