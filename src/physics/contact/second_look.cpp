// See second_look.h.
#include "physics/contact/second_look.h"

#include <algorithm>
#include <array>

#include "core/make_room.h"
#include "geometry/collide.h"
#include "physics/contact/island_guard.h"
#include "physics/contact/pair_of.h"
#include "physics/dynamics/fast_turning.h"
#include "physics/dynamics/lone_body.h"

namespace roboss {
namespace {

/// Those of which the robot is the first, of contacts in the order of their first robots.
std::span<const Contact* const> contacts_of(std::uint32_t robot, std::span<const Contact* const> contacts) {
    const auto before = [](const Contact* c, int r) { return c->robot_a < r; };
    const int own = static_cast<int>(robot);
    const auto first = std::lower_bound(contacts.begin(), contacts.end(), own, before);
    return {first, std::lower_bound(first, contacts.end(), own + 1, before)};
}

bool is_plane(const Model& model, const Contact& c) {
    return c.robot_b < 0 && model.statics[c.shape_b].shape.kind == ShapeKind::kPlane;
}

/// Upper bound of what turns_far asks, from the joints' velocities alone.
bool may_turn_far(const RobotType& type, std::span<const double> displacement, double dt) {
    constexpr double kArc = 2e-4;  // m
    double turning = 0;
    for (std::size_t i = 0; i < displacement.size(); ++i)
        if (!type.free_base || i < 3 || i > 5) turning += std::fabs(displacement[i]);
    return 0.5 * turning * turning * dt * dt * type.reach > kArc;
}

/// Whether the robot's points may move further than their speeds before the tick say, by more than is allowed
/// for anyhow.
bool is_struck(const RobotWork& robot, std::span<const double> displacement, double dt) {
    double change = 0;
    for (std::size_t i = 0; i < displacement.size(); ++i) {
        const bool is_linear = robot.type->free_base && i >= 3 && i < 6;
        change += std::fabs(displacement[i] - robot.state->v[i]) *
                  (is_linear ? 1.0 : std::max(1.0, robot.type->reach));
    }
    return change * dt > kBaseMargin;
}

double speed_of(const Course& c) {
    return norm(c.velocity(c.X.p, 0)) + c.turning;
}

/// m: no ball inside the shape is larger across; 0: not known.
double thickness_of(const Shape& shape) {
    switch (shape.kind) {
        case ShapeKind::kBox:
        case ShapeKind::kEllipsoid:
            return 2 * std::min({shape.half.x, shape.half.y, shape.half.z});
        case ShapeKind::kSphere:
        case ShapeKind::kCapsule:
            return 2 * shape.radius;
        case ShapeKind::kCylinder:
            return 2 * std::min(shape.radius, shape.half_length);
        case ShapeKind::kHull:
            return 2 * shape.hull->inradius;
        case ShapeKind::kPlane:
        case ShapeKind::kSurface:
            break;
    }
    return 0;
}

/// True if shapes may come so deep into each other in one tick that they would be pushed out on the other
/// side.
bool may_go_through(const Course& a, const Course& b, double dt) {
    constexpr double kShare = 0.1;  // of the thinner one
    return (speed_of(a) + speed_of(b)) * dt >
           kShare * std::min(thickness_of(*a.shape), thickness_of(*b.shape));
}

/// 1/kg: how easily a robot is moved as a whole; 0 if it stands on a fixed base.
double inverse_mass_of(const RobotWork& robot) {
    if (!robot.type->free_base) return 0;
    double mass = 0;
    for (const Body& body : robot.type->bodies) mass += body.mass;
    return mass > 0 ? 1 / mass : 0;
}

void shift_base(const Vec3& by, RobotState& state) {
    state.q[0] += by.x, state.q[1] += by.y, state.q[2] += by.z;
}

}  // namespace

/// Whether a contact or a hit found already pushes the robot.
bool SecondLook::is_pushed(const SolvedIsland& island, int robot) const {
    return island.robots[static_cast<std::size_t>(robot)].pushed ||
           std::ranges::any_of(
               hits_, [&](const Contact& hit) { return hit.robot_a == robot || hit.robot_b == robot; });
}

/// Whether what happens to the robot in this tick may differ from what was known before solving.
bool SecondLook::is_bent(const SolvedIsland& island, int robot) const {
    if (robot < 0) return false;
    const auto i = static_cast<std::size_t>(robot);
    const RobotWork& work = island.robots[i];
    return is_pushed(island, robot) ||
           !(is_free_body(*work.type) || island.free_courses.knows(island.model, work, i));
}

/// The robot with the velocities of its displacement.
const Mechanics<double>& SecondLook::moved(const SolvedIsland& island, int robot) {
    const auto i = static_cast<std::size_t>(robot);
    const RobotWork& work = island.robots[i];
    Mechanics<double>& to = moved_[i];
    if (is_moved_[i]) return to;
    is_moved_[i] = 1;
    to.type = work.type, to.origin = work.origin, to.base = work.base;
    to.bodies = work.bodies, to.axes = work.axes, to.X_W0 = work.X_W0;
    to.shapes.resize(work.shapes.size());
    for (const std::uint32_t s : work.type->shape_groups.loose) to.shapes[s] = work.shapes[s];
    const auto first = static_cast<std::size_t>(island.offsets[i]);
    if (work.type->nv > 0)
        forward_velocities<double>(
            *work.type, island.displacement.subspan(first, static_cast<std::size_t>(work.type->nv)), to);
    return to;
}

Course SecondLook::course(const SolvedIsland& island, int robot, std::uint32_t shape) {
    if (robot < 0) {
        const StaticShape& scenery = island.model.statics[shape];
        return resting_course(scenery.shape, scenery.X_WS);
    }
    const auto i = static_cast<std::size_t>(robot);
    if (!is_pushed(island, robot))
        if (const auto free = island.free_courses.find(island.model, island.robots[i], i, shape))
            return *free;
    const double dt = island.model.dt_s;
    const Mechanics<double>& to = moved(island, robot);
    if (large_turns_[i] == 0 || !is_pushed(island, robot)) return course_of(to, shape, dt);
    if (drifts_[i] == 0) return steady_course_of(to, shape);
    if (anchored_) return course_of(to, shape, dt);
    const double* v = island.velocity.data() + island.offsets[i];
    return shifted_course_of(to, shape, {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}, dt);
}

/// The angular velocity of the displacement. The course of a body of revolution lacks the spin about its
/// axis.
Vec3 SecondLook::turning(const SolvedIsland& island, int robot, std::uint32_t shape, const Course& course) {
    if (robot < 0 || large_turns_[static_cast<std::size_t>(robot)] == 0) return course.angular;
    const Mechanics<double>& to = moved(island, robot);
    return to.type->shapes[shape].body < 0 ? course.angular : to.bodies[0].velocity.angular;
}

void SecondLook::add(const SolvedIsland& island, const ShapePair& pair, const Course& a, const Course& b,
                     double t, const Vec3& normal, const Vec3& p_W, double gap) {
    const auto body = [&](int robot, std::uint32_t shape) {
        return robot < 0 ? -1 : island.robots[static_cast<std::size_t>(robot)].type->shapes[shape].body;
    };
    make_room(hits_, hits_.size() + 1);
    Contact& c = hits_.emplace_back();
    c.robot_a = pair.robot_a, c.robot_b = pair.robot_b;
    c.shape_a = pair.shape_a, c.shape_b = pair.shape_b;
    c.body_a = body(pair.robot_a, pair.shape_a), c.body_b = body(pair.robot_b, pair.shape_b);
    c.normal = normal, c.p_W = p_W, c.gap = gap;
    take_back(a, b, t, c);
}

/// The planes of a surface that hold a shape already.
void SecondLook::hold_planes(const SolvedIsland& island, const ShapePair& pair) {
    buffers_.held.clear();
    const auto i = static_cast<std::size_t>(pair.robot_a);
    const Course before = known_course(island.model, island.robots[i], i, pair.shape_a, island.free_courses);
    for (const Contact* c : island.contacts)
        if (pair_of(*c) == pair) buffers_.held.push_back({c->normal, c->p_W + before.shift(c->time)});
}

void SecondLook::find_missed(const SolvedIsland& island, const NearMiss& pair) {
    const Model& model = island.model;
    if (!is_bent(island, pair.robot_a) && !is_bent(island, pair.robot_b)) return;
    const Course a = course(island, pair.robot_a, pair.shape_a);
    const Course b = course(island, pair.robot_b, pair.shape_b);
    if (island.passing_only && !may_go_through(a, b, model.dt_s)) return;
    if (b.shape->kind == ShapeKind::kSurface) {
        const double margin = speed_of(a) * model.dt_s + 2 * kBaseMargin;
        hold_planes(island, pair);
        const TriangleSurface& surface = *b.shape->surface;
        const auto t = time_of_impact(a, surface, b.X, model.dt_s, kDeep, margin, buffers_.held,
                                      buffers_.there.triangles);
        if (!t) return;
        find_met(*a.shape, a.at(*t), surface, b.X, margin, buffers_);
        for (const SurfaceContact& c : buffers_.met) add(island, pair, a, b, *t, c.n_W, c.p_W, c.gap);
        return;
    }
    add_first_hit(island, pair, pair.normal, a, b);
}

/// Where two convex shapes meet first. False if they do not. `normal` may separate them (zero: unknown).
bool SecondLook::add_first_hit(const SolvedIsland& island, const ShapePair& pair, const Vec3& normal,
                               const Course& a, const Course& b) {
    const double dt = island.model.dt_s, margin = (speed_of(a) + speed_of(b)) * dt + 2 * kBaseMargin;
    const Vec3 d = normal != Vec3{} ? normal : a.X.p - b.X.p;
    if (d != Vec3{} && surely_pass(a, b, dt, normalized(d), kDeep)) return false;
    Manifold m = collide(*a.shape, a.X, *b.shape, b.X, margin);
    if (m.count == 0) return false;
    const auto t = time_of_impact(a, b, dt, kDeep, margin, m);
    if (!t) return false;
    for (int i = 0; i < m.count; ++i) {
        const ContactPoint& p = m.points[static_cast<std::size_t>(i)];
        add(island, pair, a, b, *t, m.n_W, p.p_W, p.gap);
    }
    return true;
}

/// A robot that another one strikes may move further than contacts were searched for. So far only scenery is
/// looked for: another robot there may be none of the group.
void SecondLook::find_struck(const SolvedIsland& island, std::uint32_t robot) {
    const RobotWork& work = island.robots[robot];
    const ShapeGroups& groups = work.type->shape_groups;
    const Mechanics<double>& to = moved(island, static_cast<int>(robot));
    shapes_.start(work, island.model.dt_s);
    for (const std::uint32_t s : groups.loose) find_struck(island, robot, s);
    for (const ShapeCrowd& crowd : groups.crowds)
        if (crowd.body >= 0 && may_strike_scenery(island.model, to, crowd))
            for (const std::uint32_t s : crowd.shapes) find_struck(island, robot, s);
}

/// Planes apart.
bool SecondLook::may_strike_scenery(const Model& model, const Mechanics<double>& moved,
                                    const ShapeCrowd& crowd) {
    const BodyWork& body = moved.bodies[static_cast<std::size_t>(crowd.body)];
    const double speed = speed_within(moved, body.velocity, body.X_WB.p, crowd.radius);
    model.static_bvh.query(crowd_box(crowd, body.X_WB, 2 * kBaseMargin + speed * model.dt_s), scenery_);
    return std::ranges::any_of(
        scenery_, [&](std::uint32_t i) { return model.statics[i].shape.kind != ShapeKind::kPlane; });
}

void SecondLook::find_struck(const SolvedIsland& island, std::uint32_t robot, std::uint32_t s) {
    const BodyShape& shape = island.robots[robot].type->shapes[s];
    const Model& model = island.model;
    if (shape.body < 0) return;
    const Mechanics<double>& to = moved(island, static_cast<int>(robot));
    const double reach = speed_of(course_of(to, s, model.dt_s)) * model.dt_s + kBaseMargin;
    const ShapeWork& placed = shapes_[s];
    if (reach <= placed.margin) return;
    model.static_bvh.query(bounds(shape.shape, placed.X_WS).inflated(reach), scenery_);
    const std::span<const Contact* const> own = contacts_of(robot, island.contacts);
    for (const std::uint32_t i : scenery_) {
        const StaticShape& scenery = model.statics[i];
        const NearMiss pair{{static_cast<int>(robot), -1, s, i}, {}};
        const bool is_known = std::ranges::binary_search(island.near_misses, pair) ||
                              std::ranges::any_of(own, [&](const Contact* c) { return pair == pair_of(*c); });
        if (is_known || scenery.shape.kind == ShapeKind::kPlane) continue;
        if (may_collide(shape.material, scenery.material)) find_missed(island, pair);
    }
}

/// The least gap of two shapes at time t, if they overlap.
double SecondLook::gap_at(const Course& a, const Course& b, double t) {
    if (b.shape->kind != ShapeKind::kSurface)
        return least_gap(collide(*a.shape, a.at(t), *b.shape, b.at(t), 0));
    collide_surface(*a.shape, a.at(t), *b.shape->surface, b.X, 0, buffers_.there);
    double gap = 0;
    for (const SurfaceContact& c : buffers_.there.points) gap = std::min(gap, c.gap);
    return gap;
}

/// The last time before two shapes first sink deeper than `least`, if they do in the tick.
std::optional<double> SecondLook::time_of_sinking(const Course& a, const Course& b, double dt, double least) {
    constexpr int kParts = 8, kHalvings = 6;
    const auto sinks = [&](double t) { return gap_at(a, b, t) < least - kDeep; };
    double low = 0, high = 0;
    for (int part = 1; part <= kParts && (high == 0 || !sinks(high)); ++part)
        low = high, high = part == kParts ? dt : part * dt / kParts;
    if (high == dt && !sinks(dt)) return std::nullopt;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (sinks(middle) ? high : low) = middle;
    }
    return low;
}

/// `contacts`: of one pair of shapes. At the end of the tick no point may be deeper than it was at its
/// beginning. Where a thin shape has come out behind the other, the end says nothing of where it went in.
void SecondLook::find_turned(const SolvedIsland& island, std::span<const Contact* const> contacts) {
    const ShapePair pair = pair_of(*contacts.front());
    const double dt = island.model.dt_s;
    double least = 0;
    for (const Contact* c : contacts) least = std::min(least, c->gap);
    const Course a = course(island, pair.robot_a, pair.shape_a);
    const Course b = course(island, pair.robot_b, pair.shape_b);
    const Vec3 turning_a = turning(island, pair.robot_a, pair.shape_a, a),
               turning_b = turning(island, pair.robot_b, pair.shape_b, b);
    if (!turns_far<double>(*a.shape, a.X.R, turning_a, dt) &&
        !turns_far<double>(*b.shape, b.X.R, turning_b, dt))
        return;
    if (first_) turned_.push_back({pair, least, contacts.front()->normal});
    const std::size_t known = hits_.size();
    const auto see = [&](const Vec3& normal, const Vec3& p_W, double gap) {
        if (gap < least - kDeep) add(island, pair, a, b, dt, normal, p_W, gap - least);
    };
    const auto set_time = [&] {
        if (hits_.size() == known) return;
        const double time = time_of_sinking(a, b, dt, least).value_or(dt);
        for (std::size_t h = known; h < hits_.size(); ++h) hits_[h].time = time;
    };
    if (b.shape->kind == ShapeKind::kSurface) {
        collide_surface(*a.shape, a.at(dt), *b.shape->surface, b.X, 0, buffers_.there);
        for (const SurfaceContact& c : buffers_.there.points) see(c.n_W, c.p_W, c.gap);
        if (!buffers_.there.points.empty()) return set_time();
        const std::optional<double> t = time_of_sinking(a, b, dt, least);
        if (!t) return;
        collide_surface(*a.shape, a.at(*t), *b.shape->surface, b.X, kDeep, buffers_.there);
        for (const SurfaceContact& c : buffers_.there.points)
            add(island, pair, a, b, *t, c.n_W, c.p_W, c.gap - least);
        return;
    }
    const Manifold m = collide(*a.shape, a.at(dt), *b.shape, b.at(dt), 0);
    const bool is_behind = m.count > 0 && std::ranges::all_of(contacts, [&](const Contact* c) {
                               return dot(c->normal, m.n_W) < 0;
                           });
    const auto large = [&](int robot, const Vec3& w) {
        return robot >= 0 && is_large_turn(*island.robots[static_cast<std::size_t>(robot)].type, w, dt);
    };
    // Apart at the end, they may still have gone through each other.
    const bool is_apart = m.count == 0 && (large(pair.robot_a, turning_a) || large(pair.robot_b, turning_b));
    if ((is_behind || is_apart) && add_first_hit(island, pair, contacts.front()->normal, a, b)) return;
    for (int i = 0; i < m.count; ++i)
        see(m.n_W, m.points[static_cast<std::size_t>(i)].p_W, m.points[static_cast<std::size_t>(i)].gap);
    set_time();
}

/// False if there is nothing to look at.
bool SecondLook::start(const SolvedIsland& island) {
    const std::size_t count = island.robots.size();
    if (moved_.size() < count)
        moved_.resize(count), is_moved_.resize(count), turns_.resize(count), struck_.resize(count),
            drifts_.resize(count), large_turns_.resize(count);
    for (std::size_t m = 0; m < island.members.size(); ++m) {
        const std::uint32_t robot = island.members[m];
        drifts_[robot] = island.drifts[m], large_turns_[robot] = island.large_turns[m];
    }
    anchored_ = island.anchored || std::ranges::any_of(hits_, [&](const Contact& hit) {
                    return touches_fixed(island.robots, hit);
                });
    bool any = false;
    for (const std::uint32_t m : island.members) {
        const RobotType& type = *island.robots[m].type;
        const auto nv = static_cast<std::size_t>(type.nv);
        const auto displacement =
            island.displacement.subspan(static_cast<std::size_t>(island.offsets[m]), nv);
        is_moved_[m] = 0;
        turns_[m] = !island.passing_only && may_turn_far(type, displacement, island.model.dt_s);
        struck_[m] = island.members.size() > 1 && is_pushed(island, static_cast<int>(m)) &&
                     is_struck(island.robots[m], displacement, island.model.dt_s);
        any |= turns_[m] != 0 || struck_[m] != 0 || !misses_of(m, island.near_misses).empty();
    }
    return any;
}

bool SecondLook::find(const SolvedIsland& island, bool first) {
    if (first) hits_.clear(), turned_.clear();
    known_ = hits_.size(), first_ = first;
    if (!start(island)) return false;
    for (const std::uint32_t m : island.members)
        for (const NearMiss& pair : misses_of(m, island.near_misses)) find_missed(island, pair);
    for (const std::uint32_t m : island.members)
        if (struck_[m] != 0) find_struck(island, m);
    const auto turns = [&](int robot) { return robot >= 0 && turns_[static_cast<std::size_t>(robot)] != 0; };
    for (std::size_t c = 0; !island.passing_only && c < island.contacts.size();) {
        const Contact& contact = *island.contacts[c];
        std::size_t end = c + 1;
        while (end < island.contacts.size() && pair_of(*island.contacts[end]) == pair_of(contact)) ++end;
        if (!is_plane(island.model, contact) && (turns(contact.robot_a) || turns(contact.robot_b)))
            find_turned(island, island.contacts.subspan(c, end - c));
        c = end;
    }
    watch_hits();
    return hits_.size() > known_;
}

/// What was hit is looked at after the motion too.
void SecondLook::watch_hits() {
    for (std::size_t h = known_; h < hits_.size(); ++h) {
        const ShapePair pair = pair_of(hits_[h]);
        const auto is_known = [&](const Turned& turned) { return turned.pair == pair; };
        if (std::ranges::none_of(turned_, is_known)) turned_.push_back({pair, 0, hits_[h].normal});
    }
}

double SecondLook::first_time() const {
    double first = hits_[known_].time;
    for (std::size_t h = known_; h < hits_.size(); ++h) first = std::min(first, hits_[h].time);
    return first;
}

Transform SecondLook::placed(const RobotWork& robot, std::uint32_t shape) {
    forward_kinematics<double>(*robot.type, robot.state->q, placed_);
    const BodyShape& of_body = robot.type->shapes[shape];
    return body_frame(placed_, of_body.body) * of_body.X_BS;
}

/// True if something was moved. Of two robots that are free the lighter one gives way more.
bool SecondLook::push_out(std::span<RobotWork> robots, const Model& model, const Turned& turned) {
    const ShapePair& pair = turned.pair;
    RobotWork& a = robots[static_cast<std::size_t>(pair.robot_a)];
    const Shape& shape = a.type->shapes[pair.shape_a].shape;
    const Transform X = placed(a, pair.shape_a);
    Vec3 normal;
    double deepest = turned.least - kDeep;
    const auto see = [&](const Vec3& n, double gap) {
        if (gap < deepest) deepest = gap, normal = n;
    };
    RobotWork* b = pair.robot_b < 0 ? nullptr : &robots[static_cast<std::size_t>(pair.robot_b)];
    const Shape& other =
        b == nullptr ? model.statics[pair.shape_b].shape : b->type->shapes[pair.shape_b].shape;
    if (other.kind == ShapeKind::kSurface) {
        collide_surface(shape, X, *other.surface, model.statics[pair.shape_b].X_WS, 0, buffers_.there);
        for (const SurfaceContact& c : buffers_.there.points) see(c.n_W, c.gap);
    } else {
        const Transform X_other = b == nullptr ? model.statics[pair.shape_b].X_WS : placed(*b, pair.shape_b);
        const Manifold m = collide(shape, X, other, X_other, 0);
        see(m.n_W, least_gap(m));
    }
    const double inverse_mass_a = inverse_mass_of(a),
                 inverse_mass_b = b == nullptr || b == &a ? 0 : inverse_mass_of(*b);
    if (normal == Vec3{} || inverse_mass_a + inverse_mass_b == 0 || b == &a) return false;
    if (dot(normal, turned.normal) <= 0) return false;  // the way out of the other side
    const Vec3 push = normal * ((turned.least - deepest) / (inverse_mass_a + inverse_mass_b));
    if (inverse_mass_a == 0 || inverse_mass_b == 0) {
        shift_base(push * inverse_mass_a, *a.state);
        if (inverse_mass_b > 0) shift_base(push * -inverse_mass_b, *b->state);
    } else {
        move_apart(model, robots, pair, push * inverse_mass_a, push * -inverse_mass_b);
    }
    return true;
}

/// Moves two free robots and keeps their common angular momentum: it would change by move x momentum.
void SecondLook::move_apart(const Model& model, std::span<RobotWork> robots, const ShapePair& pair,
                            const Vec3& move_a, const Vec3& move_b) {
    const std::array both{static_cast<std::uint32_t>(pair.robot_a), static_cast<std::uint32_t>(pair.robot_b)};
    const Vec3 origin = robots[both[0]].origin;
    const Spatial before = sum_robots(model, robots, both, origin, placed_).momentum;
    shift_base(move_a, *robots[both[0]].state), shift_base(move_b, *robots[both[1]].state);
    const BodySums sums = sum_robots(model, robots, both, origin, placed_);
    const Spatial missing{before.angular - sums.momentum.angular, before.linear - sums.momentum.linear};
    add_momentum(robots, both, sums, missing, origin);
}

void SecondLook::push_out(std::span<RobotWork> robots, const Model& model) {
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
        bool any = false;
        for (const Turned& turned : turned_) any |= push_out(robots, model, turned);
        if (!any) return;
    }
}

void SecondLook::add_rows(const SolvedIsland& island, IslandRows& rows, std::vector<SurfacePair>& surfaces) {
    make_room(rows.contacts, rows.contacts.size() + hits_.size() - known_);
    make_room(surfaces, surfaces.size() + hits_.size() - known_);
    for (std::size_t h = known_; h < hits_.size(); ++h) {
        const Contact& c = hits_[h];
        const SurfacePair& surface = surfaces.emplace_back(surface_of(island.model, island.robots, c));
        add_contact_row(island.model, c, surface, island.robots, island.offsets, rows);
        ContactRow& row = rows.contacts.back();
        row.normal.target = row.normal.position_target =
            -c.gap / island.model.dt_s - dot(c.normal, surface.velocity);
        row.normal.compliance = row.inverse_effective_mass * new_compliance<double>(island.model.accuracy);
    }
}

}  // namespace roboss
