// Orders: the four levels on which a Client changes the world (the paper's section 4.3). Only the Controller
// sets apply_at.
#pragma once

#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

#include "core/types.h"
#include "model/joint_parameters.h"
#include "model/link_parameters.h"
#include "model/robot_state.h"
#include "model/surroundings.h"

namespace roboss {

/// Level 1: puts the robot (SDF model) frame at X_WR; joints keep their coordinates, velocities are kept.
struct SetPose {
    Pose X_WR;  ///< robot (SDF model) frame in the world
    /// Compares all members.
    friend bool operator==(const SetPose&, const SetPose&) = default;
};

/// Level 2: base velocity in world axes (of the base origin). Only for free bases.
struct SetVelocity {
    Vec3 linear,  ///< m/s, of the base origin, world axes
        angular;  ///< rad/s, world axes
    /// Compares all members.
    friend bool operator==(const SetVelocity&, const SetVelocity&) = default;
};

/// Level 3: force at the link's centre of mass and torque, world axes, for `duration` ticks (at least 1).
/// Wrenches on a link add up, unless one `replaces` those before it.
struct ApplyWrench {
    LinkId link;            ///< that the wrench acts on
    Vec3 force,             ///< N, world axes, at the centre of mass
        torque;             ///< N m, world axes
    Tick duration = 1;      ///< ticks
    bool replaces = false;  ///< ends the wrenches that earlier orders put on this link
    /// Compares all members.
    friend bool operator==(const ApplyWrench&, const ApplyWrench&) = default;
};

/// Level 3: a spring with damping between a point of a link and a point of the world, for `duration` ticks,
/// as a hand pulls (physics/dynamics/pull.h). It replaces an earlier pull on this link.
struct Pull {
    LinkId link;           ///< that is pulled
    Vec3 p_L,              ///< m, the point that is held, in the link's frame
        target_W;          ///< m, world, where it is pulled
    double rate = 15;      ///< rad/s: natural frequency of the spring, which is critically damped
    double max_force = 0;  ///< N; 0: the hand lets go
    Tick duration = 1;     ///< ticks
    /// Compares all members.
    friend bool operator==(const Pull&, const Pull&) = default;
};

/// Level 1: puts a joint at a position, or gives it a velocity, or both, at once; motors keep their
/// setpoints. A position beyond the joint's limits is pushed back within some ticks. Not for joints that
/// close loops: their states follow from the others.
struct SetJointState {
    JointId joint;                 ///< of the robot's type
    std::vector<double> position;  ///< rad or m, of each axis; ball: rotation vector; empty: it is kept
    std::vector<double> velocity;  ///< rad/s or m/s, of each axis; empty: it is kept
    /// Compares all members.
    friend bool operator==(const SetJointState&, const SetJointState&) = default;
};

/// Level 4: latches a setpoint of one degree of freedom of a joint. A negative max_effort means the joint's
/// own bound.
struct SetJoint {
    JointId joint;                          ///< of the robot's type
    int axis = 0;                           ///< which of its axes, from 0
    MotorMode mode = MotorMode::kVelocity;  ///< what `target` is
    double target = 0;                      ///< rad/s, rad, N m (or m/s, m, N), by `mode`
    double max_effort = -1;                 ///< N m or N
    /// Compares all members.
    friend bool operator==(const SetJoint&, const SetJoint&) = default;
};

/// Level 4: latches a command of the robot's on-board controllers.
struct Command {
    std::uint32_t channel = 0;   ///< in RobotType::channels
    std::vector<double> values;  ///< as many as the channel has; of a list: any number of rows
    /// Compares all members.
    friend bool operator==(const Command&, const Command&) = default;
};

/// Attaches a link of another robot to a link of this one, as they stand to each other at that tick; nothing
/// happens if `other` is out of reach. The bond is rigid and holds until it is loosed or overloaded.
struct Attach {
    LinkId link;         ///< of the robot, which becomes the holder
    RobotId other;       ///< the robot that is held
    LinkId other_link;   ///< of `other`
    double reach = 0.1;  ///< m: how far the two robots' bounds may be apart
    double max_force = std::numeric_limits<double>::infinity();   ///< N: beyond, it lets go
    double max_torque = std::numeric_limits<double>::infinity();  ///< N m: beyond, it lets go
    /// Compares all members.
    friend bool operator==(const Attach&, const Attach&) = default;
};

/// Loosens the bonds by which the robot holds `other`.
struct Detach {
    RobotId other;  ///< not valid: all that it holds
    /// Compares all members.
    friend bool operator==(const Detach&, const Detach&) = default;
};

/// Sends a message by a radio. It begins at once, or when the radio's transmissions before it end, and lasts
/// as long as its bits take. It moves no robot and wakes none. A radio that has no room for it (RadioState)
/// drops it.
struct Transmit {
    std::uint32_t radio = 0;            ///< in RobotType::radios
    RobotId to;                         ///< the robot that it is for; not valid: everybody
    std::vector<std::uint8_t> payload;  ///< at most RadioState::kMostPayload bytes
    /// Compares all members.
    friend bool operator==(const Transmit&, const Transmit&) = default;
};

/// What an order does.
using Action = std::variant<SetPose, SetVelocity, ApplyWrench, SetJoint, Command, Attach, Detach, Pull,
                            SetJointState, Transmit, SetJointParameters, SetLinkParameters, SetSurroundings>;

/// An action on one robot at one tick.
struct Order {
    Tick apply_at = 0;  ///< applied at the start of this tick, before the step apply_at -> apply_at + 1
    ClientId client;    ///< who asks for it
    std::uint64_t sequence = 0;  ///< per Client, ascending
    RobotId robot;               ///< that it acts on
    Action action;               ///< what it does
    /// Compares all members.
    friend bool operator==(const Order&, const Order&) = default;
};

/// What an order may ask for at most, in size (docs/physics.md, "Ranges"): more than any robot does, and so
/// little that sums and products of a step stay numbers. One order beyond them would end the run for
/// everybody.
struct OrderLimits {
    double position = 1e9;   ///< m: coordinates of a pose; rad or m: of a joint, and its target
    double speed = 1e5;      ///< m/s: of a base; m/s or rad/s: of a joint, and its target
    double turn_rate = 1e5;  ///< rad/s, of a base
    double force = 1e9;      ///< N: on a link; N or N m: target of a joint's effort
    double torque = 1e9;     ///< N m, on a link
    double rate = 1e3;       ///< rad/s, of a pull
    double gravity = 1e3;    ///< m/s^2, each component
    double wind = 1e3;       ///< m/s, each component
};
/// The limits in force.
inline constexpr OrderLimits kOrderLimits;

/// Canonical order: (apply_at, client, sequence).
bool comes_before(const Order& a, const Order& b);

/// What is wrong with the order for this Model (unknown robot, link or joint, number that is not finite or
/// beyond kOrderLimits, velocity of a fixed base ...), in words, or Ok.
Result<> check_order(const Model& model, const Order& order);

/// Applies a checked order to the robot's state, and wakes it.
void apply_order(const Model& model, const Order& order, RobotState& state);

}  // namespace roboss
