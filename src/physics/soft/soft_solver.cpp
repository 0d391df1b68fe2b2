// See soft_solver.h.
#include "physics/soft/soft_solver.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/fixed_math.h"
#include "physics/contact/contact_rows.h"
#include "physics/contact/pair_of.h"
#include "physics/dynamics/kick_drift.h"
#include "physics/solver/fast_accuracy.h"

namespace roboss::soft {
namespace {

/// Contacts recover as springs of this frequency, in substeps, and of this damping ratio: hard enough for
/// piles, and so damped that nothing is thrown. Against scenery, which does not give way, twice as stiff.
constexpr double kFrequency = 0.125, kDamping = 10;

/// A spring and damper of `hertz`, implicit in a substep of h.
Softness softness(double hertz, double damping, double h) {
    const double w = 2 * kPi * hertz, a_1 = 2 * damping + h * w, a_2 = h * w * a_1, a_3 = 1 / (1 + a_2);
    return {w / a_1, a_2 * a_3, a_3};
}

Substep substep_of(double dt) {
    const double h = dt / kSubsteps, hertz = kFrequency / h;
    return {h, 0, softness(hertz, kDamping, h), softness(2 * hertz, kDamping / 2, h)};
}

/// One side of a pair.
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

/// Where the friction of a patch acts: the middle of its points, those that are apart less.
Vec3 middle_of(const Island& island, const Pair& pair) {
    constexpr double kApart = 2e-3;  // m, that counts for nothing
    Vec3 sum;
    double weight = 0;
    for (std::uint32_t k = pair.first; k < pair.first + pair.points; ++k) {
        const Contact& c = *island.contacts[k];
        const double share = std::clamp(2 - c.gap * (2 / kApart), 1e-9, 1.0);
        sum += c.p_W * share, weight += share;
    }
    return sum / weight;
}

void put(const Vec3& v, std::size_t lane, Eight* to) {
    to[0].x[lane] = v.x, to[1].x[lane] = v.y, to[2].x[lane] = v.z;
}

/// m/s: slower blows do not bounce. At least the speed that gravity gives in two ticks.
double least_blow(const Model& model, const SurfacePair& surface) {
    return std::max(surface.bounce_threshold, contact::kTouchTicks * norm(model.gravity) * model.dt_s);
}

}  // namespace

bool can_solve(const Model& model, std::span<const RobotWork> robots,
               std::span<const std::uint32_t> members) {
    return members.size() > 1 && is_fast(model.accuracy) &&
           std::ranges::all_of(members, [&](std::uint32_t m) { return may_be_soft(*robots[m].type); });
}

bool are_of_one_patch(const Contact& a, const Contact& b) {
    return pair_of(a) == pair_of(b) && a.normal == b.normal;
}

bool can_solve(const Model& model, const Contact& contact, const SurfacePair& surface) {
    if (contact.robot_b < 0 && model.statics[contact.shape_b].shape.kind == ShapeKind::kSurface) return false;
    return contact.robot_a != contact.robot_b && surface.rolling == 0 && surface.softness.stiffness == 0 &&
           surface.slip_11 == 0 && surface.slip_12 == 0 && surface.slip_22 == 0;
}

bool Solver::take(const Island& island) {
    bodies_.clear();
    body_of_.resize(island.robots.size());
    for (const std::uint32_t m : island.members) {
        body_of_[m] = -1;
        if (island.robots[m].type->nv == 0) continue;
        body_of_[m] = static_cast<int>(bodies_.size());
        if (!take_body(island.robots[m], bodies_.emplace_back())) return false;
    }
    substep_ = substep_of(island.model.dt_s);
    list_pairs(island);
    batches_.arrange(bodies_.size(), pairs_, problem_);
    return true;
}

/// Contacts of one pair of shapes with one normal, at most eight, are a pair.
void Solver::list_pairs(const Island& island) {
    pairs_.clear();
    for (std::uint32_t first = 0, last = 0; first < island.contacts.size(); first = last) {
        const Contact& c = *island.contacts[first];
        while (last < island.contacts.size() && last < first + 8 &&
               are_of_one_patch(c, *island.contacts[last]))
            ++last;
        Pair pair{body_of_[static_cast<std::size_t>(c.robot_a)], -1, first, last - first, false, {}};
        if (c.robot_b >= 0) pair.b = body_of_[static_cast<std::size_t>(c.robot_b)];
        if (pair.a < 0) std::swap(pair.a, pair.b), pair.swapped = true;
        if (pair.a < 0) continue;
        pair.middle = middle_of(island, pair);
        pairs_.push_back(pair);
    }
}

namespace {

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
    const double way = pair.swapped ? -1 : 1, least = least_blow(island.model, island.surfaces[pair.first]);
    const Vec3 n = island.contacts[pair.first]->normal * way;
    const Body& a = bodies_[static_cast<std::size_t>(pair.a)];
    const double inverse_mass_b = pair.b < 0 ? 0 : bodies_[static_cast<std::size_t>(pair.b)].inverse_mass;
    put(n, lane, patch.n);
    patch.inverse_mass_a.x[lane] = a.inverse_mass, patch.inverse_mass_b.x[lane] = inverse_mass_b;
    patch.coefficient.x[lane] = island.surfaces[pair.first].friction.mu;
    patch.recovery.x[lane] = island.surfaces[pair.first].correction_speed;
    for (std::uint32_t k = 0; k < pair.points; ++k) {
        const Contact& c = *island.contacts[pair.first + k];
        const SurfacePair& surface = island.surfaces[pair.first + k];
        const Sides sides = sides_of(bodies_, pair, c.p_W, c.shift_b);
        const Vec3 turn_a = sides.turn_a(n), turn_b = sides.turn_b(n);
        Point& point = problem_.points[batch.first + k];
        put(turn_a, lane, point.turn_a), put(turn_b, lane, point.turn_b);
        const double speed = dot(n, surface.velocity) * way;
        double approach = -(dot(n, a.linear) + dot(turn_a, a.whitened(a.angular)) + speed);
        if (pair.b >= 0) {
            const Body& b = bodies_[static_cast<std::size_t>(pair.b)];
            approach += dot(n, b.linear) - dot(turn_b, b.whitened(b.angular));
        }
        point.gap.x[lane] = c.gap < 0 ? std::min(c.gap + surface.slop, 0.0) : c.gap;
        point.speed.x[lane] = speed;
        point.mass.x[lane] =
            1 / ((a.inverse_mass + inverse_mass_b) + (norm_squared(turn_a) + norm_squared(turn_b)));
        if (surface.restitution > 0 && approach > least)
            point.bounce.x[lane] = surface.restitution * approach;
        point.impulse.x[lane] = (c.impulse > 0 ? c.load : start.fresh_load) / kSubsteps;
    }
}

void Solver::fill_friction(const Island& island, const Pair& pair, const Start& start, std::size_t lane,
                           const Batch& batch, Patch& patch) {
    const double way = pair.swapped ? -1 : 1;
    const Contact& first = *island.contacts[pair.first];
    const SurfacePair& surface = island.surfaces[pair.first];
    const ContactFrame frame = frame_of(first.normal * way, surface.friction);
    const Vec3& middle = pair.middle;
    const Sides sides = sides_of(bodies_, pair, middle, first.shift_b);
    Vec3 friction = start.lost * way, speed = surface.velocity;
    double twist = 0;
    for (std::uint32_t k = 0; k < pair.points; ++k) {
        const Contact& c = *island.contacts[pair.first + k];
        const Vec3 arm = c.p_W - middle, kept = c.friction * (start.steady * way);
        problem_.points[batch.first + k].lever.x[lane] =
            surface.friction.mu * norm(arm) + island.surfaces[pair.first + k].torsional;
        friction += kept, twist += dot(frame.n, cross(arm, kept));
    }
    const Vec3 a_1 = sides.turn_a(frame.t1), b_1 = sides.turn_b(frame.t1), a_2 = sides.turn_a(frame.t2),
               b_2 = sides.turn_b(frame.t2), a_w = sides.a.body->turned_by(frame.n),
               b_w = sides.b.body == nullptr ? Vec3{} : sides.b.body->turned_by(-frame.n);
    const double inverse_mass = patch.inverse_mass_a.x[lane] + patch.inverse_mass_b.x[lane];
    const double across2 = norm_squared(frame.t2), k_11 = (dot(a_1, a_1) + dot(b_1, b_1)) + inverse_mass,
                 k_12 = dot(a_1, a_2) + dot(b_1, b_2),
                 k_22 = (dot(a_2, a_2) + dot(b_2, b_2)) + inverse_mass * across2;
    put(frame.t1, lane, patch.t1), put(frame.t2, lane, patch.t2);
    put(a_1, lane, patch.slide_1a), put(b_1, lane, patch.slide_1b);
    put(a_2, lane, patch.slide_2a), put(b_2, lane, patch.slide_2b);
    put(a_w, lane, patch.twist_a), put(b_w, lane, patch.twist_b);
    const double det = k_11 * k_22 - k_12 * k_12;
    if (across2 > 0 && det > 0) {
        patch.mass_11.x[lane] = k_22 / det, patch.mass_12.x[lane] = -k_12 / det;
        patch.mass_22.x[lane] = k_11 / det;
        patch.slide_2.x[lane] = dot(frame.t2, friction) / (across2 * kSubsteps);
    } else {
        patch.mass_11.x[lane] = 1 / k_11;
    }
    patch.mass_twist.x[lane] = 1 / (norm_squared(a_w) + norm_squared(b_w));
    patch.speed_1.x[lane] = dot(frame.t1, speed) * way, patch.speed_2.x[lane] = dot(frame.t2, speed) * way;
    patch.speed_twist.x[lane] = dot(frame.n, surface.turning) * way;
    patch.slide_1.x[lane] = dot(frame.t1, friction) / kSubsteps, patch.twist.x[lane] = twist / kSubsteps;
}

/// Batches of a colour side by side, colour after colour.
void Solver::run(Pass pass, const Team& team) {
    constexpr std::size_t kBlock = 4;  // batches
    for (std::size_t c = 0; c + 1 < problem_.colours.size(); ++c) {
        const std::size_t begin = problem_.colours[c], count = problem_.colours[c + 1] - begin;
        team.run_blocks(count, kBlock, [&](std::size_t first, std::size_t last) {
            kernel().run(problem_, begin + first, begin + last, pass, substep_);
        });
    }
}

void Solver::solve(const Island& island, const Team& team) {
    constexpr std::size_t kBlock = 64, kBatches = 8;
    const std::size_t count = bodies_.size();
    Problem& p = problem_;
    p.velocity.resize(count + 1), p.displacement.assign(count + 1, {}), p.kick.resize(count),
        p.free.resize(count);
    p.velocity[count] = {};
    const auto for_bodies = [&](const auto& act) {
        team.run_blocks(count, kBlock, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = first; b < last; ++b) act(b);
        });
    };
    for_bodies([&](std::size_t b) {
        p.kick[b] = kick_of(island.model, bodies_[b], substep_.h);
        const Motion now = velocity_of(bodies_[b]);
        for (std::size_t i = 0; i < 8; ++i) p.free[b].x[i] = p.velocity[b].x[i] = now.x[i] + p.kick[b].x[i];
    });
    team.run_blocks(p.batches.size(), kBatches, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) fill_batch(island, b);
    });
    run(Pass::kWarm, team);
    for (int k = 0; k < kSubsteps; ++k) {
        substep_.elapsed = k * substep_.h;
        run(Pass::kPush, team);
        for_bodies([&](std::size_t b) {
            for (std::size_t i = 0; i < 8; ++i) p.displacement[b].x[i] += substep_.h * p.velocity[b].x[i];
        });
        substep_.elapsed = (k + 1) * substep_.h;
        run(Pass::kRelax, team);
        if (k + 1 == kSubsteps) break;
        for_bodies([&](std::size_t b) {  // the impulses act in the next substep again
            for (std::size_t i = 0; i < 8; ++i) {
                const double now = p.velocity[b].x[i], again = now - p.free[b].x[i];
                p.free[b].x[i] = now + p.kick[b].x[i], p.velocity[b].x[i] = p.free[b].x[i] + again;
            }
        });
    }
    run(Pass::kBounce, team);
}

/// The impulses of a patch, and its friction shared among the points: by their impulses, and about their
/// middle as much as gives the twist. So the next tick finds force and twist again.
void Solver::give(const Island& island, const Pair& pair, std::size_t lane, const Batch& batch,
                  const Patch& patch) const {
    const double way = pair.swapped ? -1 : 1;
    const auto vector = [lane](const Eight* e) { return Vec3{e[0].x[lane], e[1].x[lane], e[2].x[lane]}; };
    const Vec3 n = vector(patch.n),
               friction = vector(patch.t1) * patch.total_1.x[lane] + vector(patch.t2) * patch.total_2.x[lane];
    const double twist = patch.total_twist.x[lane];
    double sum = 0;
    Vec3 pressed;
    for (std::uint32_t k = 0; k < pair.points; ++k) {
        Contact& c = *island.contacts[pair.first + k];
        const Point& point = problem_.points[batch.first + k];
        c.impulse = point.total.x[lane];
        c.load = point.impulse.x[lane] * kSubsteps;
        sum += c.impulse, pressed += c.p_W * c.impulse;
    }
    if (sum > 0) pressed = pressed / sum;
    double spread = 0;
    for (std::uint32_t k = 0; k < pair.points; ++k) {
        const Contact& c = *island.contacts[pair.first + k];
        if (sum > 0) spread += c.impulse / sum * norm_squared(cross(n, c.p_W - pressed));
    }
    constexpr double kPoint = 1e-12;  // m^2: one place gives no twist but by its own surface
    const double turn =
        spread > kPoint ? (twist - dot(n, cross(pressed - pair.middle, friction))) / spread : 0.0;
    for (std::uint32_t k = 0; k < pair.points; ++k) {
        Contact& c = *island.contacts[pair.first + k];
        const double share = sum > 0 ? c.impulse / sum : 0;
        c.friction = (friction + cross(n, c.p_W - pressed) * turn) * (share * way);
        c.moment = spread > kPoint ? Vec3{} : n * (twist * share * way);
    }
}

/// True if no contact has changed the body's motion: the same sums without them have the same bits.
bool Solver::flies(std::size_t b) const {
    const Motion start = velocity_of(bodies_[b]);
    const Motion &kick = problem_.kick[b], &velocity = problem_.velocity[b],
                 &moved = problem_.displacement[b];
    for (std::size_t i = 0; i < 6; ++i) {
        double v = start.x[i] + kick.x[i], d = substep_.h * v;
        for (int k = 1; k < kSubsteps; ++k) v += kick.x[i], d += substep_.h * v;
        if (v != velocity.x[i] || d != moved.x[i]) return false;
    }
    return true;
}

void Solver::mark_pushed() {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        if (!flies(b)) bodies_[b].touched = bodies_[b].robot->pushed = true;
}

void Solver::give_impulses(const Island& island) const {
    for (Contact* c : island.contacts) c->impulse = c->load = 0, c->friction = c->moment = {};
    for (std::size_t batch = 0; batch < problem_.batches.size(); ++batch) {
        const Batch& b = problem_.batches[batch];
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(b.patches); ++lane)
            give(island, pair_at(batch, lane), lane, b, problem_.patches[batch]);
    }
}

void Solver::give_motion(const Island& island, std::span<const int> offsets, std::span<double> velocity,
                         std::span<double> displacement) const {
    for (const std::uint32_t m : island.members) {
        if (body_of_[m] < 0) continue;
        const auto b = static_cast<std::size_t>(body_of_[m]), first = static_cast<std::size_t>(offsets[m]);
        put_motion(problem_.velocity[b], bodies_[b], 1, velocity.subspan(first, 6));
        put_motion(problem_.displacement[b], bodies_[b], 1 / island.model.dt_s,
                   displacement.subspan(first, 6));
    }
}

void Solver::move(const Island& island, FreeBuffer& buffer) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        RobotWork& robot = *bodies_[b].robot;
        if (bodies_[b].touched) {
            robot.held = true;
            move_body(problem_.velocity[b], problem_.displacement[b], island.model.dt_s, bodies_[b]);
        } else {
            advance_freely(island.model, robot, buffer);
        }
    }
}

}  // namespace roboss::soft
