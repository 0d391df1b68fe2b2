// See drag.h.
#include "physics/dynamics/drag.h"

namespace roboss {
namespace {

struct LinkAir {
    Vec3 arm;           // link's centre from O
    Vec3 relative;      // velocity through the air
    Vec3 wind;          // velocity of the air
    double factor = 0;  // force = -factor * relative, N s/m
};

const Link& link_of(const RobotWork& work, const LinkDrag& drag) {
    return work.type->links[drag.link.index()];
}

/// 1/s: how strongly the wind carries a link along at this place.
double carrying(const Model& model, const Vec3& p) {
    for (const WindRegion& region : model.wind_regions)
        if (region.holds(p)) return region.factor(p);
    return 0;
}

LinkAir air_of(const Model& model, const RobotWork& work, const LinkDrag& drag) {
    const Link& link = link_of(work, drag);
    const BodyWork& body = work.bodies[static_cast<std::size_t>(link.body)];
    LinkAir air;
    air.arm = body.X_WB * link.p_BC - work.origin;
    if (drag.wind) air.wind = wind_of(model, work);
    air.relative = body.velocity.linear + cross(body.velocity.angular, air.arm) - air.wind;
    const Vec3 u_L = transpose_times(link.X_BL.R, transpose_times(body.X_WB.R, air.relative));
    // |A(u)| |u|: the length of the vector of areas times velocities
    const double flow = norm(Vec3{drag.area.x * u_L.x, drag.area.y * u_L.y, drag.area.z * u_L.z});
    air.factor = 0.5 * model.air_density * flow + drag.linear;
    if (drag.carried != 0) air.factor += drag.carried * carrying(model, body.X_WB * link.X_BL.p);
    return air;
}

}  // namespace

void add_drag(const Model& model, double dt, bool implicit, RobotWork& work) {
    for (const LinkDrag& drag : work.type->drags) {
        const LinkAir air = air_of(model, work, drag);
        BodyWork& body = work.bodies[static_cast<std::size_t>(link_of(work, drag).body)];
        const double weight = dt * air.factor;
        if (implicit) {  // force = factor * (wind - v at the end): a point mass that moves with the wind
            body.inertia += spatial_inertia(weight, air.arm, Sym3{});
            body.impulse += Spatial{cross(air.arm, air.wind), air.wind} * weight;
        } else {
            body.impulse += Spatial{cross(air.arm, air.relative), air.relative} * -weight;
        }
    }
}

Spatial drag_force(const Model& model, const RobotWork& work, const LinkDrag& drag) {
    const LinkAir air = air_of(model, work, drag);
    return Spatial{cross(air.arm, air.relative), air.relative} * -air.factor;
}

bool drag_is_stiff(const Model& model, const RobotWork& work) {
    constexpr double kRateMax = 0.25;  // a tick times the rate at which drag alone would stop the body
    for (const LinkDrag& drag : work.type->drags) {
        const Body& body = work.type->bodies[static_cast<std::size_t>(link_of(work, drag).body)];
        if (model.dt_s * air_of(model, work, drag).factor * body.inverse_mass_linear > kRateMax) return true;
    }
    return false;
}

}  // namespace roboss
