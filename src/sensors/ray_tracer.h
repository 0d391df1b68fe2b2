// Eight rays at once against shapes: trees of boxes are walked in floats, which only cull, and the distance
// to a shape is computed in doubles, in the lanes of registers, with the bits of ray_distance()
// (sensors/ray_shape.h). So what is measured depends on no tree and no instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/types.h"
#include "geometry/convex_hull.h"
#include "geometry/shape.h"
#include "render/box_tree.h"

namespace roboss {

inline constexpr std::size_t kRays = 8;

/// A shape at its place in the world.
struct RayItem {
    Shape shape;
    Transform X_WS;
    RobotId robot;  // that it belongs to, if any
    LinkId link;
    double retro = 0;                         // laser_retro
    const ConvexHull::Face* faces = nullptr;  // of a hull
    std::size_t face_count = 0;
};

/// A tree over items. Its boxes are relative to `centre`, within a cube of half edges `extent` about it, and
/// wider than the items by `margin`, which is more than all roundings of floats that a ray within that cube
/// meets.
struct RayTreeView {
    const render::BoxNode* nodes = nullptr;  // null: empty
    const std::uint32_t* order = nullptr;
    std::span<const RayItem> items;
    Vec3 centre;                    // m, world
    double extent = 0, margin = 0;  // m
};

/// What rays may meet.
struct RayWorld {
    std::span<const RayItem> planes[2];  // of scenery, of robots
    RayTreeView trees[2];
};

struct alignas(64) RayPacket {
    double origin[3][kRays], direction[3][kRays];  // m, world; unit vectors
    /// Limit of each ray in m, and then the distance of its nearest hit below that.
    double nearest[kRays];
    const RayItem* hit[kRays];  // null: none
    unsigned active = 0;        // bit i: lane i counts
    RobotId self;               // of this robot, the shapes of this link are not seen
    LinkId self_link;
};

class RayTracer {
  public:
    virtual ~RayTracer() = default;
    /// Finds the nearest hits. Of hits at equal distances, the one of the first item of the first span or
    /// tree.
    virtual void trace(const RayWorld& world, RayPacket& packet) const = 0;
};

/// The fastest one that this processor can run. All give the same bits.
const RayTracer& best_ray_tracer();
/// For tests: null where the processor, or the compiler, has none.
std::unique_ptr<RayTracer> make_avx2_ray_tracer();
std::unique_ptr<RayTracer> make_any_ray_tracer();

/// Takes a hit at `distance` for lane i unless something nearer is known. Of items at equal distances the
/// first one counts; `among`: the items that this one is of.
void take_hit(RayPacket& packet, std::size_t i, double distance, const RayItem& item,
              std::span<const RayItem> among);
/// Takes the hits on a surface of triangles, in the lanes of `wanted`; code for every processor. Whether a
/// hit was nearer in a lane: its bit.
unsigned trace_surface(const RayItem& item, std::span<const RayItem> among, unsigned wanted,
                       RayPacket& packet);
/// Where the rays begin in a tree: from its centre in m, in floats, and how far from their origins in m,
/// +infinity where a ray passes the tree.
struct alignas(64) RayStarts {
    float origin[3][kRays];
    double skipped[kRays];
};
void start_rays(const RayTreeView& tree, const RayPacket& packet, RayStarts& starts);

}  // namespace roboss
