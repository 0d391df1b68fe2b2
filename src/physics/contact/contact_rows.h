// A contact point becomes rows: Jacobian columns along both robots' paths, and targets for velocity and
// displacement. Over T: see rows.h.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "physics/solver/rows.h"

namespace roboss {

/// Normal and tangents of a contact's row. Across the friction axis the tangent is shortened to the share of
/// friction there: in these coordinates the ellipse of friction impulses is a disc, and what the solver finds
/// in the disc (most dissipation) is what Coulomb's law says of the ellipse.
template <class T>
struct ContactFrameT {
    Vec3T<T> n, t1, t2;
};
using ContactFrame = ContactFrameT<double>;

template <class T>
ContactFrameT<T> frame_of(const Vec3T<T>& normal, const FrictionEllipse& friction) {
    ContactFrameT<T> frame{normal, {}, {}};
    if (friction.axis == Vec3{}) {
        tangents(normal, frame.t1, frame.t2);
    } else {
        frame.t1 = broadcast<T>(friction.axis);
        frame.t2 = cross(normal, frame.t1) * T(friction.across);
    }
    return frame;
}

/// The body of a robot at one side of a contact.
template <class T>
struct ContactSide {
    const Mechanics<T>* robot = nullptr;
    int body = -1;   // -1: the fixed base
    int offset = 0;  // first dof of the robot in the contact island

    const Body* info() const {
        return body < 0 ? nullptr : &robot->type->bodies[static_cast<std::size_t>(body)];
    }
};

/// Side of a contact in an island; offsets[i] is the first dof of robots[i].
inline ContactSide<double> side_of(std::span<const RobotWork> robots, std::span<const int> offsets, int robot,
                                   int body) {
    const auto i = static_cast<std::size_t>(robot);
    return {&robots[i], body, offsets[i]};
}

namespace contact {

inline constexpr double kWeights =
    10;  // a load that a contact may take up at once, in weights of what it moves
/// A body that is put down approaches no faster than it falls in so many ticks. Points that touch so share
/// the load by softness. If they were as hard as those that hit, a tilt of 1e-8 rad would let one bear it
/// all.
inline constexpr double kTouchTicks = 2;
inline constexpr double kSticking = 0.99;  // of the friction bound; beyond, a contact is taken for sliding
inline constexpr double kSoftBlow = 10;    // m/s
inline constexpr double kTakenOver =
    0.1;                               // of the speed of recovery: how fast a spring takes over an overlap
inline constexpr double kDeep = 2e-4;  // m of penetration beyond the slop
inline constexpr double kCorrectionShare = 0.3,
                        kDeepCorrectionShare =
                            0.1;  // of the penetration beyond the slop and, of that, beyond kDeep, in a tick
/// What corrects a deep penetration gives way to what stands against it: bodies that are stuck in each other
/// stay so, instead of shaking all that they touch.
inline constexpr double kDeepCompliance = 0.1;

/// Along `direction`, the velocity of point p of a free base per unit of its turning and moving.
template <class T>
void put_base_columns(const Vec3T<T>& direction, const Vec3T<T>& p, T* columns) {
    const Vec3T<T> turning = cross(p, direction);
    columns[0] = turning.x, columns[1] = turning.y, columns[2] = turning.z;
    columns[3] = direction.x, columns[4] = direction.y, columns[5] = direction.z;
}

/// Columns of a side along its path, not set yet but for their dofs.
template <class T>
struct PathColumns {
    const int* path = nullptr;
    std::size_t length = 0;
    T *n = nullptr, *t1 = nullptr, *t2 = nullptr;
};

/// Adds them; the side must have a body.
template <class T>
PathColumns<T> add_path(const ContactSide<T>& side, ContactColumnsT<T>& columns) {
    const Body& body = *side.info();
    const DofPaths& paths = side.robot->type->paths;
    const auto last = static_cast<std::size_t>(body.v_index + body.nv - 1);
    const int* path = paths.path(last);
    const std::size_t begin = columns.size(), length = paths.length(last);
    columns.extend(length);
    for (std::size_t k = 0; k < length; ++k) {
        columns.dof[begin + k] = side.offset + path[k];
        columns.base[begin + k] = k == 0 && side.robot->type->free_base;
    }
    return {path, length, columns.n.data() + begin, columns.t1.data() + begin, columns.t2.data() + begin};
}

template <class T>
void add_columns(const ContactSide<T>& side, double sign, const Vec3T<T>& p_W, const ContactFrameT<T>& frame,
                 ContactColumnsT<T>& columns) {
    const Body* info = side.info();
    if (info == nullptr) return;
    const Mechanics<T>& robot = *side.robot;
    const Vec3T<T> p = p_W - robot.origin;
    const SpatialT<T>* axes = robot.axes.data();
    const auto [path, length, n, t1, t2] = add_path(side, columns);
    std::size_t k = 0;
    if (robot.type->free_base) {
        k = 6;
        put_base_columns(frame.n * T(sign), p, n);
        put_base_columns(frame.t1 * T(sign), p, t1);
        put_base_columns(frame.t2 * T(sign), p, t2);
    }
    for (; k < length; ++k) {
        const SpatialT<T>& axis = axes[path[k]];
        const Vec3T<T> u = (axis.linear + cross(axis.angular, p)) * T(sign);
        n[k] = dot(frame.n, u), t1[k] = dot(frame.t1, u), t2[k] = dot(frame.t2, u);
    }
}

template <class T>
double mobility(const ContactSide<T>& side) {
    const Body* info = side.info();
    return info == nullptr ? 0.0 : info->inverse_mass_linear;
}

/// Gravity along the normal as the body feels it.
template <class T>
T gravity_along(const Model& model, const ContactSide<T>& side, const Vec3T<T>& n) {
    const Body* info = side.info();
    if (info == nullptr || !(info->mass > 0)) return 0.0;
    return dot(broadcast<T>(gravity_of(model, *side.robot->type)), n) * T(info->gravity_mass / info->mass);
}

/// m/s^2: the size of gravity at the sides of a contact, the larger one.
[[gnu::always_inline]] inline double gravity_at(const Model& model, const RobotType& a, const RobotType* b) {
    const double size = norm(gravity_of(model, a));
    const double other = b == nullptr ? size : norm(gravity_of(model, *b));
    return other > size ? other : size;
}

/// Normal velocity before the step, from the states' velocities.
template <class T>
T normal_velocity(const ContactSide<T>& side, const Vec3T<T>& p_W, const Vec3T<T>& n) {
    if (side.body < 0) return 0.0;
    const SpatialT<T>& v = side.robot->bodies[static_cast<std::size_t>(side.body)].velocity;
    return dot(n, v.linear + cross(v.angular, p_W - side.robot->origin));
}

/// Where the contact's normal velocity and displacement go to.
template <class T>
struct NormalTargets {
    MaskOf<T> split{false};  // they differ
    T velocity{}, displacement{};
};

/// An impact inside the tick: flies `to_hit` seconds, bounces, flies the rest; gravity counted in both parts.
/// `split` is false where nothing hits.
template <class T>
NormalTargets<T> impact(const ContactT<T>& c, const SurfacePair& surface, const T& approach,
                        const T& gravity_n, double dt) {
    const T to_hit = select(c.gap > T(0), c.gap / approach, T(0));
    const T speed = approach - gravity_n * to_hit;
    const T rest = dt - to_hit;
    const T away = surface.restitution * speed;
    const T gap_after = away * rest + 0.5 * gravity_n * rest * rest;
    NormalTargets<T> targets;
    targets.velocity = away + gravity_n * rest;
    targets.displacement = (gap_after - larger(c.gap, T(0))) / T(dt);
    targets.split = (approach > T(0)) & (to_hit <= T(dt)) & (speed > T(surface.bounce_threshold)) &
                    (targets.velocity > T(0));
    return targets;
}

/// How much of an overlap of `depth` the contact's own motion made, m: what its spring may give back. A
/// contact that is new made what it approached by; one that is remembered has the share that its load keeps,
/// but no more than the force of its last tick shows (an order may have moved it since). The rest of the
/// overlap was there at the start. It is taken over so slowly that a contact at rest becomes a plain spring,
/// and nothing is thrown.
template <class T>
T sprung_depth(const ContactT<T>& c, const SurfacePair& surface, const T& depth, const T& approach,
               double dt) {
    const Softness& soft = surface.softness;
    const MaskOf<T> known = c.impulse > T(0);
    const T kept = depth * (c.load / c.impulse),
            shown = (c.impulse / T(dt) - T(soft.damping) * approach) / T(soft.stiffness),
            made = select(known, larger(smaller(kept, shown), T(0)), larger(approach, T(0)) * T(dt));
    return smaller(depth, made + T(kTakenOver * surface.correction_speed * dt));
}

/// A spring and damper taken implicitly: force = stiffness * depth - damping * u with the depth and the
/// velocity at the end of the tick, never pulling. A gap is closed first, and damps for its share of the
/// tick. Of an overlap that no motion made, `unsprung`, the force falls to zero where the surfaces part at
/// the speed of recovery: damping = stiffness * unsprung / speed besides. So shapes that start in each other
/// are pushed apart by what would bear them there, but no faster. The spring counts as compressed no deeper
/// than a body of mobility `inverse_effective_mass` could have come by a blow of kSoftBlow. False if the
/// contact is as hard as rigid ones, of compliance `rigid`.
template <class T>
bool set_softness(const ContactT<T>& c, const SurfacePair& surface, const T& approach, double dt,
                  double inverse_effective_mass, double rigid, ContactRowT<T>& row) {
    const Softness& soft = surface.softness;
    if (soft.stiffness <= 0) return false;
    if (1.0 / (dt * dt * soft.stiffness + dt * soft.damping) < rigid) return false;
    constexpr double kSlowest = 1e-9;  // m/s
    const T most = T(kSoftBlow / std::sqrt(soft.stiffness * inverse_effective_mass)),
            depth = larger(-c.gap, T(0));
    const T unsprung = depth - sprung_depth(c, surface, depth, approach, dt),
            braking =
                T(soft.stiffness / std::max(surface.correction_speed, kSlowest)) * smaller(unsprung, most);
    row.normal.compliance =
        larger(T(1) / (T(dt * dt * soft.stiffness + dt * soft.damping) + T(dt) * braking), T(rigid));
    row.normal.target =
        select(c.gap <= T(0),
               smaller(depth, most) * T(soft.stiffness) / (T(dt * soft.stiffness + soft.damping) + braking),
               -c.gap / T(dt));
    row.normal.position_target = row.normal.target;
    row.unsprung = unsprung / T(dt), row.overlap = -c.gap / T(dt) - row.normal.target;
    return true;
}

/// Targets of the normal. The load of the last tick is where the row starts from (a proximal step): a contact
/// at rest carries it without any velocity, however compliant the row. True if velocity and displacement
/// differ. `bounce_compliance`: of what hits and bounces, `deep_compliance`: of what corrects deep
/// penetration.
template <class T>
MaskOf<T> set_normal(const ContactT<T>& c, const SurfacePair& surface, const T& approach, const T& gravity_n,
                     double dt, const T& compliance, double bounce_compliance, double deep_compliance,
                     BoundedRowT<T>& row) {
    row.compliance = compliance;
    const T closing = select(c.gap > T(0), -c.gap / T(dt), T(0));
    const MaskOf<T> corrects = c.gap < T(-surface.slop);
    const T depth = -c.gap - surface.slop, shallow = smaller(depth, T(kDeep));
    const T recovered = kCorrectionShare * shallow + kDeepCorrectionShare * (depth - shallow);
    const T correction = smaller(recovered / T(dt), T(surface.correction_speed));
    const MaskOf<T> deep = depth > T(kDeep);
    row.target = closing + compliance * c.load;
    row.position_compliance = select(deep, T(deep_compliance), T(0));
    row.position_target = select(corrects, correction, closing) + select(deep, T(0), compliance * c.load);
    if (surface.restitution <= 0) return corrects;
    NormalTargets<T> hit = impact(c, surface, approach, gravity_n, dt);
    hit.split = hit.split & !deep;  // shapes deep in each other do not hit
    row.compliance = select(hit.split, T(bounce_compliance), row.compliance);
    row.target = select(hit.split, hit.velocity, row.target);
    row.position_target = select(hit.split, hit.displacement, row.position_target);
    return hit.split | corrects;
}

/// Friction starts from that of the last tick, as the normal does; `share` makes velocities of its impulses.
template <class T>
void set_friction_targets(const ContactT<T>& c, const ContactFrameT<T>& frame, double across, const T& share,
                          FrictionDiscT<T>& slip) {
    slip.target_1 = share * dot(frame.t1, c.friction);
    slip.target_2 = share * dot(frame.t2, c.friction);
    if (across == 1) return;
    const double short2 = across * across;
    slip.target_2 = short2 > 0 ? slip.target_2 / T(short2) : T(0);
}

/// What a contact that carried a load starts from; the others start from nothing.
template <class T>
void start_from_load(const ContactT<T>& c, const FrictionEllipse& friction, const ContactFrameT<T>& frame,
                     const MaskOf<T>& loaded, const T& compliance, ContactRowT<T>& row) {
    row.loaded = loaded;
    if (!any(loaded)) return;
    set_friction_targets(c, frame, friction.across, compliance * (c.load / c.impulse), row.slip);
    const T t1 = row.slip.target_1, t2 = row.slip.target_2,
            end = kSticking * compliance * T(friction.mu) * c.load;
    row.sticks = loaded & (t1 * t1 + t2 * t2 < end * end);
    row.slip.target_1 = select(loaded, t1, T(0)), row.slip.target_2 = select(loaded, t2, T(0));
}

inline ContactPlace place_of(const Contact& c, const ContactFrame& frame, const ContactSide<double>& a,
                             const ContactSide<double>* b) {
    ContactPlace place{a.body, -1, c.p_W - a.robot->origin, {}, {frame.n, frame.t1, frame.t2}};
    if (b != nullptr) place.body_b = b->body, place.arm_b = c.p_W + c.shift_b - b->robot->origin;
    return place;
}

/// Where surfaces move, rows hold their velocities against each other and not those of the bodies.
template <class T>
void count_surface_motion(const SurfacePair& surface, const ContactFrameT<T>& frame, ContactRowT<T>& row) {
    if (surface.velocity == Vec3{}) return;
    const Vec3T<T> v = broadcast<T>(surface.velocity);
    const T normal = dot(frame.n, v);
    row.normal.target -= normal, row.normal.position_target -= normal;
    row.slip.target_1 -= dot(frame.t1, v), row.slip.target_2 -= dot(frame.t2, v);
}

}  // namespace contact

/// Before displacements are solved: friction, and what deep penetration starts from, by the impulses of the
/// velocities.
template <class T>
void turn_to_displacement(ContactRowT<T>& row) {
    row.slip.bound = row.slip.coefficient * row.normal.impulse;
    row.normal.position_target += row.normal.position_compliance * row.normal.impulse;
}

/// Adds the rows of a contact of `a` with `b` (nullptr: scenery). True if the displacement of this tick needs
/// another target than the velocity.
template <class T>
MaskOf<T> add_contact_row(const Model& model, const ContactT<T>& c, const SurfacePair& surface,
                          const ContactSide<T>& a, const ContactSide<T>* b, IslandRowsT<T>& rows) {
    const double dt = model.dt_s;
    const ContactFrameT<T> frame = frame_of(c.normal, surface.friction);
    ContactRowT<T>& row = rows.contacts.emplace_back();
    row.first = rows.columns.size();
    contact::add_columns(a, 1.0, c.p_W, frame, rows.columns);
    const std::size_t middle = rows.columns.size();
    double inverse_effective_mass = contact::mobility(a);
    T approach = -contact::normal_velocity(a, c.p_W, c.normal);
    if (surface.velocity != Vec3{}) approach -= dot(c.normal, broadcast<T>(surface.velocity));
    T gravity_n = contact::gravity_along(model, a, c.normal);
    if (b != nullptr) {
        contact::add_columns(*b, -1.0, c.p_W + c.shift_b, frame, rows.columns);
        inverse_effective_mass += contact::mobility(*b);
        approach += contact::normal_velocity(*b, c.p_W + c.shift_b, c.normal);
        gravity_n -= contact::gravity_along(model, *b, c.normal);
        row.joins = row.first != middle && middle != rows.columns.size();
        if (b->robot == a.robot) rows.columns.merge(row.first, middle);
    }
    row.last = rows.columns.size();
    if constexpr (std::is_same_v<T, double>)
        if (rows.keeps_places) rows.places.push_back(contact::place_of(c, frame, a, b));
    const MaskOf<T> loaded = c.load > T(0);
    const double gravity =
        contact::gravity_at(model, *a.robot->type, b == nullptr ? nullptr : b->robot->type);
    const MaskOf<T> hits = approach > T(contact::kTouchTicks * gravity * dt);
    const T compliance =
        inverse_effective_mass *
        select(loaded | !hits, T(loaded_compliance<T>(model.accuracy)), T(new_compliance<T>(model.accuracy)));
    row.normal.high = std::numeric_limits<double>::infinity();
    row.normal.impulse = c.impulse;
    row.soft = contact::set_softness(c, surface, approach, dt, inverse_effective_mass,
                                     inverse_effective_mass * bounce_compliance<T>(model.accuracy), row);
    MaskOf<T> split = false;
    if (!row.soft)
        split = contact::set_normal(c, surface, approach, gravity_n, dt, compliance,
                                    inverse_effective_mass * bounce_compliance<T>(model.accuracy),
                                    inverse_effective_mass * contact::kDeepCompliance, row.normal);
    row.slip.coefficient = surface.friction.mu;
    row.slip.bound = surface.friction.mu * c.impulse;
    const T slip_compliance = T(inverse_effective_mass * friction_compliance<T>(model.accuracy));
    row.slip.compliance = slip_compliance;
    if constexpr (std::is_same_v<T, double>) {  // impulses of a tick, not forces
        row.slip.slip_11 = surface.slip_11 / dt, row.slip.slip_12 = surface.slip_12 / dt;
        row.slip.slip_22 = surface.slip_22 / dt;
    }
    row.inverse_effective_mass = inverse_effective_mass;
    row.warm_start_max = larger(4.0 * c.load, T(contact::kWeights * gravity * dt / inverse_effective_mass));
    contact::start_from_load(c, surface.friction, frame, loaded, slip_compliance, row);
    contact::count_surface_motion(surface, frame, row);
    return split;
}

}  // namespace roboss
