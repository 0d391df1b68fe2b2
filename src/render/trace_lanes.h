// The tracer over the lanes of one instruction set (core/lanes.h). Only translation units that are built for
// the instruction set include this.
#pragma once

#include <cmath>
#include <cstring>

#include "core/lanes.h"
#include "render/shape_rays.h"
#include "render/trace.h"

namespace roboss::render {

template <class F>
class LaneTracer final : public Tracer {
    static_assert(F::kCount == kPacket);
    using M = typename F::Mask;
    using V = Vec3T<F>;

    static F load(const float* from) {
        F lanes;
        std::memcpy(&lanes.x, from, sizeof lanes.x);
        return lanes;
    }
    static V load(const float (&from)[3][kPacket]) { return {load(from[0]), load(from[1]), load(from[2])}; }
    static F all(double value) { return F(value); }
    static V all(const float (&v)[3]) {
        return {F(static_cast<double>(v[0])), F(static_cast<double>(v[1])), F(static_cast<double>(v[2]))};
    }
    static M mask_of(unsigned bits) {
        M mask;
        for (std::size_t i = 0; i < kPacket; ++i) mask.m[i] = (bits >> i & 1u) != 0 ? -1 : 0;
        return mask;
    }

    /// Rays in the frame of a tree or a shape.
    struct Rays {
        V o, d, inverse;
    };

    static F inverse_of(const F& d) {
        const F tiny(1e-20);
        return F(1) / select(magnitude(d) < tiny, select(d < F(0), -tiny, tiny), d);
    }
    static Rays rays_of(const V& o, const V& d) {
        return {o, d, {inverse_of(d.x), inverse_of(d.y), inverse_of(d.z)}};
    }

    struct State {
        const TraceWorld& world;
        const RayPacket& packet;
        F best, t_min;
        M active;
        PacketHits* hits = nullptr;  // null: any shadow will do
        unsigned shadowed = 0;
    };

    static M meets(const BoxNode& node, const Rays& rays, const State& s) {
        const V low = all(node.min), high = all(node.max);
        const V a{(low.x - rays.o.x) * rays.inverse.x, (low.y - rays.o.y) * rays.inverse.y,
                  (low.z - rays.o.z) * rays.inverse.z};
        const V b{(high.x - rays.o.x) * rays.inverse.x, (high.y - rays.o.y) * rays.inverse.y,
                  (high.z - rays.o.z) * rays.inverse.z};
        const F enter =
            larger(larger(smaller(a.x, b.x), smaller(a.y, b.y)), larger(smaller(a.z, b.z), s.t_min));
        const F leave = smaller(smaller(larger(a.x, b.x), larger(a.y, b.y)), larger(a.z, b.z));
        return (enter <= leave * F(1.000001)) & (enter <= s.best) & s.active;
    }

    /// Calls visit(first, count) for the leaves that rays meet, nearer ones first where they agree.
    template <class Visit>
    static void walk(const BoxNode* nodes, const Rays& rays, State& s, const Visit& visit) {
        std::uint32_t stack[BoxTree::kDepthMost];
        std::size_t depth = 0;
        stack[depth++] = 0;
        while (depth > 0) {
            const BoxNode& node = nodes[stack[--depth]];
            const unsigned met = meets(node, rays, s).bits();
            if (met == 0) continue;
            if (node.count > 0) {
                visit(node.first, node.count);
                if (s.hits == nullptr && s.active.bits() == 0) return;
                continue;
            }
            const std::size_t lane = static_cast<std::size_t>(__builtin_ctz(met));
            const BoxNode &left = nodes[node.first], &right = nodes[node.first + 1];
            double ahead = 0;
            for (std::size_t k = 0; k < 3; ++k)
                ahead += (static_cast<double>(right.min[k] + right.max[k]) -
                          static_cast<double>(left.min[k] + left.max[k])) *
                         (k == 0   ? rays.d.x
                          : k == 1 ? rays.d.y
                                   : rays.d.z)[lane];
            const std::uint32_t near = ahead >= 0 ? 0 : 1;
            stack[depth++] = node.first + 1 - near;
            stack[depth++] = node.first + near;
        }
    }

    /// Takes the hits at t, where they are nearer than those so far.
    static void take(const F& t, const M& counts, std::uint32_t item, std::uint32_t triangle, State& s) {
        const M nearer = (t < s.best) & (t > s.t_min) & s.active & counts;
        unsigned bits = nearer.bits();
        if (bits == 0) return;
        if (s.hits == nullptr) {
            s.shadowed |= bits;
            s.active = s.active & !nearer;
            return;
        }
        s.best = select(nearer, t, s.best);
        for (; bits != 0; bits &= bits - 1) {
            const std::size_t lane = static_cast<std::size_t>(__builtin_ctz(bits));
            s.hits->item[lane] = item, s.hits->triangle[lane] = triangle;
        }
    }

    static void take(const Inside<F>& in, std::uint32_t item, bool hollow, State& s) {
        const M met = in.enter <= in.leave;
        const F t = hollow ? in.enter : select(in.enter > s.t_min, in.enter, in.leave);
        take(t, met, item, kNothing, s);
    }

    static void visit_mesh(const TraceMesh& mesh, const V& o, const V& d, std::uint32_t number, bool hollow,
                           State& s) {
        if (mesh.nodes == nullptr) return;
        walk(mesh.nodes, rays_of(o, d), s, [&](std::uint32_t first, std::uint32_t count) {
            for (std::uint32_t i = first; i < first + count; ++i) {
                const TraceTriangle& triangle = mesh.triangles[i];
                const V e1 = all(triangle.e1), e2 = all(triangle.e2);
                const F t = cross_triangle(o, d, all(triangle.corner), e1, e2);
                const M front = hollow ? dot(cross(e1, e2), d) < F(0) : M(true);
                take(t, front, number, triangle.number, s);
            }
        });
    }

    static void visit_item(std::uint32_t number, const V& origin, const V& direction, State& s) {
        const TraceItem& item = s.world.items[number];
        if ((s.hits == nullptr && !item.casts) || (item.flags & s.packet.mask) == 0) return;
        const bool hollow = number >= s.packet.hollow_first && number < s.packet.hollow_last;
        const double* R = item.R_WS;
        const double w[3] = {s.packet.eye[0] - item.p_WS[0], s.packet.eye[1] - item.p_WS[1],
                             s.packet.eye[2] - item.p_WS[2]};
        V o, d;
        F *const to_o[3] = {&o.x, &o.y, &o.z}, *const to_d[3] = {&d.x, &d.y, &d.z};
        for (std::size_t k = 0; k < 3; ++k) {
            const F r0 = all(R[k]), r1 = all(R[3 + k]), r2 = all(R[6 + k]);
            *to_o[k] = all(R[k] * w[0] + R[3 + k] * w[1] + R[6 + k] * w[2]) +
                       (r0 * origin.x + r1 * origin.y + r2 * origin.z);
            *to_d[k] = r0 * direction.x + r1 * direction.y + r2 * direction.z;
        }
        const F a = all(item.size[0]), b = all(item.size[1]), c = all(item.size[2]);
        switch (item.kind) {
            case TraceKind::kPlane:
                return take(cross_rectangle(o, d, a, b), number, false, s);
            case TraceKind::kBox:
                return take(cross_box(o, d, V{a, b, c}), number, hollow, s);
            case TraceKind::kSphere:
                return take(cross_ball(o, d, a), number, hollow, s);
            case TraceKind::kCylinder:
                return take(cross_cylinder(o, d, a, b), number, hollow, s);
            case TraceKind::kCapsule:
                return take(cross_capsule(o, d, a, b), number, hollow, s);
            case TraceKind::kEllipsoid:
                return take(cross_ellipsoid(o, d, V{a, b, c}), number, hollow, s);
            case TraceKind::kCone:
                return take(cross_cone(o, d, a, b), number, hollow, s);
            case TraceKind::kMesh:
                return visit_mesh(s.world.meshes[item.mesh], o, d, number, hollow, s);
        }
    }

    static void trace(State& s) {
        const V origin = load(s.packet.origin), direction = load(s.packet.direction);
        const double* centre = s.world.centre;
        const V from_centre{origin.x + all(s.packet.eye[0] - centre[0]),
                            origin.y + all(s.packet.eye[1] - centre[1]),
                            origin.z + all(s.packet.eye[2] - centre[2])};
        const Rays rays = rays_of(from_centre, direction);
        for (const TraceTree& tree : s.world.trees) {
            if (tree.nodes == nullptr) continue;
            walk(tree.nodes, rays, s, [&](std::uint32_t first, std::uint32_t count) {
                for (std::uint32_t i = first; i < first + count; ++i)
                    visit_item(tree.first_item + tree.order[i], origin, direction, s);
            });
        }
    }

  public:
    void nearest(const TraceWorld& world, const RayPacket& rays, PacketHits& hits) const override {
        for (std::size_t i = 0; i < kPacket; ++i) hits.item[i] = hits.triangle[i] = kNothing;
        State s{world, rays, load(rays.t_max), load(rays.t_min), mask_of(rays.active), &hits, 0};
        trace(s);
        std::memcpy(hits.t, &s.best.x, sizeof hits.t);
    }
    unsigned shadowed(const TraceWorld& world, const RayPacket& rays) const override {
        State s{world, rays, load(rays.t_max), load(rays.t_min), mask_of(rays.active), nullptr, 0};
        trace(s);
        return s.shadowed;
    }
};

}  // namespace roboss::render
