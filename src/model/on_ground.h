// Robots stood on the ground: moved along z until their lowest collision shape touches the scenery below.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "model/model.h"

namespace roboss {

/// The result of stand_on_ground(), by names of robots.
struct OnGround {
    std::size_t stand = 0;               ///< robots that stand on the ground now
    std::string first;                   ///< of these
    double lowest = 0, highest = 0;      ///< m, how far they were moved along z
    std::vector<std::string> fixed;      ///< left alone: fixed to the world
    std::vector<std::string> bare;       ///< left alone: without collision shapes
    std::vector<std::string> no_ground;  ///< left alone: there is no scenery below
};

/// Moves the robots from `first` on along z, those of a model together and as they are to each other, until
/// they touch the highest scenery below them. They come down from their own height above where they are, so a
/// robot that is sunk in is lifted; from above a solid that their lowest point lies in; onto planes and
/// height fields from wherever they are. The Model is not sealed yet.
OnGround stand_on_ground(Model& model, std::size_t first);

/// A compiled Model with all its robots stood on the ground; reports what report() does.
std::shared_ptr<const Model> stood_on_ground(const Model& model, const SourceLocation& where,
                                             Diagnostics& diagnostics);

/// A note about those that stand, and a warning about those that do not.
void report(const OnGround& done, const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace roboss
