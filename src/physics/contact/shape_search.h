// Which shapes of robots, and of the scenery, are so near to each other that the narrow phase has to look at
// them: shapes by their boxes, crowds of shapes (ShapeGroups) by the trees of their bodies, before any is
// placed.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "physics/dynamics/shape_places.h"

namespace roboss {

class ShapeSearch {
  public:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;

    // Each ascending, and valid until the next call. Sleepers must be placed.
    /// Shape of a, shape of b.
    std::span<const Pair> between(const RobotWork& a, const RobotWork& b);
    /// Two shapes of bodies that may touch; the lower number first.
    std::span<const Pair> within(const RobotWork& robot);
    /// Shape of a body of the robot, number in Model::statics.
    std::span<const Pair> with_scenery(const Model& model, const RobotWork& robot);
    /// Shapes of the robot that may be in the box.
    std::span<const std::uint32_t> in_box(const RobotWork& robot, const Aabb& box);

  private:
    struct Crowd;
    static Crowd crowd_of(const RobotWork& robot, std::size_t k);
    template <class Add>
    static void find_in(const Crowd& crowd, const Aabb& box, Add add);
    template <class Add>
    static void find_at(const Crowd& crowd, const StaticShape& scenery, const Aabb& box, Add add);
    void between_crowds(const Crowd& a, const Crowd& b, bool sorts);
    void between_bodies(const RobotWork& robot, int body_a, int body_b);
    void sort();

    std::vector<Pair> pairs_;
    std::vector<std::uint32_t> near_a_, near_b_;  // shapes that are in no crowd
    std::vector<std::uint32_t> scenery_;
    std::vector<Aabb> boxes_;  // of the scenery, or of a robot's bodies
};

}  // namespace roboss
