// A surface as the file describes it becomes the numbers that the physics reads.
#include <algorithm>

#include "model/compile_type.h"
#include "model/may_collide.h"

namespace roboss {

Material to_material(const SurfaceSpec& surface) {
    constexpr double kFrictionMax = 1e6;  // "infinite" friction, and still a number to multiply
    Material m;
    m.mu = std::min(surface.mu, kFrictionMax);
    m.mu2 = m.mu;
    if (const double length = norm(surface.fdir1); length > 0) {
        m.direction_S = surface.fdir1 / length;
        m.mu2 = std::min(surface.mu2, kFrictionMax);
    }
    m.restitution = surface.restitution;
    m.bounce_threshold = surface.bounce_threshold;
    m.torsional_mu = surface.torsional_mu;
    m.patch_radius = surface.torsional_radius;
    m.surface_radius = surface.torsional_surface_radius;
    m.rolling = surface.rolling_mu;
    m.stiffness = surface.stiffness;
    m.damping = surface.damping;
    m.slop = std::max(m.slop, surface.min_depth);
    if (surface.max_vel >= 0) m.correction_speed = std::min(m.correction_speed, surface.max_vel);
    if (surface.max_contacts >= 0) m.contacts_max = static_cast<std::uint32_t>(surface.max_contacts);
    m.collide_bitmask = surface.collide_bitmask;
    m.category_bitmask = surface.category_bitmask;
    return m;
}

bool may_collide(const Material& a, const Material& b) {
    return ((a.category_bitmask & b.collide_bitmask) | (b.category_bitmask & a.collide_bitmask)) != 0;
}

void add_to_hash(Hash& hash, const Material& m) {
    for (double x : {m.mu, m.mu2, m.direction_S.x, m.direction_S.y, m.direction_S.z, m.restitution,
                     m.bounce_threshold, m.torsional_mu, m.patch_radius, m.surface_radius, m.rolling,
                     m.stiffness, m.damping, m.slop, m.correction_speed})
        hash.add(x);
    for (std::uint32_t x : {m.contacts_max, m.collide_bitmask, m.category_bitmask})
        hash.add(static_cast<std::uint64_t>(x));
}

}  // namespace roboss
