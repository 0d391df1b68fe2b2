// The city as an SDF 1.9 world: the scenery of a CityPlan as static models, and its cars, each a complete
// model of its own (equal but for name and pose, which the loader reads once).
#pragma once

#include <string>

#include "app/worlds/city_plan.h"

namespace roboss {

std::string city_sdf(const CityOptions& options);

}  // namespace roboss
