// What hands the visuals of a Model to those who read cameras.
#pragma once

#include <functional>
#include <memory>

#include "core/result.h"
#include "model/model.h"

namespace roboss::render {

class VisualWorld;

/// The visuals of a Model (visuals/visual_source.h makes one); called when the first camera of a run is read.
/// Errors: "no-look", there are none; "changed-world", the run has another Model by now; others of the
/// network.
using VisualsOf = std::function<Result<std::shared_ptr<const VisualWorld>>(const Model&)>;

}  // namespace roboss::render
