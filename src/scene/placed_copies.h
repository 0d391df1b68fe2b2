// What was added to a running world looks as in the World that it came from, by other names and elsewhere.
#pragma once

#include <span>

#include "model/copy_place.h"
#include "model/model.h"
#include "world/world.h"

namespace roboss {

/// `world` with its models once for each place, by the names that they have in a Model to which copies of
/// `added` were added (model/edit.h, with_models()). `added`: compiled from `world`.
World placed_copies(World world, const Model& added, std::span<const CopyPlace> places);

}  // namespace roboss
