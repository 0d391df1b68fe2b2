// VisualSource: the visuals of Models for cameras, from the Worlds that the Models were compiled from. It
// decodes pictures and builds trees when the first camera asks, once for all runs of a Model.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "render/visuals_of.h"
#include "scene/scene.h"
#include "world/world.h"

namespace roboss {

/// What cameras see of a Scene, which must be of `model`.
std::shared_ptr<const render::VisualWorld> visual_world(const Scene& scene, const Model& model);

/// May be used by several threads at once.
class VisualSource {
  public:
    /// As for make_scene(): a later World hides the names of an earlier one.
    explicit VisualSource(std::vector<std::shared_ptr<const World>> worlds) : worlds_(std::move(worlds)) {}

    /// What robots of this Model and its scenery look like. Robots that no World describes show their
    /// collision shapes.
    std::shared_ptr<const render::VisualWorld> of(const Model& model);

  private:
    std::vector<std::shared_ptr<const World>> worlds_;
    std::mutex mutex_;
    std::shared_ptr<const render::VisualWorld> last_;
};

/// The same as a function, for RunAccess and Clients.
render::VisualsOf visuals_of(std::vector<std::shared_ptr<const World>> worlds);

}  // namespace roboss
