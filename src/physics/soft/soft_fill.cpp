// The rows of the soft solver's patches: of free bodies, and of robots with joints.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "physics/contact/contact_rows.h"
#include "physics/contact/pair_of.h"
#include "physics/soft/soft_solver.h"

namespace roboss::soft {
namespace {

/// One side of a pair of free bodies.
struct Side {
    const Body* body = nullptr;  // nullptr: it does not move
    Vec3 point;                  // where impulses push it, world axes
};

struct Sides {
    Side a, b;

    Vec3 turn_a(const Vec3& direction) const {
        return a.body->turned_by(cross(a.point - a.body->centre, direction));
    }
    Vec3 turn_b(const Vec3& direction) const {
        return b.body == nullptr ? Vec3{} : b.body->turned_by(cross(b.point - b.body->centre, -direction));
    }
};

void put(const Vec3& v, std::size_t lane, Eight* to) {
    to[0].x[lane] = v.x, to[1].x[lane] = v.y, to[2].x[lane] = v.z;
}

/// m/s: slower blows do not bounce. At least the speed that gravity gives in two ticks.
double least_blow(const Island& island, std::size_t contact) {
    const Contact& c = *island.contacts[contact];
    const auto type = [&](int robot) {
        return robot < 0 ? nullptr : island.robots[static_cast<std::size_t>(robot)].type;
    };
    const double gravity = contact::gravity_at(island.model, *type(c.robot_a), type(c.robot_b));
    return std::max(island.surfaces[contact].bounce_threshold,
                    contact::kTouchTicks * gravity * island.model.dt_s);
}

/// The sides of a pair of free bodies.
Sides sides_of(const std::vector<Body>& bodies, const Pair& pair, const Vec3& p, const Vec3& shift_b) {
    Sides sides;
    sides.a = {&bodies[static_cast<std::size_t>(pair.a)], pair.swapped ? p + shift_b : p};
    if (pair.b >= 0) sides.b = {&bodies[static_cast<std::size_t>(pair.b)], p + shift_b};
    return sides;
}

/// The contacts of the pair's shapes that the last tick knew.
std::span<const ContactMemory> memory_of(const Island& island, const Pair& pair) {
    const Contact& c = *island.contacts[pair.first];
    const RobotWork& a = island.robots[static_cast<std::size_t>(c.robot_a)];
    const auto key = [](const ContactMemory& m) { return std::tuple(m.other_robot, m.shape, m.other_shape); };
    const std::vector<ContactMemory>& all = a.state->contacts;
    const std::tuple wanted(other_id(island.robots, c), c.shape_a, c.shape_b);
    const auto first = std::ranges::lower_bound(all, wanted, {}, key),
               last = std::ranges::upper_bound(first, all.end(), wanted, {}, key);
    return {first, last};
}

/// A pair starts from the impulses that the last tick ended with. Where the points of two shapes have other
/// names than then, since another of two like faces is taken for the first one, those that are new share the
/// load of those that are gone.
Start start_of(const Island& island, const Pair& pair) {
    double load = 0, impulse = 0, known = 0;
    Vec3 friction, kept;
    for (const ContactMemory& m : memory_of(island, pair))
        load += m.load, impulse += m.impulse, friction += m.friction;
    const ShapePair shapes = pair_of(*island.contacts[pair.first]);
    std::size_t first = pair.first, last = pair.first;  // of all pairs of these shapes
    while (first > 0 && pair_of(*island.contacts[first - 1]) == shapes) --first;
    while (last < island.contacts.size() && pair_of(*island.contacts[last]) == shapes) ++last;
    int fresh = 0, fresh_here = 0;
    for (std::size_t k = first; k < last; ++k) {
        const Contact& c = *island.contacts[k];
        known += c.load, kept += c.friction;
        if (c.impulse > 0) continue;
        ++fresh;
        if (k >= pair.first && k < pair.first + pair.points) ++fresh_here;
    }
    Start start;
    start.steady = impulse > 0 ? load / impulse : 0;
    if (fresh == 0 || load <= known) return start;
    start.fresh_load = (load - known) / fresh;
    start.lost = (friction - kept) * (start.steady * fresh_here / fresh);
    return start;
}

}  // namespace

void Solver::fill_batch(const Island& island, std::size_t batch) {
    const Batch& b = problem_.batches[batch];
    problem_.patches[batch] = {};
    std::fill_n(problem_.points.begin() + static_cast<std::ptrdiff_t>(b.first), b.points, Point{});
    if (b.jointed && !is_full(batch)) clear_columns(b);
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(b.patches); ++lane) {
        const Pair& pair = pair_at(batch, lane);
        const Start start = start_of(island, pair);
        fill(island, pair, start, lane, b, problem_.patches[batch]);
        fill_friction(island, pair, start, lane, b, problem_.patches[batch]);
    }
}

/// The rows of the normals.
void Solver::fill(const Island& island, const Pair& pair, const Start& start, std::size_t lane,
                  const Batch& batch, Patch& patch) {
    const double way = pair.swapped ? -1 : 1, least = least_blow(island, pair.first);
    const Vec3 n = island.contacts[pair.first]->normal * way;
    put(n, lane, patch.n);
    patch.inverse_mass_a.x[lane] = inverse_mass(pair.a), patch.inverse_mass_b.x[lane] = inverse_mass(pair.b);
    patch.coefficient.x[lane] = island.surfaces[pair.first].friction.mu;
    patch.recovery.x[lane] = island.surfaces[pair.first].correction_speed;
    const JointedPair* jointed = pair.jointed ? &jointed_[pair.sides] : nullptr;
    if (jointed != nullptr) put_places(*jointed, lane, batch);
    for (std::uint32_t k = 0; k < pair.points; ++k) {
        const Contact& c = *island.contacts[pair.first + k];
        const SurfacePair& surface = island.surfaces[pair.first + k];
        Point& point = problem_.points[batch.first + k];
        const double speed = dot(n, surface.velocity) * way;
        NormalRow row;
        if (jointed != nullptr) {
            JointedRow columns;
            set_row(*jointed, {n, c.p_W, false}, c.shift_b, columns);
            put_columns(columns, *jointed, k, lane, batch);
            row = {product(columns, columns, *jointed), approach_of(*jointed, n, c)};
        } else {
            row = put_normal(pair, n, c, lane, point);
        }
        const double approach = row.approach - speed;
        point.gap.x[lane] = c.gap < 0 ? std::min(c.gap + surface.slop, 0.0) : c.gap;
        point.speed.x[lane] = speed;
        point.mass.x[lane] = 1 / row.mobility;
        if (surface.restitution > 0 && approach > least)
            point.bounce.x[lane] = surface.restitution * approach;
        point.impulse.x[lane] = (c.impulse > 0 ? c.load : start.fresh_load) / kSubsteps;
    }
}

/// Writes the normal row of a point between free bodies.
Solver::NormalRow Solver::put_normal(const Pair& pair, const Vec3& n, const Contact& c, std::size_t lane,
                                     Point& point) const {
    const Sides sides = sides_of(bodies_, pair, c.p_W, c.shift_b);
    const Vec3 turn_a = sides.turn_a(n), turn_b = sides.turn_b(n);
    put(turn_a, lane, point.turn_a), put(turn_b, lane, point.turn_b);
    const Body& a = *sides.a.body;
    double approach = -(dot(n, a.linear) + dot(turn_a, a.whitened(a.angular)));
    if (const Body* b = sides.b.body; b != nullptr)
        approach += dot(n, b->linear) - dot(turn_b, b->whitened(b->angular));
    const double inverse_mass = a.inverse_mass + (sides.b.body == nullptr ? 0 : sides.b.body->inverse_mass);
    return {inverse_mass + (norm_squared(turn_a) + norm_squared(turn_b)), approach};
}

void Solver::fill_friction(const Island& island, const Pair& pair, const Start& start, std::size_t lane,
                           const Batch& batch, Patch& patch) {
    const double way = pair.swapped ? -1 : 1;
    const Contact& first = *island.contacts[pair.first];
    const SurfacePair& surface = island.surfaces[pair.first];
    const ContactFrame frame = frame_of(first.normal * way, surface.friction);
    const Vec3& middle = pair.middle;
    Vec3 friction = start.lost * way, speed = surface.velocity;
    double twist = 0;
    for (std::uint32_t k = 0; k < pair.points; ++k) {
        const Contact& c = *island.contacts[pair.first + k];
        const Vec3 arm = c.p_W - middle, kept = c.friction * (start.steady * way);
        problem_.points[batch.first + k].lever.x[lane] =
            surface.friction.mu * norm(arm) + island.surfaces[pair.first + k].torsional;
        friction += kept, twist += dot(frame.n, cross(arm, kept));
    }
    put(frame.t1, lane, patch.t1), put(frame.t2, lane, patch.t2);
    const FrictionRows rows = pair.jointed ? put_jointed_friction(pair, first, frame, lane, batch)
                                           : put_friction(pair, first, frame, lane, patch);
    const double across2 = norm_squared(frame.t2);
    patch.k_11.x[lane] = rows.k_11, patch.k_12.x[lane] = rows.k_12, patch.k_twist.x[lane] = rows.k_twist;
    patch.k_22.x[lane] = across2 > 0 ? rows.k_22 : 1;
    if (across2 > 0) patch.slide_2.x[lane] = dot(frame.t2, friction) / (across2 * kSubsteps);
    patch.speed_1.x[lane] = dot(frame.t1, speed) * way, patch.speed_2.x[lane] = dot(frame.t2, speed) * way;
    patch.speed_twist.x[lane] = dot(frame.n, surface.turning) * way;
    patch.slide_1.x[lane] = dot(frame.t1, friction) / kSubsteps, patch.twist.x[lane] = twist / kSubsteps;
}

/// Writes the friction rows of a patch between free bodies.
Solver::FrictionRows Solver::put_friction(const Pair& pair, const Contact& first, const ContactFrame& frame,
                                          std::size_t lane, Patch& patch) const {
    const Sides sides = sides_of(bodies_, pair, pair.middle, first.shift_b);
    const Vec3 a_1 = sides.turn_a(frame.t1), b_1 = sides.turn_b(frame.t1), a_2 = sides.turn_a(frame.t2),
               b_2 = sides.turn_b(frame.t2), a_w = sides.a.body->turned_by(frame.n),
               b_w = sides.b.body == nullptr ? Vec3{} : sides.b.body->turned_by(-frame.n);
    put(a_1, lane, patch.slide_1a), put(b_1, lane, patch.slide_1b);
    put(a_2, lane, patch.slide_2a), put(b_2, lane, patch.slide_2b);
    put(a_w, lane, patch.twist_a), put(b_w, lane, patch.twist_b);
    const double inverse_mass = patch.inverse_mass_a.x[lane] + patch.inverse_mass_b.x[lane];
    return {(dot(a_1, a_1) + dot(b_1, b_1)) + inverse_mass, dot(a_1, a_2) + dot(b_1, b_2),
            (dot(a_2, a_2) + dot(b_2, b_2)) + inverse_mass * norm_squared(frame.t2),
            norm_squared(a_w) + norm_squared(b_w)};
}

}  // namespace roboss::soft
