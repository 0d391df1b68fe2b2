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

}  // namespace

bool can_solve(const Model& model, std::span<const RobotWork> robots,
               std::span<const std::uint32_t> members) {
    constexpr double kMostTurn = 0.5;  // rad of a link in a tick: rows do not hold for more
    const auto can_take = [&](std::uint32_t m) {
        const RobotType& type = *robots[m].type;
        return may_be_soft(type) || (may_be_tree(type) && fastest_turn(robots[m]) * model.dt_s * model.dt_s <
                                                              kMostTurn * kMostTurn);
    };
    return members.size() > 1 && is_fast(model.accuracy) && std::ranges::all_of(members, can_take);
}

bool are_of_one_patch(const Contact& a, const Contact& b) {
    return pair_of(a) == pair_of(b) && a.normal == b.normal;
}

bool can_solve(const Model& model, const Contact& contact, const SurfacePair& surface) {
    if (contact.robot_b < 0 && model.statics[contact.shape_b].shape.kind == ShapeKind::kSurface) return false;
    return surface.rolling == 0 && surface.softness.stiffness == 0 && surface.slip_11 == 0 &&
           surface.slip_12 == 0 && surface.slip_22 == 0;
}

bool Solver::take(const Island& island) {
    bodies_.clear();
    slots_.resize(island.robots.size());
    for (const std::uint32_t m : island.members) {
        slots_[m] = -1;
        const RobotType& type = *island.robots[m].type;
        if (type.nv == 0 || !type.dofs.empty()) continue;
        slots_[m] = static_cast<int>(bodies_.size());
        if (!take_body(island.robots[m], bodies_.emplace_back())) return false;
    }
    substep_ = substep_of(island.model.dt_s);
    return take_trees(island);
}

bool Solver::take_trees(const Island& island) {
    trees_.clear(), tree_of_.clear(), joints_.clear();
    std::size_t count = 0;
    for (const std::uint32_t m : island.members) {
        RobotWork& robot = island.robots[m];
        if (robot.type->dofs.empty()) continue;
        Tree& tree = trees_.emplace_back();
        tree.robot = &robot, tree.M = robot.mass_matrix.data();
        tree.slot = bodies_.size() + tree_of_.size();
        slots_[m] = static_cast<int>(tree.slot);
        tree_of_.resize(tree_of_.size() + motions_of(tree.nv()), trees_.size() - 1);
        count += tree.nv();
    }
    roots_.resize(count);
    std::size_t first = 0, row = 0;
    for (Tree& tree : trees_) {
        const std::span<double> root = std::span(roots_).subspan(first, tree.nv());
        if (!factor_tree(*tree.robot, root)) return false;
        tree.root = root, first += tree.nv();
        const int begin = island.offsets[static_cast<std::size_t>(tree.robot - island.robots.data())];
        std::size_t end = row;
        while (end < island.joints.size() && island.joints[end].dof < begin + tree.robot->type->nv) ++end;
        joints_.add(island.model, tree, island.joints.subspan(row, end - row), begin);
        row = end;
    }
    return true;
}

void Solver::take_contacts(const Island& island) {
    bounces_ = std::ranges::any_of(island.surfaces, [](const SurfacePair& s) { return s.restitution > 0; });
    constexpr double kDeep = 5e-3;  // m
    deep_ = std::ranges::any_of(island.contacts, [](const Contact* c) { return c->gap < -kDeep; });
    list_pairs(island);
    batches_.arrange(bodies_.size() + tree_of_.size(), pairs_, problem_);
}

/// -1: the side of the contact does not move by itself.
int Solver::slot_of(int robot, int body) const {
    return robot < 0 || body < 0 ? -1 : slots_[static_cast<std::size_t>(robot)];
}

/// Contacts of one pair of shapes with one normal, at most eight, are a pair.
void Solver::list_pairs(const Island& island) {
    pairs_.clear(), jointed_.clear();
    const auto is_tree = [&](int slot) { return slot >= static_cast<int>(bodies_.size()); };
    for (std::uint32_t first = 0, last = 0; first < island.contacts.size(); first = last) {
        const Contact& c = *island.contacts[first];
        while (last < island.contacts.size() && last < first + 8 &&
               are_of_one_patch(c, *island.contacts[last]))
            ++last;
        Pair pair;
        pair.first = first, pair.points = last - first;
        pair.a = slot_of(c.robot_a, c.body_a), pair.b = slot_of(c.robot_b, c.body_b);
        pair.itself = c.robot_a == c.robot_b;
        if (pair.itself) pair.a = std::max(pair.a, pair.b), pair.b = -1;
        if (pair.a < 0) std::swap(pair.a, pair.b), pair.swapped = true;
        if (pair.a < 0) continue;
        pair.middle = middle_of(island, pair);
        pair.jointed = is_tree(pair.a) || is_tree(pair.b);
        if (pair.jointed) {
            const JointedPair& sides = jointed_.emplace_back(jointed_pair(island, pair));
            pair.sides = static_cast<std::uint32_t>(jointed_.size() - 1);
            pair.further_a = sides.a.path.further(), pair.further_b = sides.b.path.further();
        }
        pairs_.push_back(pair);
    }
}

/// Batches of a colour side by side, colour after colour; then the joints of each robot.
void Solver::run(Pass pass, const Team& team) {
    constexpr std::size_t kBlock = 4, kTrees = 16;
    for (std::size_t c = 0; c + 1 < problem_.colours.size(); ++c) {
        const std::size_t begin = problem_.colours[c], count = problem_.colours[c + 1] - begin;
        team.run_blocks(count, kBlock, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = begin + first, next = b; b < begin + last; b = next) {
                const int patches = problem_.batches[b].patches;
                while (next < begin + last && problem_.batches[next].patches == patches) ++next;
                kernel(patches).run(problem_, b, next, pass, substep_);
            }
        });
    }
    if (pass == Pass::kBounce) return;
    team.run_blocks(trees_.size(), kTrees, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) {
            double* velocity = problem_.velocity[trees_[t].slot].x;
            if (pass == Pass::kWarm)
                joints_.warm(t, velocity);
            else
                joints_.solve(t, substep_, pass == Pass::kPush, problem_.displacement[trees_[t].slot].x,
                              velocity);
        }
    });
}

/// Velocities before the tick, and what changes them besides contacts and the rows of joints: in each substep
/// its share.
void Solver::start_tree(const Tree& tree) {
    double* now = problem_.velocity[tree.slot].x;
    double* kick = problem_.kick[tree.slot].x;
    whiten_velocity(tree, tree.robot->state->v, now);
    whiten_impulse(tree, tree.robot->impulse, kick);
    double* free = problem_.free[tree.slot].x;
    for (std::size_t i = 0; i < tree.nv(); ++i) {
        kick[i] = (kick[i] - now[i]) / kSubsteps;
        free[i] = now[i] = now[i] + kick[i];
    }
    for (std::size_t i = tree.nv(); i < 8 * motions_of(tree.nv()); ++i) free[i] = now[i] = kick[i] = 0;
}

void Solver::start(const Island& island, const Team& team) {
    constexpr std::size_t kBlock = 64, kTrees = 16, kBatches = 8;
    Problem& p = problem_;
    const std::size_t count = bodies_.size() + tree_of_.size();
    p.velocity.resize(count + 1), p.displacement.assign(count + 1, {}), p.kick.resize(count),
        p.free.resize(count);
    p.velocity[count] = {};
    team.run_blocks(bodies_.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            p.kick[b] = kick_of(island.model, bodies_[b], substep_.h);
            const Motion now = velocity_of(bodies_[b]);
            for (std::size_t i = 0; i < 8; ++i)
                p.free[b].x[i] = p.velocity[b].x[i] = now.x[i] + p.kick[b].x[i];
        }
    });
    team.run_blocks(trees_.size(), kTrees, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) start_tree(trees_[t]);
    });
    team.run_blocks(p.batches.size(), kBatches, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) fill_batch(island, b);
    });
}

void Solver::solve(const Island& island, const Team& team) {
    constexpr std::size_t kBlock = 64;
    Problem& p = problem_;
    start(island, team);
    const auto for_motions = [&](const auto& act) {
        team.run_blocks(p.kick.size(), kBlock, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = first; b < last; ++b)
                for (std::size_t i = 0; i < 8; ++i) act(b, i);
        });
    };
    run(Pass::kWarm, team);
    for (int k = 0; k < kSubsteps; ++k) {
        substep_.elapsed = k * substep_.h;
        run(Pass::kPush, team);
        for_motions(
            [&](std::size_t b, std::size_t i) { p.displacement[b].x[i] += substep_.h * p.velocity[b].x[i]; });
        substep_.elapsed = (k + 1) * substep_.h;
        run(Pass::kRelax, team);
        if (k + 1 == kSubsteps) break;
        for_motions([&](std::size_t b, std::size_t i) {  // the impulses act in the next substep again
            const double now = p.velocity[b].x[i], again = now - p.free[b].x[i];
            p.free[b].x[i] = now + p.kick[b].x[i], p.velocity[b].x[i] = p.free[b].x[i] + again;
        });
    }
    if (bounces_) run(Pass::kBounce, team);
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

/// True if nothing has changed the motion besides the kicks: the same sums without the rest have the same
/// bits.
bool Solver::flies(std::span<const double> start, std::size_t slot) const {
    const double *kick = problem_.kick[slot].x, *velocity = problem_.velocity[slot].x,
                 *moved = problem_.displacement[slot].x;
    for (std::size_t i = 0; i < start.size(); ++i) {
        double v = start[i] + kick[i], d = substep_.h * v;
        for (int k = 1; k < kSubsteps; ++k) v += kick[i], d += substep_.h * v;
        if (v != velocity[i] || d != moved[i]) return false;
    }
    return true;
}

/// Robots whose joints have rows count where a contact ends with an impulse.
void Solver::mark_pushed(const Island& island) {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        if (const Motion start = velocity_of(bodies_[b]); !flies(std::span(start.x, 6), b))
            bodies_[b].touched = bodies_[b].robot->pushed = true;
    for (std::size_t t = 0; t < trees_.size(); ++t) {
        if (joints_.has_rows(t)) continue;
        double start[kMostDofs];
        whiten_velocity(trees_[t], trees_[t].robot->state->v, start);
        if (!flies(std::span<const double>(start).first(trees_[t].nv()), trees_[t].slot))
            trees_[t].robot->pushed = true;
    }
    for (std::size_t batch = 0; batch < problem_.batches.size(); ++batch) {
        const Batch& b = problem_.batches[batch];
        for (std::size_t lane = 0; b.jointed && lane < static_cast<std::size_t>(b.patches); ++lane) {
            const Pair& pair = pair_at(batch, lane);
            const Contact& c = *island.contacts[pair.first];
            bool pushes = false;
            for (std::size_t k = 0; k < pair.points; ++k)
                pushes |= problem_.points[b.first + k].total.x[lane] > 0;
            for (const int robot : {c.robot_a, c.robot_b})
                if (pushes && robot >= 0) island.robots[static_cast<std::size_t>(robot)].pushed = true;
        }
    }
}

void Solver::give_impulses(const Island& island) const {
    for (Contact* c : island.contacts) c->impulse = c->load = 0, c->friction = c->moment = {};
    for (std::size_t batch = 0; batch < problem_.batches.size(); ++batch) {
        const Batch& b = problem_.batches[batch];
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(b.patches); ++lane)
            give(island, pair_at(batch, lane), lane, b, problem_.patches[batch]);
    }
    joints_.give(island.joints);
}

void Solver::give_motion(const Island& island, std::span<const int> offsets, std::span<double> velocity,
                         std::span<double> displacement) const {
    const double per_dt = 1 / island.model.dt_s;
    const auto first = [&](const RobotWork* robot) {
        return static_cast<std::size_t>(offsets[static_cast<std::size_t>(robot - island.robots.data())]);
    };
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const std::size_t at = first(bodies_[b].robot);
        put_motion(problem_.velocity[b], bodies_[b], 1, velocity.subspan(at, 6));
        put_motion(problem_.displacement[b], bodies_[b], per_dt, displacement.subspan(at, 6));
    }
    for (const Tree& tree : trees_) {
        const std::size_t at = first(tree.robot);
        put_velocity(tree, problem_.velocity[tree.slot].x, 1, velocity.subspan(at, tree.nv()));
        put_velocity(tree, problem_.displacement[tree.slot].x, per_dt, displacement.subspan(at, tree.nv()));
    }
}

/// Kicks are what momentum changed by, without forces and the rows of joints. What the displacement has
/// beside the velocity is to be what contacts gave: the drift has forces, which act evenly, and joints by
/// itself.
void Solver::prepare_drift(const Island& island, std::span<const char> drifts, std::span<double> kick,
                           std::span<double> displacement) const {
    constexpr double kLack = 0.5 * (kSubsteps - 1);  // of the changes in a substep
    const double per_dt = 1 / island.model.dt_s;
    std::size_t t = 0;
    for (std::size_t m = 0; m < island.members.size(); ++m) {
        const RobotWork& robot = island.robots[island.members[m]];
        if (robot.type->dofs.empty()) continue;
        const Tree& tree = trees_[t++];
        if (!drifts[m]) continue;
        const double* velocity = problem_.velocity[tree.slot].x;
        const auto first = static_cast<std::size_t>(island.offsets[island.members[m]]);
        const std::span<double> own = kick.subspan(first, tree.nv());
        add_impulse(tree, velocity, own);
        double extra[kMostDofs], by_extra[kMostDofs];
        for (std::size_t i = 0; i < own.size(); ++i) {
            own[i] -= robot.impulse[i];
            extra[i] = problem_.displacement[tree.slot].x[i] * per_dt - velocity[i] +
                       problem_.kick[tree.slot].x[i] * kLack;
        }
        joints_.take_out(t - 1, extra);
        put_velocity(tree, extra, 1, std::span(by_extra).first(tree.nv()));
        put_velocity(tree, velocity, 1, displacement.subspan(first, tree.nv()));
        for (std::size_t i = 0; i < own.size(); ++i) displacement[first + i] += by_extra[i];
    }
    for (const JointRow& row : island.joints) kick[static_cast<std::size_t>(row.dof)] -= row.impulse;
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
