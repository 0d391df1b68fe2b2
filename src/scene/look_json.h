// Numbers and the look of a world as JSON (docs/viewer-protocol.md). Internal to the scene layer.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "math/pose.h"
#include "world/look.h"

namespace roboss {

/// Rounded to a millionth of a millimetre.
double tidy(double value);
nlohmann::ordered_json json_of(const Vec3& v);
/// x y z, then the quaternion w x y z.
nlohmann::ordered_json json_of(const Pose& X);
nlohmann::ordered_json json_of(const std::vector<LightSpec>& lights);
/// null: the file says nothing of its look.
nlohmann::ordered_json json_of(const WorldLook& look);

}  // namespace roboss
