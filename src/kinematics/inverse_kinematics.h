// Inverse kinematics by damped least squares with joint limits, for many targets. Each attempt is a
// Levenberg-Marquardt iteration: steps that do not reduce the error are taken back with more damping
// (Marquardt 1963; of robots: Sugihara, Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt
// method, 2011). Joints at a limit towards which they would go are held. If an attempt ends in a local
// minimum, the next one starts from random positions, which depend on nothing but the options: a target has
// the same solution in every batch.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kinematics/link_kinematics.h"

namespace roboss {

/// What inverse_kinematics() takes.
struct InverseKinematicsOptions {
    Pose X_LT{};  ///< tool frame in the link's frame: what is to reach the target
    /// Weights of the errors along and about x, y, z; 0: this one does not matter.
    std::array<double, 6> weights{1, 1, 1, 1, 1, 1};
    FrameAxes axes = FrameAxes::kWorld;  ///< of the weights; kTool: of the target's frame
    double tolerance = 1e-8;             ///< m and rad, of the errors that matter
    int iterations = 100;                ///< of an attempt, at most
    int attempts = 100;                  ///< at most; the first one begins at `start`
    std::uint64_t seed = 0;              ///< of the random positions
    std::vector<char> moving{};          ///< by RobotModel::axes(): whether it may move; empty: all may
    bool path = false;  ///< the targets are a path: each search after the first starts at the solution before
};

/// How the search for one target ended.
struct InverseKinematicsResult {
    bool success = false;       ///< both errors are within the tolerance
    double position_error = 0,  ///< m, along the axes that matter
        orientation_error = 0;  ///< rad, about the axes that matter
    int iterations = 0,         ///< in all attempts
        attempts = 0;           ///< that were made
};

/// Configurations in which the tool is at the targets.
///
/// targets: rows x 7, m and quaternion x y z w, world. start: rows x q_columns(); empty: the start of the
/// world; beyond limits, it is moved to them; it does not overlap q. A free base stays where `start` has it.
/// Joints that follow others (mimic) do so. Without success, q is the best configuration that was found.
void inverse_kinematics(const RobotModel& robot, LinkId link, const InverseKinematicsOptions& options,
                        std::span<const double> targets, std::span<const double> start, std::span<double> q,
                        std::span<InverseKinematicsResult> results);

}  // namespace roboss
