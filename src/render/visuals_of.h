// What hands the visuals of a Model to those who read cameras.
#pragma once

#include <functional>
#include <memory>

#include "model/model.h"

namespace roboss::render {

class VisualWorld;

/// The visuals of a Model (visuals/visual_source.h makes one); called when the first camera of a run is read.
using VisualsOf = std::function<std::shared_ptr<const VisualWorld>(const Model&)>;

}  // namespace roboss::render
