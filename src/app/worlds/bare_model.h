// What a world lacks that is one bare robot, as a URDF file: ground, and a base that does not fall over.
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "world/world.h"

namespace roboss {

struct BareModelOptions {
    bool ground = false;                  // --ground
    std::vector<std::string> fixed_base;  // --fixed-base: names of models
};

/// Adds a plane at z = 0 and welds the models to the world. An Error names a model that is not there.
Result<> complete(World& world, const BareModelOptions& options);

}  // namespace roboss
