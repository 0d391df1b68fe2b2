// Eight rays at once against the shapes of a scene. Which shape a ray meets first is chosen in floats by
// operations in a fixed order, eight lanes on every processor, so the choice has the same bits everywhere;
// what is measured on the shape that was chosen is measured in doubles (exact_hit.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "render/box_tree.h"

namespace roboss::render {

inline constexpr std::size_t kPacket = 8;
inline constexpr std::uint32_t kNothing = 0xFFFFFFFFu;

/// As in scene/scene.h, in the order of its enumerators.
enum class TraceKind : std::uint32_t { kPlane, kBox, kSphere, kCylinder, kCapsule, kEllipsoid, kMesh, kCone };

struct TraceTriangle {
    float corner[3], e1[3], e2[3];  // m, in the frame of the mesh
    std::uint32_t number = 0;       // in the mesh
};

struct TraceMesh {
    const BoxNode* nodes = nullptr;
    const TraceTriangle* triangles = nullptr;  // by leaf
};

/// A shape at its place in the world.
struct TraceItem {
    double R_WS[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // row by row
    double p_WS[3] = {0, 0, 0};                    // m
    TraceKind kind = TraceKind::kBox;
    double size[3] = {0, 0, 0};        // half edges or radii; cylinder, capsule, cone: radius, half length
    std::uint32_t mesh = 0;            // in TraceWorld::meshes
    bool casts = true;                 // shadows
    std::uint32_t flags = 0xFFFFFFFF;  // rays see it whose `mask` has one of these bits
};

struct TraceTree {
    const BoxNode* nodes = nullptr;  // null: empty
    const std::uint32_t* order = nullptr;
    std::uint32_t first_item = 0;  // of its items in TraceWorld::items
};

struct TraceWorld {
    TraceTree trees[2];            // what stands still, what moves
    double centre[3] = {0, 0, 0};  // that the trees' boxes are relative to
    const TraceItem* items = nullptr;
    const TraceMesh* meshes = nullptr;
};

struct alignas(32) RayPacket {
    float origin[3][kPacket];     // m, from `eye`, world axes
    float direction[3][kPacket];  // any length; t is in units of it
    float t_min[kPacket], t_max[kPacket];
    double eye[3] = {0, 0, 0};        // m, world
    unsigned active = 0;              // bit i: lane i counts
    std::uint32_t mask = 0xFFFFFFFF;  // of the items that are seen
    /// Of these items, back faces are not seen: the camera looks out of its own housing.
    std::uint32_t hollow_first = 0, hollow_last = 0;
};

struct alignas(32) PacketHits {
    float t[kPacket];
    std::uint32_t item[kPacket], triangle[kPacket];  // kNothing: nothing is met
};

class Tracer {
  public:
    virtual ~Tracer() = default;
    /// What each ray meets first between t_min and t_max.
    virtual void nearest(const TraceWorld& world, const RayPacket& rays, PacketHits& hits) const = 0;
    /// Bit i: something that casts shadows is between t_min and t_max of ray i.
    virtual unsigned shadowed(const TraceWorld& world, const RayPacket& rays) const = 0;
};

/// The fastest one that this processor can run. All give the same bits.
const Tracer& best_tracer();
/// For tests: null where the processor, or the compiler, has none.
std::unique_ptr<Tracer> make_avx2_tracer();
std::unique_ptr<Tracer> make_any_tracer();

}  // namespace roboss::render
