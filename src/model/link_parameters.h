// Numbers of links that may differ from robot to robot and change while a world runs: mass, centre of mass,
// inertia, friction and bounce of the surface. A robot's type has them from the file; a robot that was
// ordered others keeps those that differ in its state (own_numbers.h). Decision 0050.
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

struct Material;
struct RobotState;
struct RobotType;

/// Which number of a link. Their order is part of the encoding of orders and states.
enum class LinkParameter : std::uint8_t {
    kMass,
    kCentreX,
    kCentreY,
    kCentreZ,
    kInertiaXx,
    kInertiaYy,
    kInertiaZz,
    kInertiaXy,
    kInertiaXz,
    kInertiaYz,
    kFriction,
    kFrictionAcross,
    kRestitution,
    kTorsionalFriction,
    kRollingFriction
};
inline constexpr std::size_t kLinkParameters = 15;

/// A row of the table of these numbers.
struct LinkParameterInfo {
    const char *name,      ///< in orders files and programs
        *unit;             ///< empty: none
    bool signless = true;  ///< it cannot be negative
    /// Where it stands in the material of the link's shapes, for all of them; nullptr: it is of the mass.
    double Material::*surface = nullptr;
};

/// All of them; the index is the number of the LinkParameter.
std::span<const LinkParameterInfo> link_parameters();
/// The row of one.
const LinkParameterInfo& info_of(LinkParameter parameter);
/// The one with this name; nullopt: there is none.
std::optional<LinkParameter> find_link_parameter(std::string_view name);
/// "mass, centre_x, ...": for messages.
std::string link_parameter_names();

/// One number of a link.
struct LinkParameterValue {
    LinkParameter parameter{};  ///< which one
    double value = 0;           ///< in the unit of its row
    /// Compares all members.
    friend bool operator==(const LinkParameterValue&, const LinkParameterValue&) = default;
};

/// Gives the robot own numbers of one link; those that are not named stay. The inertia is about the centre of
/// mass, in axes of the link; its six numbers come together. While a robot has no own ones, they grow in
/// proportion to its own mass. Friction and bounce are those of all collision shapes of the link.
struct SetLinkParameters {
    LinkId link;                             ///< of the robot's type
    bool reset = false;                      ///< first all numbers of the link become those of the type
    std::vector<LinkParameterValue> values;  ///< each parameter at most once
    /// Compares all members.
    friend bool operator==(const SetLinkParameters&, const SetLinkParameters&) = default;
};

/// A number of a link that differs from that of the robot's type.
struct OwnLinkNumber {
    LinkId link;                  ///< in RobotType::links
    LinkParameterValue number{};  ///< what it is
    /// Compares all members.
    friend bool operator==(const OwnLinkNumber&, const OwnLinkNumber&) = default;
};

/// Checks the order for a robot of this type. Codes of its refusals: "no-link", "no-parameter" (it sets
/// nothing, or what does not exist), "repeated-parameter", "not-finite", "bad-parameter" (negative, no mass,
/// a bounce above 1), "beyond-limit", "half-inertia", "bad-inertia" (that no body can have), "no-mass" (a
/// link without mass has no numbers of mass), "no-shapes" (it touches nothing), "no-direction" (its friction
/// is the same in all), "many-loops" (a mass where the type cannot have another one).
Result<> check_link_parameters(const std::string& robot, const RobotType& type,
                               const SetLinkParameters& order);

/// Applies a checked order. A state whose numbers are those of its type again has no own ones.
void apply_link_parameters(const RobotType& type, const SetLinkParameters& order, RobotState& state);

/// The number of a link of a type, or of the type with a robot's own numbers; nullopt: the link has none.
std::optional<double> link_number(const RobotType& type, LinkId link, LinkParameter parameter);

/// True if a state may have these own numbers: by link and parameter, each one that orders may give.
bool may_own(const RobotType& type, std::span<const OwnLinkNumber> own);

/// Gives the type these numbers. True: some are of masses, so what follows from these is to be computed anew.
bool put_numbers(std::span<const OwnLinkNumber> own, RobotType& type);

}  // namespace roboss
