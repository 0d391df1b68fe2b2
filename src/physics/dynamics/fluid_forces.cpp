// See fluid_forces.h. Added mass is an inertia A like that of a rigid body (Kirchhoff's equations: Lamb,
// Hydrodynamics, 1932, chapter 6), of a full 6x6 matrix: about the link's origin, with the velocity v_r
// through water that flows evenly with c, the force is -(A (a + [w x c]) + v_r x* A v_r).
#include "physics/dynamics/fluid_forces.h"

#include <algorithm>
#include <cmath>

#include "geometry/submerged.h"
#include "physics/dynamics/drag.h"
#include "physics/dynamics/flow_laws.h"

namespace roboss {
namespace {

/// A link in motion: axes of the link, at its origin.
struct LinkMotion {
    int body = 0;
    Mat3 R_WL;
    Vec3 arm;              // link's origin from O, world axes
    Spatial velocity;      // against the world
    Spatial acceleration;  // that the bodies' bias stands for
};

Spatial into_link(const Mat3& R_WL, const Vec3& arm, const Spatial& motion) {
    return {transpose_times(R_WL, motion.angular),
            transpose_times(R_WL, motion.linear + cross(motion.angular, arm))};
}

/// About O, world axes.
Spatial out_of_link(const LinkMotion& m, const Spatial& force) {
    const Vec3 f = m.R_WL * force.linear;
    return {m.R_WL * force.angular + cross(m.arm, f), f};
}

LinkMotion motion_of(const RobotWork& work, LinkId id, std::span<const Spatial> accelerations = {}) {
    const Link& link = work.type->links[id.index()];
    const auto b = static_cast<std::size_t>(link.body);
    const BodyWork& body = work.bodies[b];
    LinkMotion m;
    m.body = link.body;
    m.R_WL = body.X_WB.R * link.X_BL.R;
    m.arm = body.X_WB * link.X_BL.p - work.origin;
    m.velocity = into_link(m.R_WL, m.arm, body.velocity);
    const Spatial a = accelerations.empty() ? body.bias : body.bias + accelerations[b];
    m.acceleration = into_link(m.R_WL, m.arm, a);
    return m;
}

Spatial times(const Matrix6& M, const Spatial& motion) {
    const double s[6] = {motion.linear.x,  motion.linear.y,  motion.linear.z,
                         motion.angular.x, motion.angular.y, motion.angular.z};
    double f[6];
    for (std::size_t i = 0; i < 6; ++i) {
        f[i] = 0;
        for (std::size_t j = 0; j < 6; ++j) f[i] += M[6 * i + j] * s[j];
    }
    return {{f[3], f[4], f[5]}, {f[0], f[1], f[2]}};
}

/// One law on one link: a force that depends on the velocity, and an inertia.
struct Law {
    LinkMotion motion;
    FlowForce flow;
    Matrix6 added{};           // mass
    bool has_inertia = false,  // `added` counts as inertia
        has_coriolis = false;  // and in forces of turning with it
    Vec3 current;              // m/s, of the water, link axes
    FlowVelocity velocity;     // that `flow` was found at
    bool is_wing = false;      // it may push across the flow
};

FlowVelocity through(const LinkMotion& m, const Vec3& fluid_W) {
    return {m.velocity.linear - transpose_times(m.R_WL, fluid_W), m.velocity.angular};
}

Vec3 current_of(const RobotWork& work, const OnboardInfo& info, const HydrodynamicsSpec& spec) {
    const ChannelInfo& channel = work.type->channels[static_cast<std::size_t>(info.channels[0])];
    const double* command = work.state->onboard.data() + channel.index;
    return command[0] >= 0 ? Vec3{command[1], command[2], command[3]} : spec.current;
}

/// The water's velocity at a link: that of its Hydrodynamics, if it has one.
Vec3 current_at(const RobotWork& work, LinkId link) {
    for (const OnboardInfo& info : work.type->onboard)
        if (const auto* spec = std::get_if<HydrodynamicsSpec>(&info.spec.parameters))
            if (info.links[0] == link) return current_of(work, info, *spec);
    return {};
}

Matrix6 full_matrix(const std::vector<double>& upper) {
    Matrix6 M;
    for (std::size_t i = 0, k = 0; i < 6; ++i)
        for (std::size_t j = i; j < 6; ++j) M[6 * i + j] = M[6 * j + i] = upper[k++];
    return M;
}

Matrix6 added_mass_of(const HydrodynamicsSpec& spec) {
    Matrix6 M;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            M[6 * i + j] = -0.5 * (spec.added_mass[6 * i + j] + spec.added_mass[6 * j + i]);
    return M;
}

/// The moment of flow round a hull that moves at an angle to it (Munk) is in the hull's own law; that of the
/// link's added mass is taken off again.
Vec3 munk_moment(const RobotWork& work, LinkId link, const Vec3& velocity) {
    for (const LinkFluid& fluid : work.type->fluids) {
        if (fluid.link != link || fluid.added_mass.empty()) continue;
        const Matrix6 mass = full_matrix(fluid.added_mass);
        const Spatial momentum = times(mass, {{}, velocity});
        return cross(velocity, momentum.linear);
    }
    return {};
}

bool is_zero(const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double x) { return x == 0; });
}

/// What flows round a fin by itself: the wind, which blows in gases only.
Vec3 wind_in(double density, const Model& model, const RobotWork& work) {
    constexpr double kDensestGas = 100;  // kg/m^3
    return density < kDensestGas ? wind_of(model, work) : Vec3{};
}

/// A controller's law; false: it is none. `ahead`: m/s, what a wing moves faster by than it does.
bool law_of(const Model& model, const RobotWork& work, const OnboardInfo& info, std::span<const double> q,
            std::span<const Spatial> accelerations, const Vec3& ahead, Law& law) {
    if (info.links.empty() || work.type->links[info.links[0].index()].body < 0) return false;
    const auto start = [&] {
        law = {};
        law.motion = motion_of(work, info.links[0], accelerations);
    };
    const auto angle = [&](std::size_t k) { return q[static_cast<std::size_t>(info.axes[k].q_index)]; };
    if (const auto* wing = std::get_if<LiftDragSpec>(&info.spec.parameters)) {
        start();
        const double control = info.axes.empty() ? 0.0 : angle(0);
        law.velocity = through(law.motion, wind_in(wing->density, model, work) - ahead);
        law.flow = lift_drag_force(*wing, law.velocity, control);
        law.is_wing = true;
        return true;
    }
    if (const auto* plane = std::get_if<AdvancedLiftDragSpec>(&info.spec.parameters)) {
        start();
        constexpr std::size_t kMost = 32;
        std::array<double, kMost> angles{};
        const std::size_t count = std::min(info.axes.size(), kMost);
        for (std::size_t k = 0; k < count; ++k) angles[k] = angle(k);
        law.velocity = through(law.motion, wind_in(plane->density, model, work) - ahead);
        law.flow = aeroplane_force(*plane, law.velocity, std::span(angles));
        law.is_wing = true;
        return true;
    }
    if (const auto* hull = std::get_if<LighterThanAirSpec>(&info.spec.parameters)) {
        start();
        law.velocity = through(law.motion, wind_of(model, work) - ahead);
        law.flow = hull_force(*hull, law.velocity);
        law.is_wing = true;
        const Vec3 current = transpose_times(law.motion.R_WL, current_at(work, info.links[0]));
        law.flow.torque += munk_moment(work, info.links[0], law.motion.velocity.linear - current);
        return true;
    }
    if (const auto* water = std::get_if<HydrodynamicsSpec>(&info.spec.parameters)) {
        start();
        const Vec3 current = current_of(work, info, *water);
        law.velocity = through(law.motion, current);
        law.flow = water_damping(*water, law.velocity);
        law.current = transpose_times(law.motion.R_WL, current);
        if (is_zero(water->added_mass)) return true;
        law.added = added_mass_of(*water);
        law.has_inertia = !water->no_added_mass, law.has_coriolis = !water->no_coriolis;
        return true;
    }
    return false;
}

Law added_mass_law(const RobotWork& work, const LinkFluid& fluid, std::span<const Spatial> accelerations) {
    Law law;
    law.motion = motion_of(work, fluid.link, accelerations);
    law.added = full_matrix(fluid.added_mass);
    law.has_inertia = law.has_coriolis = true;
    law.current = transpose_times(law.motion.R_WL, current_at(work, fluid.link));
    return law;
}

/// Calls visit(law, link) for each law of the robot.
template <class Visit>
void for_each_law(const Model& model, const RobotWork& work, std::span<const double> q,
                  std::span<const Spatial> accelerations, Visit&& visit, const Vec3& ahead = {}) {
    for (const LinkFluid& fluid : work.type->fluids)
        if (!fluid.added_mass.empty()) visit(added_mass_law(work, fluid, accelerations), fluid.link);
    Law law;
    for (const OnboardInfo& info : work.type->onboard)
        if (law_of(model, work, info, q, accelerations, ahead, law)) visit(law, info.links[0]);
}

/// Force of a law, link axes, at the link's origin.
Spatial force_of(const Law& law) {
    Spatial force{law.flow.torque, law.flow.force};
    const Spatial& v = law.motion.velocity;
    if (law.has_inertia) {
        Spatial a = law.motion.acceleration;
        a.linear += cross(v.angular, law.current);
        force += times(law.added, a) * -1.0;
    }
    if (law.has_coriolis) {
        const Spatial through_water{v.angular, v.linear - law.current};
        force += cross_force(through_water, times(law.added, through_water)) * -1.0;
    }
    return force;
}

/// Mass of the fluid that a shape displaces, and its first moment from the shape's origin.
Submerged displaced(const FluidLayers& fluid, const Shape& shape, const Transform& X_WS) {
    Submerged mass;
    mass.volume = solid_volume(shape) * fluid.densities.back();
    for (std::size_t i = 0; i < fluid.heights.size(); ++i) {
        const double denser = fluid.densities[i] - fluid.densities[i + 1];
        const Submerged part = submerged_part(shape, X_WS, fluid.heights[i]);
        mass.volume += part.volume * denser, mass.moment += part.moment * denser;
    }
    return mass;
}

/// What the fluids' pressure does to a link, about O.
Spatial buoyancy(const Model& model, const RobotWork& work, const LinkFluid& fluid) {
    const std::vector<BodyShape>& shapes = work.type->shapes;
    const Vec3 gravity = gravity_of(model, *work.type);
    Spatial sum{};
    auto shape = std::ranges::lower_bound(shapes, fluid.link, {}, &BodyShape::link);
    for (; shape != shapes.end() && shape->link == fluid.link; ++shape) {
        const Transform X_WS = work.bodies[static_cast<std::size_t>(shape->body)].X_WB * shape->X_BS;
        const Submerged mass = displaced(model.fluid, shape->shape, X_WS);
        const Vec3 moment = mass.moment + (X_WS.p - work.origin) * mass.volume;
        sum += Spatial{cross(moment, gravity), gravity * mass.volume} * -1.0;
    }
    return sum;
}

bool floats(const Model& model, const LinkFluid& fluid) {
    return fluid.buoyant && !model.fluid.densities.empty();
}

FlowWork& add_flow(const LinkMotion& m, Mechanics<double>& work) {
    FlowWork& flow = work.flows.emplace_back();
    flow.body = m.body, flow.R_WL = m.R_WL, flow.arm = m.arm;
    return flow;
}

/// Rate, times dt, at which damping alone would stop the link's body.
double stopping(const Body& body, const Link& link, const Law& law, double dt) {
    const Vec3 centre = transpose_times(link.X_BL.R, body.p_BC - link.X_BL.p);
    const auto rate = [&](const Spatial& motion, double mobility) {
        const double inertia = law.has_inertia ? dot(times(law.added, motion), motion) : 0.0;
        return dt * dot(times(law.flow.damping, motion), motion) / (1 / mobility + inertia);
    };
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        Vec3 axis;
        axis[k] = 1;
        most = std::max(most, rate({{}, axis}, body.inverse_mass_linear));
        most = std::max(most, rate({axis, cross(centre, axis)}, body.inverse_inertia_angular));
    }
    return most;
}

/// Inertia of the link's body by itself (in its robot it has no less), about the link's origin, link axes.
Matrix6 inertia_of(const Body& body, const Link& link, const Law& law) {
    const Vec3 centre = transpose_times(link.X_BL.R, body.p_BC - link.X_BL.p);
    Matrix6 M{};
    for (std::size_t j = 0; j < 6; ++j) {
        Vec3 v, w;
        (j < 3 ? v[j] : w[j - 3]) = 1;
        const Vec3 momentum = (v + cross(w, centre)) * body.mass;
        const Vec3 spin = transpose_times(link.X_BL.R, body.inertia_C * (link.X_BL.R * w));
        const Vec3 turning = spin + cross(centre, momentum);
        for (std::size_t k = 0; k < 3; ++k) M[6 * k + j] = momentum[k], M[6 * (k + 3) + j] = turning[k];
    }
    for (std::size_t i = 0; law.has_inertia && i < 36; ++i) M[i] += law.added[i];
    return M;
}

using Vector6 = std::array<double, 6>;

/// x := A^-1 x of a positive definite matrix, by Cholesky's method.
void solve(Matrix6 A, Vector6& x) {
    for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t i = j; i < 6; ++i) {
            double sum = A[6 * i + j];
            for (std::size_t k = 0; k < j; ++k) sum -= A[6 * i + k] * A[6 * j + k];
            A[6 * i + j] = i == j ? std::sqrt(sum) : sum / A[7 * j];
        }
    }
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t k = 0; k < i; ++k) x[i] -= A[6 * i + k] * x[k];
        x[i] /= A[7 * i];
    }
    for (std::size_t i = 6; i-- > 0;) {
        for (std::size_t k = i + 1; k < 6; ++k) x[i] -= A[6 * k + i] * x[k];
        x[i] /= A[7 * i];
    }
}

double product(const Vector6& a, const Matrix6& M, const Vector6& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) sum += a[i] * M[6 * i + j] * b[j];
    return sum;
}

/// u.M u of the velocity through the fluid, and the energies' changes by the velocity's change d within the
/// tick.
struct Kick {
    double have = 0, work = 0,  // u.M u, u.M d
        change = 0;             // d.M d
    Vec3 turning, more;         // rad/s: angular velocity, and its change

    /// Of the velocity, that changes.
    double share() const { return have > 0 ? std::sqrt(change / have) : 0.0; }
};

/// What the law alone does to its body within the tick. With `implicit`, its damping is taken as the step
/// takes it. A body with `count` laws is shared out among them.
Kick kick(const Body& body, const Link& link, const Law& law, double count, double dt, bool implicit) {
    Matrix6 M = inertia_of(body, link, law);
    for (double& m : M) m /= count;
    Matrix6 A = M;
    for (std::size_t i = 0; implicit && i < 36; ++i) A[i] += dt * law.flow.damping[i];
    Vector6 u, d;
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = law.velocity.linear[k], u[k + 3] = law.velocity.angular[k];
        d[k] = law.flow.force[k] * dt, d[k + 3] = law.flow.torque[k] * dt;
    }
    solve(A, d);
    return {product(u, M, u), product(u, M, d), product(d, M, d), law.velocity.angular, {d[3], d[4], d[5]}};
}

/// How much of a law's force may act in this tick. Lift does no work, but taken at the start of the tick it
/// adds to the energy of the motion through the fluid. A wing that is no larger than what flies has a tick
/// much too short for that to show. Of one that would change its velocity by more than kOrdinary of it within
/// the tick, only so much acts that this energy does not grow: the share s that makes (u + s d).M (u + s d)
/// equal to u.M u. Nor does it turn a body by more than kTurn (rad) in a tick: from there on the step does
/// not keep the energy of the rotation itself.
double share_of(const Body& body, const Link& link, const Law& law, double count, double dt) {
    constexpr double kOrdinary = 0.05, kTurn = 0.1;
    if (!(body.mass > 0)) return 1;
    const Kick own = kick(body, link, law, count, dt, true);
    if (!(own.share() > kOrdinary)) return 1;
    double share = 1;
    if (own.work + 0.5 * own.change > 0) share = own.work < 0 ? -2 * own.work / own.change : 0.0;
    const double a = dot(own.more, own.more), b = dot(own.turning, own.more);
    const double spin = dot(own.turning, own.turning), most = std::max(spin, kTurn * kTurn / (dt * dt));
    if (spin + 2 * share * b + share * share * a > most)
        share = (std::sqrt(b * b + a * (most - spin)) - b) / a;
    return share;
}

/// How many laws that push act on the body.
double count_laws(const RobotWork& work, int body) {
    int count = 0;
    for (const OnboardInfo& info : work.type->onboard)
        if (is_force_law(info.spec.parameters) && work.type->links[info.links[0].index()].body == body)
            ++count;
    return std::max(count, 1);
}

}  // namespace

void add_fluid_forces(const Model& model, double dt, double momentum_weight, std::span<const double> q,
                      RobotWork& work) {
    work.flows.clear();
    for (const LinkFluid& fluid : work.type->fluids) {
        if (!floats(model, fluid)) continue;
        const int body = work.type->links[fluid.link.index()].body;
        work.bodies[static_cast<std::size_t>(body)].impulse += buoyancy(model, work, fluid) * dt;
    }
    const bool implicit = momentum_weight != 0;
    for_each_law(model, work, q, {}, [&](Law law, LinkId id) {
        if (implicit) {
            const Link& link = work.type->links[id.index()];
            const Body& body = work.type->bodies[static_cast<std::size_t>(link.body)];
            const double share = share_of(body, link, law, count_laws(work, link.body), dt);
            if (share < 1) law.flow.force = law.flow.force * share, law.flow.torque = law.flow.torque * share;
        }
        Spatial impulse = force_of(law) * dt;
        FlowWork& flow = add_flow(law.motion, work);
        flow.inertia = {};
        if (implicit) {
            for (std::size_t i = 0; i < 36; ++i) flow.inertia[i] = dt * law.flow.damping[i];
            impulse += times(flow.inertia, law.motion.velocity);
        }
        if (law.has_inertia) {
            for (std::size_t i = 0; i < 36; ++i) flow.inertia[i] += law.added[i];
            impulse += times(law.added, law.motion.velocity) * momentum_weight;
        }
        work.bodies[static_cast<std::size_t>(law.motion.body)].impulse += out_of_link(law.motion, impulse);
    });
}

void set_added_masses(const RobotType& type, Mechanics<double>& work) {
    work.flows.clear();
    const auto add = [&](LinkId id, const Matrix6& mass) {
        const Link& link = type.links[id.index()];
        const BodyWork& body = work.bodies[static_cast<std::size_t>(link.body)];
        FlowWork& flow = work.flows.emplace_back();
        flow.body = link.body;
        flow.R_WL = body.X_WB.R * link.X_BL.R;
        flow.arm = body.X_WB * link.X_BL.p - work.origin;
        flow.inertia = mass;
    };
    for (const LinkFluid& fluid : type.fluids)
        if (!fluid.added_mass.empty()) add(fluid.link, full_matrix(fluid.added_mass));
    for (const OnboardInfo& info : type.onboard) {
        const auto* water = std::get_if<HydrodynamicsSpec>(&info.spec.parameters);
        if (water != nullptr && !water->no_added_mass && !is_zero(water->added_mass) &&
            type.links[info.links[0].index()].body >= 0)
            add(info.links[0], added_mass_of(*water));
    }
}

void add_flow_inertia(const RobotType& type, Mechanics<double>& work) {
    for (const FlowWork& flow : work.flows) {
        const Body& body = type.bodies[static_cast<std::size_t>(flow.body)];
        const auto last = static_cast<std::size_t>(body.v_index + body.nv - 1);
        const int* path = type.paths.path(last);
        for (std::size_t a = 0; a < type.paths.length(last); ++a) {
            const auto i = static_cast<std::size_t>(path[a]);
            const Spatial by_i = times(flow.inertia, into_link(flow.R_WL, flow.arm, work.axes[i]));
            double* row = work.mass_matrix.data() + type.paths.row(i);
            for (std::size_t b = 0; b <= a; ++b)
                row[b] +=
                    dot(by_i, into_link(flow.R_WL, flow.arm, work.axes[static_cast<std::size_t>(path[b])]));
        }
    }
}

bool flow_takes_energy(const Model& model, const RobotWork& work) {
    if (!work.type->fluids.empty()) return false;
    return std::ranges::all_of(work.type->onboard, [&](const OnboardInfo& info) {
        if (!is_force_law(info.spec.parameters)) return true;
        const auto* wing = std::get_if<LiftDragSpec>(&info.spec.parameters);
        return wing != nullptr && wing->cma == 0 && wing->cma_stall == 0 && wing->cm_delta == 0 &&
               wind_in(wing->density, model, work) == Vec3{};
    });
}

namespace {

/// Whether a wing might push so hard within the tick that an explicit step could not follow, although it does
/// not now: its centre of pressure may stand still while the robot moves.
bool may_stiffen(const Model& model, const RobotWork& work) {
    constexpr double kStiff = 2, kQuarterTurn = 1.5707963267948966;
    for (const OnboardInfo& info : work.type->onboard) {
        const auto* wing = std::get_if<LiftDragSpec>(&info.spec.parameters);
        if (wing == nullptr || work.type->links[info.links[0].index()].body < 0) continue;
        const LinkMotion m = motion_of(work, info.links[0]);
        const Body& body = work.type->bodies[static_cast<std::size_t>(m.body)];
        const Vec3 wind = wind_in(wing->density, model, work);
        const double arm = norm(wing->centre) + norm(body.p_BC),
                     speed = norm(through(m, wind).linear) + norm(m.velocity.angular) * norm(wing->centre) +
                             norm(gravity_of(model, *work.type)) * model.dt_s;
        const double stall = std::min(wing->alpha_stall, kQuarterTurn);
        const double most =
            (std::fabs(wing->cla) + std::fabs(wing->cda)) * stall +
            (std::fabs(wing->cla_stall) + std::fabs(wing->cda_stall)) * (kQuarterTurn - stall);
        const double mobility = body.inverse_mass_linear + arm * arm * body.inverse_inertia_angular;
        if (0.5 * wing->density * wing->area * speed * most * mobility * model.dt_s > kStiff) return true;
    }
    return false;
}

}  // namespace

bool flow_is_stiff(const Model& model, const RobotWork& work) {
    constexpr double kRateMax = 0.25;  // as that of the air (drag.cpp)
    if (may_stiffen(model, work)) return true;
    double sum = 0;
    bool kicks = false;
    const auto look = [&](const Law& law, LinkId id) {
        const Link& link = work.type->links[id.index()];
        const Body& body = work.type->bodies[static_cast<std::size_t>(link.body)];
        sum += stopping(body, link, law, model.dt_s);
        kicks |= law.is_wing && body.mass > 0 &&
                 !(kick(body, link, law, 1, model.dt_s, false).share() <= kRateMax);
    };
    for_each_law(model, work, work.state->q, {}, look);
    if (kicks || sum > kRateMax) return true;
    sum = 0;  // once more, as fast as gravity makes it within the tick: at rest there is no force yet
    for_each_law(model, work, work.state->q, {}, look, gravity_of(model, *work.type) * model.dt_s);
    return kicks || sum > kRateMax;
}

void sum_fluid_forces(const Model& model, const RobotWork& work, std::span<const Spatial> accelerations,
                      std::span<Spatial> forces) {
    for (const LinkFluid& fluid : work.type->fluids)
        if (floats(model, fluid)) forces[fluid.link.index()] += buoyancy(model, work, fluid);
    for_each_law(model, work, work.state->q, accelerations, [&](const Law& law, LinkId link) {
        forces[link.index()] += out_of_link(law.motion, force_of(law));
    });
}

}  // namespace roboss
