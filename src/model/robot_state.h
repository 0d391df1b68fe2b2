// RobotState: ALL that the next step reads of a robot. Copying it moves the robot to another machine, bit for
// bit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/hash.h"
#include "core/types.h"
#include "model/model.h"
#include "model/own_numbers.h"

namespace roboss {

/// What a motor does.
enum class MotorMode : std::uint32_t {
    kPassive,   ///< nothing
    kVelocity,  ///< holds a velocity
    kPosition,  ///< holds a position
    kEffort     ///< gives a torque or force
};

/// The latched order of one joint degree of freedom.
template <class T>
struct MotorSetpointT {
    MotorMode mode = MotorMode::kPassive;  ///< what `target` is
    T target = 0;                          ///< rad/s, rad, N m (or m/s, m, N)
    T max_effort = 0;                      ///< bound in force, N m or N
    T impulse = 0;  ///< N m s or N s, that it gave in the last tick; if it is not hard: limits and friction
    T load = 0;     ///< the smaller of the last two impulses, of one sign: what a hard motor starts from
    /// Compares all members.
    friend bool operator==(const MotorSetpointT&, const MotorSetpointT&) = default;
};
/// In doubles, as it is kept.
using MotorSetpoint = MotorSetpointT<double>;

/// A force on a link's centre of mass and a torque, world axes, while tick < until.
struct TimedWrench {
    LinkId link;     ///< that the wrench acts on
    Vec3 force,      ///< N, world axes
        torque;      ///< N m, world axes
    Tick until = 0;  ///< first tick without it
    /// Compares all members.
    friend bool operator==(const TimedWrench&, const TimedWrench&) = default;
};

/// A spring with damping from a point of a link to a point of the world, while tick < until.
struct TimedPull {
    LinkId link;        ///< that is pulled
    Vec3 p_L,           ///< m, the point that is held, in the link's frame
        target_W;       ///< m, world
    double rate = 0,    ///< rad/s
        max_force = 0;  ///< N
    Tick until = 0;     ///< first tick without it
    /// Compares all members.
    friend bool operator==(const TimedPull&, const TimedPull&) = default;
};

/// The impulses of a contact at the last tick: the solver's first guess of the friction bound, and the load
/// that its rows start from. Owned by the lower robot id of the pair; dropped at the first tick without the
/// contact. Kept sorted by key (the first four members).
struct ContactMemory {
    std::uint32_t other_robot = 0;  ///< RobotId of the other, Id::kNone for static scenery
    std::uint32_t shape = 0;        ///< of this robot
    std::uint32_t other_shape = 0;  ///< of the other robot or of Model::statics
    std::uint32_t feature = 0;      ///< names the same point on the same pair of shapes from tick to tick
    double impulse = 0;             ///< normal, N s
    double load = 0;                ///< N s, no blow: smaller of the last two; if soft, what it stored
    Vec3 friction;                  ///< N s, world axes
    /// Compares all members.
    friend bool operator==(const ContactMemory&, const ContactMemory&) = default;
};

/// How long the robot has been at rest, and what a sleeper keeps (physics/sleep.h). A state with default
/// values is awake and moving.
struct Rest {
    std::uint32_t still_ticks = 0;          ///< at rest so long, counted up to what sleep takes
    bool asleep = false;                    ///< whether it sleeps
    std::vector<std::uint32_t> neighbours;  ///< RobotIds that the sleeper touches, ascending
    Aabb bound;                             ///< the sleeper's interaction bound
    /// Compares all members.
    friend bool operator==(const Rest&, const Rest&) = default;
};

/// How the surface of a link's shapes moves against the link: a conveyor belt, a track, a turntable. What
/// touches it is carried along by friction. SurfaceFlow says how the parts add up.
struct SurfaceMotion {
    LinkId link;    ///< whose collision shapes these are
    Vec3 linear_L,  ///< m/s, at the link's origin, link axes
        angular_L,  ///< rad/s, link axes
        belt_L;     ///< m/s, link axes: speed times the axis that the surface runs around
    bool turns =
        false;      ///< the belt's axis points along the line to `centre_W` at each point: tracks that turn
    Vec3 centre_W;  ///< m, world: what a vehicle on tracks turns about
    /// Compares all members.
    friend bool operator==(const SurfaceMotion&, const SurfaceMotion&) = default;
};

/// Where a bond stands.
enum class BondPhase : std::uint32_t {
    kForming,  ///< it forms in this tick if what it is for is in reach; else it is dropped
    kHolds,    ///< it holds
    kLoosed    ///< it was told to let go; dropped in this tick
};

/// A rigid attachment of a link of another robot, or of the scenery, to a link of this one (gripper,
/// detachable joint). This robot, the holder, keeps it; the other one knows nothing of it (physics/bonds).
struct Bond {
    BondPhase phase = BondPhase::kForming;  ///< whether it holds
    LinkId link;                            ///< of this robot
    /// RobotId of the other one; Id::kNone: the scenery, or, while it forms, whatever is in reach.
    std::uint32_t other = 0xFFFFFFFF;
    LinkId other_link;     ///< of the other robot; not valid: of the scenery
    Pose X_LO;             ///< m, the other link (scenery: the world) in this link's frame: what it keeps
    Vec3 p_L;              ///< m, in this link's frame: where its force and torque are counted
    double reach = 0;      ///< m, while it forms: how far the other one may be; -1: it just took hold, a blow
    double max_force = 0,  ///< N: it lets go beyond; infinite: never
        max_torque = 0;    ///< N m: it lets go beyond; infinite: never
    Vec3 force_impulse,    ///< N s, world axes, on the other one, of the last tick
        torque_impulse;    ///< N m s, world axes, likewise
    /// Compares all members.
    friend bool operator==(const Bond&, const Bond&) = default;
};

/// A message that a radio sends or has sent.
struct Transmission {
    std::uint64_t number = 0;       ///< of the radio's transmissions, from 0
    std::uint32_t to = 0xFFFFFFFF;  ///< RobotId of the robot that it is for; Id::kNone: everybody
    std::uint32_t size = 0;         ///< bytes of its payload
    Tick given = 0;                 ///< when the order took effect
    double begin_s = 0,             ///< s, simulated time at which it begins
        end_s = 0;                  ///< s, at which it ends
    Pose X_WB;                      ///< of the sender's base (base_pose) when the order took effect
    /// Compares all members.
    friend bool operator==(const Transmission&, const Transmission&) = default;
};

/// What others may still have to hear of a radio: its last transmissions. What each hears, Clients compute
/// (sensors/radio.cpp).
struct RadioState {
    static constexpr double kKept_s = 1;               ///< how long after its end a transmission is kept, s
    static constexpr std::size_t kMostKept = 1024,     ///< transmissions
        kMostBytes = 131'072;                          ///< of all their payloads
    static constexpr std::size_t kMostPayload = 8192;  ///< bytes of one message

    std::uint64_t count = 0,          ///< transmissions so far
        dropped = 0;                  ///< orders for which there was no room
    std::vector<Transmission> sent;   ///< by time
    std::vector<std::uint8_t> bytes;  ///< their payloads, one behind the other
    /// Compares all members.
    friend bool operator==(const RadioState&, const RadioState&) = default;
};

/// State of one robot at the start of a tick.
struct RobotState {
    std::vector<double> q;                ///< see model.h
    std::vector<double> v;                ///< velocities, see model.h
    std::vector<MotorSetpoint> motors;    ///< RobotType::motor_count()
    std::vector<TimedWrench> wrenches;    ///< in force, in the order in which they came
    std::vector<ContactMemory> contacts;  ///< of the last tick, sorted
    Rest rest;                            ///< sleep
    /// Latched commands and memory of the on-board controllers: RobotType::onboard_size numbers, laid out by
    /// ChannelInfo and OnboardInfo.
    std::vector<double> onboard;
    std::vector<std::vector<double>> lists;  ///< latched commands that are lists, row by row
    std::vector<SurfaceMotion> surfaces;     ///< in motion, by ascending link
    std::vector<Bond> bonds;         ///< attachments that this robot holds, in the order in which they came
    std::vector<TimedPull> pulls;    ///< in force, at most one on a link
    std::vector<RadioState> radios;  ///< by RobotType::radios
    OwnNumbers own;                  ///< numbers that differ from those of its type and of the Model
    OwnType own_type;                ///< with `own`; a step has it from type_of()
    /// Compares all members.
    friend bool operator==(const RobotState&, const RobotState&) = default;
};

/// The type of a robot, with its own numbers if it has some. `type`: that of the Model.
inline const RobotType& type_of(const RobotType& type, const RobotState& state) {
    const RobotType* own = state.own_type.get();
    return own == nullptr ? type : *own;
}
/// Likewise one axis of a joint.
inline const Dof& dof_of(const RobotType& type, const RobotState& state, const Joint& joint, int axis) {
    return type_of(type, state).dof(joint, axis);
}

/// State of a robot at the start of the world.
RobotState initial_state(const Model& model, RobotId robot);

/// Pose of body 0 (free base) or of the base frame.
Pose base_pose(const RobotState& state);
/// Sets it; joints and velocities stay.
void set_base_pose(RobotState& state, const Pose& X_WB);

/// Hash of one robot's whole state with its id and the tick.
std::uint64_t state_hash(RobotId robot, Tick tick, const RobotState& state);

/// The world's state hash, from the robots' hashes in ascending order of ids: the number that must be equal
/// everywhere.
std::uint64_t world_hash(std::uint64_t model_hash, std::span<const std::uint64_t> robot_hashes);

/// The state as bytes (little-endian, versioned by the Model hash that travels beside it) and back.
void encode(const RobotState& state, std::vector<std::uint8_t>& out);
/// `robots`: how many the world has; a state that names another one is refused, and so are coordinates and
/// velocities that are not finite.
Result<RobotState> decode_state(std::span<const std::uint8_t> bytes, const RobotType& type,
                                std::size_t robots = RobotId::kNone);

}  // namespace roboss
