// Numbers of joint axes that may differ from robot to robot and change while a world runs: damping, friction,
// springs, rotor inertia, gains and bounds of motors, limits. A robot's type has them from the file; a robot
// that was ordered others keeps those that differ in its state (own_numbers.h). Decision 0050.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "core/types.h"

namespace roboss {

struct Dof;
struct RobotState;
struct RobotType;

/// Which number of an axis. Their order is part of the encoding of orders and of states.
enum class JointParameter : std::uint8_t {
    kLower,
    kUpper,
    kMaxEffort,
    kMaxVelocity,
    kDamping,
    kFriction,
    kSpringStiffness,
    kSpringReference,
    kArmature,
    kPositionGain,
    kVelocityGain,
    kLimitStiffness,
    kLimitDissipation
};
inline constexpr std::size_t kJointParameters = 13;

/// A row of the table of these numbers.
struct JointParameterInfo {
    const char* name;      ///< in orders files and programs, as the member is called
    const char *turning,   ///< unit of an axis that turns
        *sliding;          ///< unit of an axis that slides
    double Dof::*member;   ///< where it stands
    bool signless = true;  ///< it cannot be negative
    bool endless = false;  ///< infinite: there is no bound
    /// Orders for ball joints may set it: it needs no position along an axis.
    bool of_balls = true;
};

/// All of them; the index is the number of the JointParameter.
std::span<const JointParameterInfo> joint_parameters();
/// The row of one.
const JointParameterInfo& info_of(JointParameter parameter);
/// The one with this name; nullopt: there is none.
std::optional<JointParameter> find_joint_parameter(std::string_view name);
/// "lower, upper, ...": for messages.
std::string joint_parameter_names();

/// One number of an axis.
struct JointParameterValue {
    JointParameter parameter{};  ///< which one
    double value = 0;            ///< in the unit of its row
    /// Compares all members.
    friend bool operator==(const JointParameterValue&, const JointParameterValue&) = default;
};

/// A number of an axis that differs from that of the robot's type.
struct OwnJointNumber {
    JointId joint;                 ///< in RobotType::joints
    int axis = 0;                  ///< which of its axes, from 0
    JointParameterValue number{};  ///< what it is
    /// Compares all members.
    friend bool operator==(const OwnJointNumber&, const OwnJointNumber&) = default;
};

/// Level 4: gives the robot own numbers of one axis of a joint; those that are not named stay. The two limits
/// come together, and lie within those of the type, as all that knows how far the robot reaches goes by
/// these.
struct SetJointParameters {
    JointId joint;                            ///< of the robot's type
    int axis = 0;                             ///< which of its axes, from 0
    bool reset = false;                       ///< first all numbers of the axis become those of the type
    std::vector<JointParameterValue> values;  ///< each parameter at most once
    /// Compares all members.
    friend bool operator==(const SetJointParameters&, const SetJointParameters&) = default;
};

/// Checks the order for a robot of this type. Codes of its refusals: "no-joint", "no-axis" (it has no such
/// axis), "no-parameter" (it sets nothing, or what does not exist), "repeated-parameter", "not-finite",
/// "bad-parameter" (negative, or limits in the wrong order), "beyond-limit" (of all orders), "half-limits"
/// (one of the two), "beyond-type" (limits that are wider than those of the type), "no-position" (a ball
/// joint), "loop-joint", "many-loops" (a rotor inertia where the type cannot have any).
Result<> check_joint_parameters(const std::string& robot, const RobotType& type,
                                const SetJointParameters& order);

/// Applies a checked order. A state whose numbers are those of its type again has no own ones. A motor that
/// has the effort bound of its axis gets the new one, and any other at most that.
void apply_joint_parameters(const RobotType& type, const SetJointParameters& order, RobotState& state);

/// True if a state may have these own numbers: by joint, axis and parameter, each one that orders may give.
bool may_own(const RobotType& type, std::span<const OwnJointNumber> own);

/// Gives the type these numbers. True: some are rotor inertias, so what follows from masses is to be computed
/// anew.
bool put_numbers(std::span<const OwnJointNumber> own, RobotType& type);

}  // namespace roboss
