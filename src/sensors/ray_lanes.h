// The ray tracer over the lanes of one instruction set (core/lanes.h): F is eight floats, D some doubles.
// Only translation units that are built for the instruction set include this.
#pragma once

#include <cstring>

#include "core/lanes.h"
#include "sensors/ray_intervals.h"
#include "sensors/ray_tracer.h"

namespace roboss {

template <class F, class D>
class LaneRayTracer final : public RayTracer {
    static_assert(F::kCount == kRays && kRays % D::kCount == 0);
    static constexpr std::size_t kParts = kRays / D::kCount;
    static constexpr std::uint32_t kDepthMost = render::BoxTree::kDepthMost;

    template <class T, class Number>
    static T load(const Number* from) {
        T lanes;
        std::memcpy(&lanes.x, from, sizeof lanes.x);
        return lanes;
    }
    static F all(float x) { return F(static_cast<double>(x)); }

    /// The rays in the frame of a tree; a ray is at o + t d there, with t from where it enters.
    struct Walk {
        F o[3], inverse[3];
        F limit;  // of t
        RayStarts starts;
        bool up[3];  // whether most rays go towards larger coordinates
    };

    static F inverse_of(const F& d) {
        const F tiny(1e-20);
        return F(1) / select(magnitude(d) < tiny, select(d < F(0), -tiny, tiny), d);
    }

    static void set_limit(const RayTreeView& tree, const RayPacket& packet, std::size_t i, Walk& walk) {
        const double left = packet.nearest[i] - walk.starts.skipped[i], most = 4 * tree.extent;
        const bool counts = (packet.active >> i & 1u) != 0 && left > 0;
        walk.limit.set(i, counts ? (left < most ? left : most) + tree.margin : -1.0);
    }

    static bool begin(const RayTreeView& tree, const RayPacket& packet, Walk& walk) {
        start_rays(tree, packet, walk.starts);
        for (std::size_t k = 0; k < 3; ++k) {
            walk.o[k] = load<F>(walk.starts.origin[k]);
            F d;
            for (std::size_t i = 0; i < kRays; ++i) d.set(i, packet.direction[k][i]);
            walk.inverse[k] = inverse_of(d);
            walk.up[k] = __builtin_popcount((d >= F(0)).bits()) * 2 >= static_cast<int>(kRays);
        }
        for (std::size_t i = 0; i < kRays; ++i) set_limit(tree, packet, i, walk);
        return (walk.limit >= F(0)).bits() != 0;
    }

    /// Bit i: ray i meets the box before its limit.
    static unsigned meets(const render::BoxNode& node, const Walk& w) {
        F enter(0), leave = w.limit;
        for (std::size_t k = 0; k < 3; ++k) {
            const F a = (all(node.min[k]) - w.o[k]) * w.inverse[k];
            const F b = (all(node.max[k]) - w.o[k]) * w.inverse[k];
            enter = larger(enter, smaller(a, b)), leave = smaller(leave, larger(a, b));
        }
        return (enter <= leave).bits();
    }

    /// Bit i: what ray i knows became another.
    static unsigned visit(const RayItem& item, std::span<const RayItem> among, unsigned wanted,
                          RayPacket& packet) {
        if (item.robot.valid() && item.robot == packet.self && item.link == packet.self_link) return 0;
        if (item.shape.kind == ShapeKind::kSurface) return trace_surface(item, among, wanted, packet);
        unsigned changed = 0;
        const Mat3T<D> R = broadcast<D>(item.X_WS.R);
        for (std::size_t part = 0; part < kParts; ++part) {
            const std::size_t at = part * D::kCount;
            unsigned bits = wanted >> at & kAllLanes<D>;
            if (bits == 0) continue;
            Vec3T<D> o, d;
            for (std::size_t k = 0; k < 3; ++k)
                o[k] = load<D>(&packet.origin[k][at]) - D(item.X_WS.p[k]),
                d[k] = load<D>(&packet.direction[k][at]);
            o = transpose_times(R, o), d = transpose_times(R, d);
            const D t = ray_shapes::first_crossing(
                ray_shapes::cross_shape(item.shape, item.faces, item.face_count, o, d));
            bits &= (t <= load<D>(&packet.nearest[at])).bits();
            changed |= bits << at;
            for (; bits != 0; bits &= bits - 1) {
                const auto i = static_cast<std::size_t>(__builtin_ctz(bits));
                take_hit(packet, at + i, t[i], item, among);
            }
        }
        return changed;
    }

    static void walk(const RayTreeView& tree, RayPacket& packet) {
        Walk w;
        if (!begin(tree, packet, w)) return;
        std::uint32_t stack[kDepthMost];
        std::size_t depth = 0;
        stack[depth++] = 0;
        while (depth > 0) {
            const render::BoxNode& node = tree.nodes[stack[--depth]];
            const unsigned met = meets(node, w);
            if (met == 0) continue;
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                unsigned changed = visit(tree.items[tree.order[i]], tree.items, met & packet.active, packet);
                for (; changed != 0; changed &= changed - 1)
                    set_limit(tree, packet, static_cast<std::size_t>(__builtin_ctz(changed)), w);
            }
            if (node.count > 0) continue;
            const std::uint32_t near =
                left_is_nearer(tree.nodes[node.first], tree.nodes[node.first + 1], w) ? 0 : 1;
            stack[depth++] = node.first + 1 - near;
            stack[depth++] = node.first + near;
        }
    }

    static bool left_is_nearer(const render::BoxNode& left, const render::BoxNode& right, const Walk& w) {
        float ahead = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const float apart = (right.min[k] + right.max[k]) - (left.min[k] + left.max[k]);
            ahead += w.up[k] ? apart : -apart;
        }
        return ahead >= 0;
    }

  public:
    void trace(const RayWorld& world, RayPacket& packet) const override {
        for (const RayItem*& hit : packet.hit) hit = nullptr;
        for (const std::span<const RayItem>& planes : world.planes)
            for (const RayItem& plane : planes) (void)visit(plane, planes, packet.active, packet);
        for (const RayTreeView& tree : world.trees)
            if (tree.nodes != nullptr) walk(tree, packet);
    }
};

}  // namespace roboss
