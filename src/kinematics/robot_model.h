// RobotModel: the kinematics and dynamics of one robot apart from any simulation, for planning and control.
// Its functions take configurations as rows of arrays, many at a time: link_kinematics.h, dynamics.h,
// inverse_kinematics.h. All run the kernel's own routines (src/physics/dynamics).
//
// A row of a configuration q: of a free base the pose of the robot (SDF model) frame in the world (x y z in
// m, quaternion x y z w), then a number for each of axes() (rad or m; of a ball joint, a rotation vector in
// rad). A row of velocities v, accelerations a or forces: of a free base six numbers, then one for each axis.
// The six are the linear velocity of the origin O of the base link (m/s) and its angular velocity (rad/s),
// world axes; of forces, the force (N) and the torque about O (N m). The columns of a ball joint are the
// angular velocity and the torque in the joint frame of the file's parent. So (q, v) are what RobotSet reads
// as poses, twists and joints.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/result.h"
#include "model/joint_axis.h"

namespace roboss {

/// What RobotModel::create() takes.
struct RobotModelOptions {
    /// Leave out the joints that close kinematic loops: what remains is a tree that moves freely. Without, a
    /// robot with loops is refused.
    bool cut_loops = false;
    std::optional<Pose>
        X_WR{};  ///< robot (SDF model) frame of a fixed base in the world; none: as in the file
};

/// See the top of the file. Immutable: any number of threads may use it.
///
///     const RobotModel arm = RobotModel::create(model, *model->find_robot("arm")).value();
///     std::vector<double> q(arm.q_columns()), torque(arm.v_columns());
///     gravity_forces(arm, q, torque);
class RobotModel {
  public:
    /// One axis of a joint of the tree, as a column of rows.
    struct Column {
        int q = 0, v = 0;       ///< first coordinate of its joint in the kernel's q; its place in v
        int offset = 0;         ///< of a ball joint: which of the three
        bool is_ball = false;   ///< of a ball joint
        double lower = 0,       ///< rad or m; infinite: none
            upper = 0;          ///< rad or m
        int leader = 0;         ///< column of the one that it follows (mimic, gearbox); itself: none
        double multiplier = 1,  ///< position = multiplier * leader's position + leader_offset
            leader_offset = 0;  ///< rad or m
        bool turns = false;     ///< it is an angle
        /// From its own coupling to that of the last follower before `leader`, if one of them is curved: then
        /// they count instead of the two numbers.
        std::vector<CoordinateCoupling> curved{};

        double follow(double leader_at) const;  ///< its position with the leader there
        double slope(double leader_at) const;   ///< how fast it moves with the leader there
    };

    /// `robot` must exist in the model. Errors: "closed-loop", joints close kinematic loops; "no-joints",
    /// nothing of it can move.
    static Result<RobotModel> create(std::shared_ptr<const Model> model, RobotId robot,
                                     const RobotModelOptions& options = {});

    const Model& model() const { return *model_; }                     ///< the world of the robot
    const RobotType& type() const { return model_->type_of(robot_); }  ///< of the robot
    /// Columns behind those of the base: each axis of each joint of the tree, in the order of the file.
    const std::vector<JointAxis>& axes() const { return axes_; }
    const std::vector<Column>& columns() const { return columns_; }       ///< by the place in axes()
    std::size_t base_q() const { return type().free_base ? 7 : 0; }       ///< columns of the base in q
    std::size_t base_v() const { return type().free_base ? 6 : 0; }       ///< columns of the base in v
    std::size_t q_columns() const { return base_q() + columns_.size(); }  ///< of a configuration
    std::size_t v_columns() const { return base_v() + columns_.size(); }  ///< of velocities and forces
    /// Names of the joints that cut_loops left out.
    const std::vector<std::string>& cut_joints() const { return cut_joints_; }
    /// The configuration at the start of the world, q_columns() numbers.
    std::vector<double> start() const;

    // Between rows and the kernel's coordinates (model.h).

    /// q of RobotState of a row; a quaternion is normalised.
    void to_coordinates(const double* row, std::span<double> q) const;
    /// The row of q.
    void to_row(std::span<const double> q, double* row) const;
    /// Where column `column` of velocities and forces stands in the kernel's v.
    std::size_t v_of(std::size_t column) const { return v_of_column_[column]; }
    /// The column of entry `v` of the kernel's v.
    std::size_t column_of(std::size_t v) const { return column_of_v_[v]; }
    /// How many rows of `columns` an array holds; aborts if it is no whole number.
    static std::size_t rows(std::size_t size, std::size_t columns);

  private:
    RobotModel(std::shared_ptr<const Model> model, RobotId robot, const RobotModelOptions& options);
    void add_axes(const std::vector<JointAxis>& all);
    void add_followers();

    std::shared_ptr<const Model> model_;
    RobotId robot_;
    Pose X_WB_;  // fixed base: where it stands
    std::vector<JointAxis> axes_;
    std::vector<Column> columns_;
    std::vector<std::string> cut_joints_;
    std::vector<std::size_t> v_of_column_, column_of_v_;
};

}  // namespace roboss
