// The ray tracer on any processor, where the compiler makes eight lanes of what there is; the choice; and
// what all tracers share.
#include "sensors/ray_tracer.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"
#include "geometry/triangle_surface.h"
#include "sensors/ray_lanes.h"

namespace roboss {
namespace {

/// Lanes by the language alone.
struct AnyRaySet {
    using Floats [[gnu::vector_size(32)]] = float;
    using Doubles [[gnu::vector_size(32)]] = double;
    using Bits32 [[gnu::vector_size(32)]] = std::int32_t;
    using Bits64 [[gnu::vector_size(32)]] = std::int64_t;
    static Doubles sqrt(Doubles x) {
        for (std::size_t i = 0; i < 4; ++i) x[i] = std::sqrt(x[i]);
        return x;
    }
    static Floats magnitude(Floats x) { return x < 0.0F ? -x : x; }
    static Doubles magnitude(Doubles x) { return x < 0.0 ? -x : x; }
    static unsigned bits(Bits32 m) {
        unsigned bits = 0;
        for (std::size_t i = 0; i < 8; ++i) bits |= m[i] != 0 ? 1u << i : 0u;
        return bits;
    }
    static unsigned bits(Bits64 m) {
        unsigned bits = 0;
        for (std::size_t i = 0; i < 4; ++i) bits |= m[i] != 0 ? 1u << i : 0u;
        return bits;
    }
};

std::unique_ptr<RayTracer> make_best() {
    if (auto tracer = make_avx2_ray_tracer()) return tracer;
    return make_any_ray_tracer();
}

/// Where a ray enters the cube |x|, |y|, |z| <= half, at least 0; +infinity if it misses it.
double enter_cube(const Vec3& o, const Vec3& d, double half) {
    double enter = 0, leave = kInfinity;
    for (std::size_t i = 0; i < 3; ++i) {
        if (std::fabs(d[i]) < 1e-300) {
            if (std::fabs(o[i]) > half) return kInfinity;
            continue;
        }
        const double a = (-half - o[i]) / d[i], b = (half - o[i]) / d[i];
        enter = fixed_max(enter, fixed_min(a, b));
        leave = fixed_min(leave, fixed_max(a, b));
    }
    return enter <= leave ? enter : kInfinity;
}

}  // namespace

std::unique_ptr<RayTracer> make_any_ray_tracer() {
    return std::make_unique<LaneRayTracer<Lanes<float, 8, AnyRaySet>, Lanes<double, 4, AnyRaySet>>>();
}

const RayTracer& best_ray_tracer() {
    static const std::unique_ptr<RayTracer> best = make_best();
    return *best;
}

void take_hit(RayPacket& packet, std::size_t i, double distance, const RayItem& item,
              std::span<const RayItem> among) {
    const RayItem* known = packet.hit[i];
    const bool earlier = known > &item && known < among.data() + among.size();
    if (!(distance < packet.nearest[i]) && !(distance == packet.nearest[i] && earlier)) return;
    packet.nearest[i] = distance, packet.hit[i] = &item;
}

unsigned trace_surface(const RayItem& item, std::span<const RayItem> among, unsigned wanted,
                       RayPacket& packet) {
    unsigned changed = 0;
    for (; wanted != 0; wanted &= wanted - 1) {
        const auto i = static_cast<std::size_t>(__builtin_ctz(wanted));
        const Vec3 origin{packet.origin[0][i], packet.origin[1][i], packet.origin[2][i]};
        const Vec3 direction{packet.direction[0][i], packet.direction[1][i], packet.direction[2][i]};
        const Vec3 o = transpose_times(item.X_WS.R, origin - item.X_WS.p);
        const Vec3 d = transpose_times(item.X_WS.R, direction);
        const double limit =
            std::nextafter(packet.nearest[i], kInfinity);  // equal distances count (take_hit)
        const double t = item.shape.surface->ray(o, d, limit);
        if (!(t <= packet.nearest[i])) continue;
        take_hit(packet, i, t, item, among);
        changed |= 1u << i;
    }
    return changed;
}

void start_rays(const RayTreeView& tree, const RayPacket& packet, RayStarts& starts) {
    for (std::size_t i = 0; i < kRays; ++i) {
        const Vec3 o{packet.origin[0][i] - tree.centre.x, packet.origin[1][i] - tree.centre.y,
                     packet.origin[2][i] - tree.centre.z};
        const double farthest = std::max({std::fabs(o.x), std::fabs(o.y), std::fabs(o.z)});
        double skip = 0;
        const Vec3 d{packet.direction[0][i], packet.direction[1][i], packet.direction[2][i]};
        if (farthest > tree.extent) skip = enter_cube(o, d, tree.extent);
        starts.skipped[i] = skip;
        const double along = skip < kInfinity ? skip : 0;
        for (std::size_t k = 0; k < 3; ++k) starts.origin[k][i] = static_cast<float>(o[k] + d[k] * along);
    }
}

}  // namespace roboss
