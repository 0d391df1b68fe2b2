// MuJoCo as an oracle: our coordinates in, its accelerations, poses and twists out in our convention.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

#include "model/model.h"
#include "model/robot_state.h"
#include "physics/dynamics/kinematics.h"

namespace roboss::test {

/// Conventions. Free base: MuJoCo's angular velocity is in the body's axes, ours in the world's; linear alike
/// (body origin, world axes). Ball joint: MuJoCo turns the child about its own axes at zero and has its
/// angular velocity in the child's axes; ours turns in the joint frame and has the velocity in the joint
/// frame that the parent carries.
class MujocoOracle {
  public:
    MujocoOracle(const ModelSpec& spec, const Pose& X_WM, const Vec3& gravity, const RobotType& type);

    /// Sets state and wrenches of `state`, and `joint_force` (one a joint dof of ours), then computes.
    void set(const RobotState& state, const std::vector<double>& joint_force);

    std::vector<double> acceleration() const;  // as our v
    Transform link_pose(const std::string& link) const;
    Twist link_twist(const std::string& link) const;

  private:
    struct FreeModel {
        void operator()(mjModel* m) const { mj_deleteModel(m); }
    };
    struct FreeData {
        void operator()(mjData* d) const { mj_deleteData(d); }
    };
    /// One of our joint bodies with MuJoCo's joint.
    struct Pair {
        const Body* body = nullptr;
        int joint = -1;
        Mat3 R_LJ;  // ball: joint frame in the child link
    };

    int id(int kind, const std::string& name) const;
    void pair_up(const ModelSpec& spec);
    void set_ball(const Pair& pair, const RobotState& state, const std::vector<double>& joint_force);

    const RobotType& type_;
    std::unique_ptr<mjModel, FreeModel> model_;
    std::unique_ptr<mjData, FreeData> data_;
    std::vector<Pair> pairs_;
    RobotState state_;
};

}  // namespace roboss::test
