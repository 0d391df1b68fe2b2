// What touches whom, and what joints bear: computed on request by stepping copies of the states by one tick.
// A step is a pure function, so these are the very impulses of the tick that begins at these states (as long
// as no order takes effect at it), whoever asks and wherever. Sleepers are woken in the copies: what rests
// has weight.
#pragma once

#include <span>
#include <vector>

#include "onboard/onboard.h"
#include "physics/step.h"

namespace roboss {

/// What a joint passes to its child link, in the mean over the tick: with the motor's share.
struct JointReaction {
    JointId joint;  ///< of the robot's type
    Vec3 force,     ///< N, world axes
        torque;     ///< N m about the joint's origin, world axes
    Vec3 origin_W;  ///< m, the joint's origin in the world
};

/// Contacts and joint reactions of one tick, found by stepping copies of all robots' states.
class StepProbe {
  public:
    /// The model must outlive the probe.
    explicit StepProbe(const Model& model) : model_(model) {}

    /// states[i] is that of RobotId i at `tick`.
    void step(Tick tick, std::span<const RobotState* const> states);
    /// The tick that was stepped last; -1: not stepped yet.
    Tick tick() const { return tick_; }

    /// The robot's state at the end of the tick.
    const RobotState& state_after(RobotId robot) const { return after_[robot.index()]; }

    /// By (robot_a, robot_b, shapes).
    std::span<const ContactReport> contacts() const { return contacts_; }
    /// Of all joints, in the order of RobotType::joints: those that move a body, those that close a loop, and
    /// the fixed ones between two links of a body or of the world, as a force and torque sensor has it. (A
    /// fixed joint that only repeats what others weld bears nothing and is left out.) Gearboxes and mimic
    /// joints push at their hinges as motors do. A mechanism with more conditions than it needs, as a planar
    /// linkage in space, can share its load in many ways: the joints that close its loops then take the
    /// least, which is what equal softness gives. Where nothing but its own loops acts on a robot, its
    /// reactions are of first order in the step.
    std::vector<JointReaction> joint_reactions(RobotId robot) const;

  private:
    /// What a bond does to a link.
    struct BondLoad {
        RobotId robot;
        LinkId link;
        Vec3 p_W, force, torque;  // m; N; N m, world axes
    };
    void note_bonds(RobotId holder);
    std::vector<Spatial> forces_of_loops(RobotId robot, const RobotType& type) const;

    const Model& model_;
    Tick tick_ = -1;
    std::vector<RobotId> ids_;
    std::vector<RobotState> before_, after_;
    std::vector<RobotState*> pointers_;
    std::vector<Aabb> bounds_;
    std::vector<LoopReaction> loads_;
    std::vector<BondLoad> bond_loads_;
    std::vector<char> free_;  // moved by the Runge-Kutta method
    std::vector<ContactReport> contacts_;
    StepScratch scratch_;
    OnboardScratch onboard_;
};

}  // namespace roboss
