// Rights: what the key of a Client permits. Its certificate carries them as text (net/certificates.h), the
// Bus over a network adds them to what arrives, and the Controller asks permit().
#pragma once

#include <bitset>
#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"
#include "model/model.h"
#include "model/order.h"
#include "wire/control.h"

namespace roboss {

/// Kinds of orders; the first four are the paper's levels.
enum class OrderKind : std::uint8_t {
    kPose,       ///< SetPose, SetJointState
    kVelocity,   ///< SetVelocity
    kForce,      ///< ApplyWrench, Pull, SetSurroundings
    kActuators,  ///< SetJoint, Command, SetJointParameters, SetLinkParameters
    kBonds,      ///< Attach, Detach
    kRadio,      ///< Transmit
};
inline constexpr std::size_t kOrderKinds = 6;

/// "pose", "velocity", "force", "actuators", "bonds" or "radio".
const char* order_kind_name(OrderKind kind);
OrderKind kind_of(const Action& action);

struct Rights {
    std::string key{};                     ///< name of the key's holder, for messages
    std::vector<std::string> robots{"*"};  ///< that it may order: names and patterns (fits_pattern())
    std::bitset<kOrderKinds> orders{(1u << kOrderKinds) - 1};  ///< by OrderKind
    bool steers = true;  ///< it may pause, save, rewind, change and end the run

    /// Nothing is limited.
    bool everything() const;
    /// It may neither order nor steer.
    bool look_only() const { return orders.none() && !steers; }
    /// Compares all members.
    friend bool operator==(const Rights&, const Rights&) = default;
};

/// The error [not-permitted] of a checked order; its text names the key and what that permits. `rights`:
/// null: all. To attach a robot, both are needed.
Result<> permit(const Rights* rights, const Model& model, const Order& order);
/// The same of a request to the run. Requests that only ask are always permitted.
Result<> permit(const Rights* rights, const ControlAction& request);

/// "robots=car_*,spider;orders=pose,force;steer=no"; "everything" and "look-only" for short.
std::string rights_text(const Rights& rights);
/// The rights of such a text. An Error [bad-rights]: it is none.
Result<Rights> rights_of(const std::string& text);
/// From the words of a command line. An Error [bad-rights] names a kind that there is not, or a pattern that
/// is empty, or has a character that the text cannot have (,;= and control characters: write ?).
Result<Rights> make_rights(const std::vector<std::string>& robots, const std::vector<std::string>& orders,
                           bool steers);

}  // namespace roboss
