// The tree of boxes that rays walk. Most updates keep its shape and move its boxes (a refit); it is built
// anew when its boxes have grown too much. What rays meet does not depend on it.
#pragma once

#include "sensors/ray_tracer.h"

namespace roboss {

class RayTree {
  public:
    /// Over these finite boxes, m; items are numbered as in `boxes`.
    void update(std::span<const Aabb> boxes);
    /// For tracers, with the items that the boxes are of. Valid until the next update.
    RayTreeView view(std::span<const RayItem> items) const;

  private:
    void build(std::span<const Aabb> boxes);
    /// The sum of the areas of all boxes, m^2.
    double refit(std::span<const Aabb> boxes);

    render::BoxTree tree_;
    Vec3 centre_;
    double extent_ = 0, margin_ = 0, area_ = 0;  // area_: when it was built
};

}  // namespace roboss
