// Broad phase as in the paper (robot boxes, then shape boxes, static scenery through its BVH), then the
// narrow phase. Two robots meet here only if their interaction bounds overlap: that is what makes grouping
// into islands invisible.
#include "physics/contact/contact.h"

#include <algorithm>
#include <tuple>

#include "core/make_room.h"
#include "geometry/collide.h"
#include "physics/bonds/bond_keeper.h"
#include "physics/contact/pair_of.h"
#include "physics/contact/surface_motion.h"
#include "physics/contact/swept_contact.h"
#include "physics/contact/wheel_slip.h"
#include "physics/dynamics/free_course.h"

namespace roboss {

/// Who meets whom; of a Contact, what is known before it is found.
struct ContactFinder::Pair {
    int robot_a = 0, robot_b = -1;
    std::size_t shape_a = 0, shape_b = 0;
    int body_a = -1, body_b = -1;
};

namespace {

/// Drops all but the `keep` deepest points; of equal depth the first.
std::uint32_t points_to_keep(const Manifold& manifold, std::uint32_t keep) {
    const auto count = static_cast<std::uint32_t>(manifold.count);
    std::uint32_t kept = (std::uint32_t{1} << count) - 1;
    for (std::uint32_t left = count; left > keep; --left) {
        std::uint32_t shallowest = count;
        for (std::uint32_t i = 0; i < count; ++i) {
            if ((kept >> i & 1) == 0) continue;
            if (shallowest == count || manifold.points[i].gap >= manifold.points[shallowest].gap)
                shallowest = i;
        }
        kept &= ~(std::uint32_t{1} << shallowest);
    }
    return kept;
}

void add_point(const auto& pair, const Vec3& normal, const auto& point, std::vector<Contact>& contacts) {
    Contact& contact = contacts.emplace_back();
    contact.robot_a = pair.robot_a, contact.robot_b = pair.robot_b;
    contact.shape_a = static_cast<std::uint32_t>(pair.shape_a);
    contact.shape_b = static_cast<std::uint32_t>(pair.shape_b);
    contact.body_a = pair.body_a, contact.body_b = pair.body_b;
    contact.p_W = point.p_W, contact.gap = point.gap, contact.feature = point.feature;
    contact.normal = normal;
}

/// Points of a triangle surface, each with a normal of its own; all but the deepest are dropped.
void add_points(std::vector<SurfaceContact>& points, const auto& pair, std::size_t keep,
                std::vector<Contact>& contacts) {
    while (points.size() > keep) {
        const auto shallowest = std::max_element(points.rbegin(), points.rend(),
                                                 [](const auto& p, const auto& q) { return p.gap < q.gap; });
        points.erase(std::next(shallowest).base());
    }
    make_room(contacts, contacts.size() + points.size());
    for (const SurfaceContact& point : points) add_point(pair, point.n_W, point, contacts);
}

void add_points(const Manifold& manifold, const auto& pair, std::uint32_t keep,
                std::vector<Contact>& contacts) {
    if (manifold.count == 0) return;
    const std::uint32_t kept = points_to_keep(manifold, keep);
    make_room(contacts, contacts.size() + static_cast<std::size_t>(manifold.count));
    for (int i = 0; i < manifold.count; ++i)
        if ((kept >> i & 1) != 0)
            add_point(pair, manifold.n_W, manifold.points[static_cast<std::size_t>(i)], contacts);
}

std::uint32_t points_max(const Material& a, const Material& b) {
    return std::min(a.contacts_max, b.contacts_max);
}

/// By (other id, shapes, feature); mostly they come so.
void sort_contacts(std::span<const RobotWork> robots, std::span<Contact> contacts) {
    const auto before = [&](const Contact& x, const Contact& y) {
        return std::tuple(other_id(robots, x), x.shape_a, x.shape_b, x.feature) <
               std::tuple(other_id(robots, y), y.shape_a, y.shape_b, y.feature);
    };
    if (!std::ranges::is_sorted(contacts, before)) std::ranges::sort(contacts, before);
}

/// Axes in which the friction direction of a robot's shape is.
Mat3 friction_axes(const RobotWork& robot, std::uint32_t shape) {
    const int body = robot.type->shapes[shape].direction_body;
    return body < 0 ? shape_pose(robot, shape).R : robot.bodies[static_cast<std::size_t>(body)].X_WB.R;
}

/// Speed at which the surface of a body's shape may approach something, at most: a wheel that turns about its
/// axis moves no point of its rim outwards. m/s.
double outward_speed(const RobotWork& robot, std::size_t number, const Transform& X_WS) {
    const BodyShape& shape = robot.type->shapes[number];
    const Spatial& v = robot.bodies[static_cast<std::size_t>(shape.body)].velocity;
    return norm(v.linear + cross(v.angular, X_WS.p - robot.origin)) +
           turning_speed<double>(shape.shape, X_WS.R, v.angular);
}

/// Of the robot or one behind it.
std::size_t first_contact(std::size_t robot, std::span<const Contact> contacts) {
    const auto at = std::ranges::lower_bound(contacts, static_cast<int>(robot), {}, &Contact::robot_a);
    return static_cast<std::size_t>(at - contacts.begin());
}

/// Sorts them; of those of the same shapes one is kept, always the same.
void keep_one_of_each(std::vector<NearMiss>& misses) {
    std::ranges::sort(misses, [](const NearMiss& a, const NearMiss& b) {
        if (a != b) return a < b;
        const Vec3 &n = a.normal, &m = b.normal;
        return std::tuple(n.x, n.y, n.z) < std::tuple(m.x, m.y, m.z);
    });
    misses.erase(std::unique(misses.begin(), misses.end()), misses.end());
}

}  // namespace

ContactFinder::ContactFinder()
    : buffers_(std::make_unique<SweepBuffers>()), free_courses_(std::make_unique<FreeCourses>()) {}
ContactFinder::~ContactFinder() = default;
ContactFinder::ContactFinder(ContactFinder&&) noexcept = default;
ContactFinder& ContactFinder::operator=(ContactFinder&&) noexcept = default;

SurfacePair surface_of(const Model& model, std::span<const RobotWork> robots, const Contact& contact) {
    const RobotWork& a = robots[static_cast<std::size_t>(contact.robot_a)];
    const Material& of_a = a.type->shapes[contact.shape_a].material;
    const Mat3 R_WA = friction_axes(a, contact.shape_a);
    SurfacePair pair;
    if (contact.robot_b < 0) {
        const StaticShape& scenery = model.statics[contact.shape_b];
        pair = surface_pair(of_a, R_WA, scenery.material, scenery.X_WS.R, contact.normal, -contact.gap);
    } else {
        const RobotWork& b = robots[static_cast<std::size_t>(contact.robot_b)];
        pair = surface_pair(of_a, R_WA, b.type->shapes[contact.shape_b].material,
                            friction_axes(b, contact.shape_b), contact.normal, -contact.gap);
    }
    add_motion(model, robots, contact, pair);
    add_carrying(model, robots, contact, pair);
    add_slip(robots, contact, pair);
    return pair;
}

void ContactFinder::start(std::size_t robots, const BondKeeper* bonds, bool keep_reactions) {
    near_misses_.clear();
    bonds_ = bonds;
    free_courses_->start(robots, keep_reactions);
}

/// Contacts of the robots begin .. end-1 with those behind them; `pairs`: those whose first robot is not
/// before `begin`.
void ContactFinder::find_of(const Model& model, std::span<RobotWork> robots, std::span<const RobotPair> pairs,
                            std::size_t begin, std::size_t end, std::vector<Contact>& contacts) {
    auto pair = pairs.begin();
    for (std::size_t a = begin; a < end; ++a) {
        const std::size_t first = contacts.size();
        const bool awake = !robots[a].asleep;
        if (awake && !robots[a].type->self_pairs.empty()) with_itself(model, robots, a, contacts);
        for (; pair != pairs.end() && pair->first == a; ++pair)
            if (awake && !robots[pair->second].asleep)
                meet_robot(model, robots, a, pair->second, true, contacts);
        if (awake) with_statics(model, robots, a, contacts);
        sort_contacts(robots, std::span(contacts).subspan(first));
    }
}

/// Block by block; what each block has is put together in their order.
void ContactFinder::find_together(const Model& model, std::span<RobotWork> robots, bool keep_reactions,
                                  std::vector<Contact>& contacts, const Team& team) {
    constexpr std::size_t kBlock = 32;  // robots
    const std::size_t blocks = (robots.size() + kBlock - 1) / kBlock;
    while (helpers_.size() < team.size()) helpers_.emplace_back();
    if (blocks_.size() < blocks) blocks_.resize(blocks);
    for (ContactFinder& helper : helpers_) helper.start(robots.size(), bonds_, keep_reactions);
    team.run(blocks, [&](std::size_t block, std::size_t worker) {
        const std::size_t begin = block * kBlock, end = std::min(begin + kBlock, robots.size());
        const auto first = std::ranges::lower_bound(pairs_, begin, {}, &RobotPair::first);
        blocks_[block].clear();
        helpers_[worker].find_of(model, robots, {first, pairs_.end()}, begin, end, blocks_[block]);
    });
    places_.assign(1, 0);
    for (std::size_t block = 0; block < blocks; ++block)
        places_.push_back(places_.back() + static_cast<std::uint32_t>(blocks_[block].size()));
    make_room(contacts, places_.back());
    contacts.resize(places_.back());
    team.run(blocks, [&](std::size_t block, std::size_t) {
        std::ranges::copy(blocks_[block], contacts.begin() + places_[block]);
    });
    for (const ContactFinder& helper : helpers_)
        near_misses_.insert(near_misses_.end(), helper.near_misses_.begin(), helper.near_misses_.end());
}

void ContactFinder::find(const Model& model, std::span<RobotWork> robots, const BondKeeper* bonds,
                         bool keep_reactions, std::vector<Contact>& contacts, const Team& team) {
    start(robots.size(), bonds, keep_reactions);
    if (team.size() > 1) {
        find_together(model, robots, keep_reactions, contacts, team);
    } else {
        contacts.clear();
        find_of(model, robots, pairs_, 0, robots.size(), contacts);
    }
    bonds_ = nullptr;
    defer_later(model, robots, contacts);
    keep_one_of_each(near_misses_);
    for (const Contact& c : contacts) {
        RobotWork& a = robots[static_cast<std::size_t>(c.robot_a)];
        ++a.contacts;
        if (c.robot_b < 0) continue;
        robots[static_cast<std::size_t>(c.robot_b)].contacts += c.robot_b == c.robot_a ? 0 : 1;
        a.touches_robot = robots[static_cast<std::size_t>(c.robot_b)].touches_robot = true;
    }
}

void ContactFinder::with_statics(const Model& model, std::span<RobotWork> robots, std::size_t a,
                                 std::vector<Contact>& contacts) {
    const RobotWork& work = robots[a];
    if (work.shapes.empty()) return;
    own_.start(work, model.dt_s);
    const bool may_be_bonded = bonds_ != nullptr && work.bonded;
    for (const auto& [s, i] : search_.with_scenery(model, work))
        if (!may_be_bonded || !bonds_->joins(static_cast<int>(a), work.type->shapes[s].body, -1, -1))
            with_static(model, robots, a, s, i, contacts);
}

void ContactFinder::with_static(const Model& model, std::span<const RobotWork> robots, std::size_t a,
                                std::size_t s, std::size_t i, std::vector<Contact>& contacts) {
    const BodyShape& shape = robots[a].type->shapes[s];
    const StaticShape& scenery = model.statics[i];
    if (!may_collide(shape.material, scenery.material)) return;
    const Pair pair{static_cast<int>(a), -1, s, i, shape.body, -1};
    const std::uint32_t keep = points_max(shape.material, scenery.material);
    if (scenery.shape.kind == ShapeKind::kSurface) return with_surface(model, robots, pair, keep, contacts);
    const ShapeWork& placed = own_[s];
    Manifold manifold = collide_near(shape.shape, placed.X_WS, scenery.shape, scenery.X_WS, placed.margin);
    if (scenery.shape.kind != ShapeKind::kPlane && may_pass(manifold, placed.margin - kBaseMargin))
        return add_judged(pair, course(model, robots, pair.robot_a, s),
                          resting_course(scenery.shape, scenery.X_WS), model.dt_s,
                          placed.margin + kBaseMargin, keep, manifold, contacts);
    add_points(manifold, pair, keep, contacts);
}

Course ContactFinder::course(const Model& model, std::span<const RobotWork> robots, int robot,
                             std::size_t shape) {
    const auto number = static_cast<std::size_t>(robot);
    return known_course(model, robots[number], number, shape, *free_courses_);
}

void ContactFinder::with_surface(const Model& model, std::span<const RobotWork> robots, const Pair& pair,
                                 std::uint32_t keep, std::vector<Contact>& contacts) {
    const RobotWork& robot = robots[static_cast<std::size_t>(pair.robot_a)];
    const StaticShape& scenery = model.statics[pair.shape_b];
    const TriangleSurface& surface = *scenery.shape.surface;
    const ShapeWork& placed = own_[pair.shape_a];
    const double margin = placed.margin, displacement = margin - kBaseMargin;
    SweepBuffers& b = *buffers_;
    collide_surface(robot.type->shapes[pair.shape_a].shape, placed.X_WS, surface, scenery.X_WS, margin,
                    b.found);
    const auto none_passes = [&](double by) {
        return by <= kFastDisplacement && std::ranges::none_of(b.found.points, [&](const SurfaceContact& c) {
                   return may_pass(c.gap, by);
               });
    };
    if (none_passes(displacement) ||
        none_passes(model.dt_s * outward_speed(robot, pair.shape_a, placed.X_WS)))
        return add_points(b.found.points, pair, keep, contacts);
    const Course moving = course(model, robots, pair.robot_a, pair.shape_a), still{};
    const SweptPair judged = sweep(moving, surface, scenery.X_WS, model.dt_s, margin, b);
    if (judged.meeting == Meeting::kNone) miss(pair, {});
    const std::size_t first = contacts.size();
    add_points(b.found.points, pair, keep, contacts);
    const std::size_t middle = contacts.size();
    if (judged.meeting != Meeting::kInTick) return;
    add_points(b.met, pair, keep, contacts);
    for (std::size_t c = middle; c < contacts.size(); ++c) {
        const auto is_taken = [&](const Contact& other) { return other.feature == contacts[c].feature; };
        const std::span<const Contact> before = std::span(contacts).subspan(first, c - first);
        while (std::ranges::any_of(before, is_taken)) ++contacts[c].feature;
        take_back(moving, still, judged.time, contacts[c]);
    }
}

void ContactFinder::miss(const Pair& pair, const Vec3& normal) {
    near_misses_.push_back({{pair.robot_a, pair.robot_b, static_cast<std::uint32_t>(pair.shape_a),
                             static_cast<std::uint32_t>(pair.shape_b)},
                            normal});
}

void ContactFinder::add_judged(const Pair& pair, const Course& a, const Course& b, double dt, double margin,
                               std::uint32_t keep, Manifold& manifold, std::vector<Contact>& contacts) {
    const SweptPair judged = sweep(a, b, dt, margin, manifold);
    if (judged.meeting == Meeting::kNone) return miss(pair, manifold.n_W);
    const std::size_t first = contacts.size();
    add_points(manifold, pair, keep, contacts);
    if (judged.meeting == Meeting::kInTick)
        for (Contact& contact : std::span(contacts).subspan(first)) take_back(a, b, judged.time, contact);
}

/// What a robot meets well after its first impact in the tick it may not meet at all.
void ContactFinder::defer_later(const Model& model, std::span<const RobotWork> robots,
                                std::vector<Contact>& contacts) {
    constexpr double kTogether = 0.1;  // of the tick
    const double dt = model.dt_s;
    if (std::ranges::none_of(contacts, [](const Contact& c) { return c.time > 0; })) return;
    first_hits_.assign(robots.size(), dt);
    const auto first_hit = [&](const Contact& c) {
        const double a = first_hits_[static_cast<std::size_t>(c.robot_a)];
        return c.robot_b < 0 ? a : std::min(a, first_hits_[static_cast<std::size_t>(c.robot_b)]);
    };
    for (const Contact& c : contacts) {
        if (c.time == 0 && !is_blow(robots, c, dt)) continue;
        for (const int robot : {c.robot_a, c.robot_b}) {
            if (robot < 0) continue;
            double& first = first_hits_[static_cast<std::size_t>(robot)];
            first = std::min(first, c.time);
        }
    }
    const auto is_later = [&](const Contact& c) { return c.time > first_hit(c) + kTogether * dt; };
    for (const Contact& c : contacts)
        if (is_later(c)) near_misses_.push_back({{c.robot_a, c.robot_b, c.shape_a, c.shape_b}, c.normal});
    std::erase_if(contacts, is_later);
}

void ContactFinder::collide_shapes(const Model& model, std::span<const RobotWork> robots, Pair pair,
                                   PlacedShapes& shapes_b, bool sweeps, std::vector<Contact>& contacts) {
    const RobotWork& ra = robots[static_cast<std::size_t>(pair.robot_a)];
    const RobotWork& rb = robots[static_cast<std::size_t>(pair.robot_b)];
    const BodyShape &a = ra.type->shapes[pair.shape_a], &b = rb.type->shapes[pair.shape_b];
    const ShapeWork &wa = own_[pair.shape_a], &wb = shapes_b[pair.shape_b];
    if (!overlaps(wa.box, wb.box) || !may_collide(a.material, b.material)) return;
    pair.body_a = a.body, pair.body_b = b.body;
    const double margin = wa.margin + wb.margin;
    const std::uint32_t keep = points_max(a.material, b.material);
    Manifold manifold = collide_near(a.shape, wa.X_WS, b.shape, wb.X_WS, margin);
    const bool has_plane = a.shape.kind == ShapeKind::kPlane || b.shape.kind == ShapeKind::kPlane;
    if (sweeps && !has_plane && may_pass(manifold, margin - 2 * kBaseMargin))
        return add_judged(pair, course(model, robots, pair.robot_a, pair.shape_a),
                          course(model, robots, pair.robot_b, pair.shape_b), model.dt_s, margin, keep,
                          manifold, contacts);
    add_points(manifold, pair, keep, contacts);
}

void ContactFinder::with_itself(const Model& model, std::span<const RobotWork> robots, std::size_t a,
                                std::vector<Contact>& contacts) {
    const auto robot = static_cast<int>(a);
    own_.start(robots[a], model.dt_s);
    for (const auto& [s, t] : search_.within(robots[a]))
        collide_shapes(model, robots, {robot, robot, s, t}, own_, true, contacts);
}

void ContactFinder::with_robot(const Model& model, std::span<const RobotWork> robots, std::size_t a,
                               std::size_t b, std::vector<Contact>& contacts) {
    meet_robot(model, robots, a, b, false, contacts);
}

void ContactFinder::meet_robot(const Model& model, std::span<const RobotWork> robots, std::size_t a,
                               std::size_t b, bool sweeps, std::vector<Contact>& contacts) {
    const RobotWork& wa = robots[a];
    const RobotWork& wb = robots[b];
    if (model.robots[wa.id.index()].family == model.robots[wb.id.index()].family && !wa.type->self_collide)
        return;
    const bool may_be_bonded = bonds_ != nullptr && wa.bonded && wb.bonded;
    own_.start(wa, model.dt_s), other_.start(wb, model.dt_s);
    for (const auto& [s, t] : search_.between(wa, wb)) {
        const int body_a = wa.type->shapes[s].body, body_b = wb.type->shapes[t].body;
        if (body_a < 0 && body_b < 0) continue;  // neither can move
        if (may_be_bonded && bonds_->joins(static_cast<int>(a), body_a, static_cast<int>(b), body_b))
            continue;
        collide_shapes(model, robots, {static_cast<int>(a), static_cast<int>(b), s, t}, other_, sweeps,
                       contacts);
    }
}

/// Pairs (a, b), a < b, whose boxes overlap, sorted.
void ContactFinder::find_pairs(std::span<const RobotWork> robots) {
    constexpr std::size_t kFew = 12;  // awake among sleepers: each against all is quicker than sorting
    pairs_.clear();
    awake_.clear();
    for (std::uint32_t i = 0; i < robots.size(); ++i)
        if (!robots[i].asleep) awake_.push_back(i);
    if (awake_.empty() || robots.size() < 2) return;
    if (awake_.size() <= kFew) {
        for (const std::uint32_t i : awake_)
            for (std::uint32_t j = 0; j < robots.size(); ++j)
                if ((robots[j].asleep || j > i) && overlaps(robots[i].box, robots[j].box))
                    pairs_.push_back(std::minmax(i, j));
    } else {
        find_pairs_by_strips(robots);
    }
    sort_pairs(robots.size());
}

void ContactFinder::find_pairs_by_strips(std::span<const RobotWork> robots) {
    boxes_.clear();
    for (const RobotWork& robot : robots) boxes_.push_back(robot.box);
    strips_.for_each_overlap(boxes_, [&](std::uint32_t i, std::uint32_t j) {
        if (!(robots[i].asleep && robots[j].asleep)) pairs_.push_back(std::minmax(i, j));
    });
}

/// By their first robot, which takes no comparison, then those of each by the second.
void ContactFinder::sort_pairs(std::size_t robots) {
    places_.assign(robots + 1, 0);
    for (const RobotPair& pair : pairs_) ++places_[pair.first + 1];
    for (std::size_t i = 0; i < robots; ++i) places_[i + 1] += places_[i];
    sorted_.resize(pairs_.size());
    for (const RobotPair& pair : pairs_) sorted_[places_[pair.first]++] = pair;
    pairs_.swap(sorted_);
    std::size_t first = 0;
    for (std::size_t i = 0; i < robots; ++i) {
        std::sort(pairs_.begin() + static_cast<std::ptrdiff_t>(first),
                  pairs_.begin() + static_cast<std::ptrdiff_t>(places_[i]));
        first = places_[i];
    }
}

void recall_impulses(std::span<RobotWork> robots, std::size_t first, std::size_t last,
                     std::span<Contact> contacts) {
    std::size_t c = first_contact(first, contacts);
    for (std::size_t a = first; a < last; ++a) {
        const std::vector<ContactMemory>& memory = robots[a].state->contacts;
        auto m = memory.begin();
        for (; c < contacts.size() && contacts[c].robot_a == static_cast<int>(a); ++c) {
            Contact& contact = contacts[c];
            const auto key =
                std::tuple(other_id(robots, contact), contact.shape_a, contact.shape_b, contact.feature);
            const auto key_of = [](const ContactMemory& x) {
                return std::tuple(x.other_robot, x.shape, x.other_shape, x.feature);
            };
            while (m != memory.end() && key_of(*m) < key) ++m;
            const bool known = m != memory.end() && key_of(*m) == key;
            contact.impulse = known ? m->impulse : 0.0;
            contact.load = known ? m->load : 0.0;
            contact.friction = known ? m->friction : Vec3{};
        }
    }
}

void remember_impulses(std::span<RobotWork> robots, std::size_t first, std::size_t last,
                       std::span<const Contact> contacts) {
    for (const RobotWork& work : robots.subspan(first, last - first))
        if (!work.asleep) work.state->contacts.clear();
    for (std::size_t i = first_contact(first, contacts), end = first_contact(last, contacts); i < end; ++i) {
        const Contact& c = contacts[i];
        if (c.impulse <= 0) continue;
        robots[static_cast<std::size_t>(c.robot_a)].state->contacts.push_back(
            {other_id(robots, c), c.shape_a, c.shape_b, c.feature, c.impulse, c.load, c.friction});
    }
}

}  // namespace roboss
