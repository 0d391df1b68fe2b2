// What a world lacks that is one bare robot, as a URDF file: ground, and a base that does not fall over.
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "world/world.h"

namespace roboss {

/// What to add; `roboss run` has it as --ground and --fixed-base.
struct BareModelOptions {
    bool ground = false;                  ///< a plane at z = 0
    std::vector<std::string> fixed_base;  ///< names of models that are welded to the world
};

/// Adds a plane at z = 0 and welds the models to the world. An Error names a model that is not there.
Result<> complete(World& world, const BareModelOptions& options);

}  // namespace roboss
