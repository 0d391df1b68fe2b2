// RobotSet: some robots of a run as arrays, robots the first axis; what bindings to array languages
// need. Arrays are rows of doubles, one row a robot, in the order of the set. SI units and radians, world
// axes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "local/run_access.h"
#include "local/shared_parts.h"

namespace roboss {

/// See the top of the file. A call that sets or orders something does it for all robots, or, if one of them
/// refuses, for none.
class RobotSet {
  public:
    static constexpr std::size_t kPoseColumns = 7,  ///< x y z, quaternion x y z w
        kTwistColumns = 6,                          ///< linear x y z, angular x y z
        kEnergyColumns = 2;                         ///< kinetic, potential

    /// `robots` must exist in the model.
    RobotSet(std::shared_ptr<const Model> model, std::vector<RobotId> robots);

    std::size_t size() const { return robots_.size(); }             ///< rows
    const std::vector<RobotId>& robots() const { return robots_; }  ///< by row
    const Model& model() const { return *model_; }                  ///< of the robots
    /// The facts that all robots share; joints, links, sensors and commands are counted by it.
    const SharedParts& shared() const { return shared_; }
    /// Columns of the arrays of joints: each axis of each joint that moves, in the order of the first robot's
    /// file.
    const std::vector<SharedPart>& axes() const { return shared_.axes; }
    /// The numbers of those columns in the robot of a row.
    const std::vector<JointAxis>& axes_of_row(std::size_t row) const {
        return shared_.axes_of_types[shared_.type_of_row[row]];
    }
    /// The RobotType of the robot of a row.
    const RobotType& type_of_row(std::size_t row) const { return *shared_.types[shared_.type_of_row[row]]; }

    /// Poses of the robot (SDF model) frames in the world, size() x kPoseColumns: m, unit quaternions.
    void poses(const RunAccess& run, std::span<double> out) const;
    /// Velocities of the bases, size() x kTwistColumns: m/s of the base's origin, rad/s. Zero where the base
    /// is fixed.
    void twists(const RunAccess& run, std::span<double> out) const;
    /// Poses of a link's frame of each robot in the world, as poses().
    void link_poses(const RunAccess& run, std::size_t link, std::span<double> out) const;
    /// Velocities of a link's frame at its origin, as twists().
    void link_twists(const RunAccess& run, std::size_t link, std::span<double> out) const;
    /// Positions of the joints, size() x axes(): rad or m.
    void joint_positions(const RunAccess& run, std::span<double> out) const;
    /// Velocities of the joints, size() x axes(): rad/s or m/s.
    void joint_velocities(const RunAccess& run, std::span<double> out) const;
    /// What the motors of the joints gave, mean over the last tick, size() x axes(): N m or N.
    void joint_efforts(const RunAccess& run, std::span<double> out) const;
    /// One number of each axis of each robot, size() x axes(): the robot's own, or its type's.
    void joint_parameters(const RunAccess& run, JointParameter parameter, std::span<double> out) const;
    /// The same as the file has it, whatever own numbers robots have.
    void file_parameters(JointParameter parameter, std::span<double> out) const;
    /// One number of each link that all robots have, size() x links: the robot's own, or its type's; not a
    /// number where the link has none.
    void link_parameters(const RunAccess& run, LinkParameter parameter, std::span<double> out) const;
    /// The same as the file has it.
    void file_link_parameters(LinkParameter parameter, std::span<double> out) const;
    /// Gravity, m/s^2, or steady wind, m/s, of each robot, size() x 3, world axes: its own, or the Model's.
    void surroundings(const RunAccess& run, Surrounding which, std::span<double> out) const;
    /// The same as the file has it.
    void file_surroundings(Surrounding which, std::span<double> out) const;
    /// Kinetic energy of the links, and their potential energy in the robot's gravity (zero at the world's
    /// origin), size() x kEnergyColumns: J. Rotor inertias and springs are not in it.
    void energies(const RunAccess& run, std::span<double> out) const;
    /// Whether each robot presses against another robot, or against scenery that does not carry it (the
    /// contact's normal is more than 45 degrees off the vertical), size(): contacts of RunAccess::contacts().
    void touching(RunAccess& run, std::span<bool> out) const;

    // What sets a state does so at once where the run is in this process (RunAccess::change()).

    /// Puts the robots at poses as poses() gives them; quaternions are normalised.
    Result<> set_poses(RunAccess& run, std::span<const double> poses) const;
    /// Positions of the joints, as joint_positions() gives them; of a ball joint a rotation vector.
    Result<> set_joint_positions(RunAccess& run, std::span<const double> positions) const;
    /// Velocities of the joints, as joint_velocities() gives them.
    Result<> set_joint_velocities(RunAccess& run, std::span<const double> velocities) const;
    /// Sets velocities as twists() gives them.
    Result<> set_twists(RunAccess& run, std::span<const double> twists) const;
    /// Own numbers of some axes of each robot, size() x parameters.size() x columns.size(), in the units of
    /// joint_parameters(). Of a limit without the other one, the other one stays.
    Result<> set_joint_parameters(RunAccess& run, std::span<const std::size_t> columns,
                                  std::span<const JointParameter> parameters,
                                  std::span<const double> values) const;
    /// All numbers of these axes are those of the robots' types again.
    Result<> reset_joint_parameters(RunAccess& run, std::span<const std::size_t> columns) const;

    /// Own numbers of some links of each robot, size() x parameters.size() x links.size(), in the units of
    /// link_parameters(). What is not a number stays. Of a part of an inertia, the rest stays.
    Result<> set_link_parameters(RunAccess& run, std::span<const std::size_t> links,
                                 std::span<const LinkParameter> parameters,
                                 std::span<const double> values) const;
    /// All numbers of these links are those of the robots' types again.
    Result<> reset_link_parameters(RunAccess& run, std::span<const std::size_t> links) const;

    /// Own gravity or wind of each robot, size() x which.size() x components.size(), as surroundings() gives
    /// them. Components (0 x, 1 y, 2 z) that are not listed stay.
    Result<> set_surroundings(RunAccess& run, std::span<const std::size_t> components,
                              std::span<const Surrounding> which, std::span<const double> values) const;
    /// These components of gravity and wind are those of the Model again.
    Result<> reset_surroundings(RunAccess& run, std::span<const std::size_t> components) const;

    // What follows are orders: they take effect at the beginning of the next tick.

    /// Gains of motors, each size() x columns; empty: they stay.
    struct Gains {
        std::span<const double> position{},  ///< N m/rad or N/m
            velocity{};                      ///< N m s/rad or N s/m
    };
    /// Setpoints of some axes, size() x columns.size(). A negative max_effort: the joint's own bound. `gains`
    /// become the robots' own numbers at the same tick.
    Result<> set_joints(RunAccess& run, std::span<const std::size_t> columns, MotorMode mode,
                        std::span<const double> targets, double max_effort, const Gains& gains) const;
    /// The same, whose gains stay.
    Result<> set_joints(RunAccess& run, std::span<const std::size_t> columns, MotorMode mode,
                        std::span<const double> targets, double max_effort = -1) const {
        return set_joints(run, columns, mode, targets, max_effort, {});
    }
    /// Applies a wrench to this link of each robot (nullopt: to its first one) for `ticks` ticks. A row is
    /// the force (N, at the link's centre of mass) and the torque (N m), size() x 6.
    Result<> apply_wrenches(RunAccess& run, std::optional<std::size_t> link, std::span<const double> wrenches,
                            Tick ticks) const;
    /// A command of on-board controllers, size() x values.
    Result<> command(RunAccess& run, std::size_t channel, std::size_t values,
                     std::span<const double> rows) const;

  private:
    double* row(std::span<double> out, std::size_t robot, std::size_t columns) const;
    /// Number of a shared part in the RobotType of a row.
    std::size_t part_of(const SharedPart& part, std::size_t row) const {
        return part.of[shared_.type_of_row[row]];
    }
    /// The action number `k` of a row.
    using ActionOfRow = std::function<Action(std::size_t row, std::size_t k)>;
    Result<> give(RunAccess& run, std::size_t orders_per_row, const ActionOfRow& action) const;
    Result<> change(RunAccess& run, std::size_t orders_per_row, const ActionOfRow& action) const;
    Result<> change_all(RunAccess& run, const std::vector<Order>& orders) const;
    Result<> change_joints(RunAccess& run, std::span<const double> values,
                           std::vector<double> SetJointState::*kind) const;

    std::shared_ptr<const Model> model_;
    std::vector<RobotId> robots_;
    SharedParts shared_;
};

}  // namespace roboss
