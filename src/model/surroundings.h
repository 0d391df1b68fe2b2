// Gravity and steady wind that a robot feels in place of the Model's. They are own numbers of the robot, as
// those of its joints and links (own_numbers.h). Decision 0051.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/result.h"
#include "math/vec3.h"

namespace roboss {

struct Model;
struct RobotState;
struct RobotType;

/// Gravity and wind that a robot feels in place of the Model's.
struct OwnSurroundings {
    std::optional<Vec3> gravity,  ///< m/s^2, world axes; none: Model::gravity
        wind;                     ///< m/s, world axes; none: Model::wind
    /// True if all is the Model's.
    bool empty() const { return !gravity && !wind; }
    /// Compares all members.
    friend bool operator==(const OwnSurroundings&, const OwnSurroundings&) = default;
};

/// Selects gravity or wind.
enum class Surrounding : std::uint8_t { kGravity, kWind };

/// Name, unit and place of gravity or of wind.
struct SurroundingInfo {
    const char *name,  ///< as orders and pages have it
        *unit;         ///< of each component
    std::optional<Vec3> OwnSurroundings::*own;
};

/// All rows, in the order of Surrounding.
std::span<const SurroundingInfo> surroundings();
/// Its row.
const SurroundingInfo& info_of(Surrounding which);

/// Gives the robot own gravity, wind, or both; what is not given stays. The wind is the one that <wind> of a
/// file gives: WindEffects approach it, unless they have a command.
struct SetSurroundings {
    bool reset = false;      ///< first, both become those of the Model
    OwnSurroundings values;  ///< that the robot has from then on
    /// Compares all members.
    friend bool operator==(const SetSurroundings&, const SetSurroundings&) = default;
};

/// Checks the order for a robot. Codes of its refusals: "no-parameter" (it sets nothing), "not-finite",
/// "beyond-limit" (OrderLimits).
Result<> check_surroundings(const std::string& robot, const SetSurroundings& order);

/// Applies a checked order to a robot of the Model's `type`. What is as in the Model leaves no trace in the
/// state.
void apply_surroundings(const Model& model, const RobotType& type, const SetSurroundings& order,
                        RobotState& state);

/// True if orders may give a robot these. Bytes may still have what equals the Model's: states are decoded
/// without a Model.
bool may_own(const OwnSurroundings& own);

/// Gravity or wind of the Model; and of a robot: its own, or else the Model's. World axes.
const Vec3& surrounding_of(const Model& model, Surrounding which);
const Vec3& surrounding_of(const Model& model, const RobotState& state, Surrounding which);

}  // namespace roboss
