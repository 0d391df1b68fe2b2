// Ghost contacts: what passes is not pushed, what hits is felt. Random shots of one body past or at another,
// against the distance along the free motion, which is found here by undirected steps, another way than that
// of the code under test.
#include <gtest/gtest.h>

#include <functional>

#include <support/meshes.h>
#include <support/simulation.h>

#include "geometry/collide.h"

namespace roboss::test {
namespace {

constexpr double kTick = 2e-3;   // s
constexpr double kFlight = 1.2;  // m: from one side to the other
constexpr double kSpacing = 50;  // m between the shots of one world
constexpr double kClear = 1e-4;  // m: what is clear by more must not be pushed
constexpr double kHit = 2e-3;    // m: what would sink in deeper must be
constexpr int kShots = 32;

struct Body {
    std::string name;
    std::function<CollisionSpec(const SurfaceSpec&)> shape;
    double size = 0;  // m
};

CollisionSpec capsule(double radius, double length, const SurfaceSpec& s) {
    CollisionSpec c = collision(GeometryKind::kCapsule, s);
    c.geometry.radius = radius, c.geometry.length = length;
    return c;
}

CollisionSpec ellipsoid(const Vec3& radii, const SurfaceSpec& s) {
    CollisionSpec c = collision(GeometryKind::kEllipsoid, s);
    c.geometry.size = radii;
    return c;
}

const Body kBall{"ball", [](const SurfaceSpec& s) { return sphere_shape(0.02, s); }, 0.02};
const Body kCube{"cube", [](const SurfaceSpec& s) { return box_shape({0.06, 0.06, 0.06}, s); }, 0.05};
const Body kBlock{"block", [](const SurfaceSpec& s) { return box_shape({0.2, 0.1, 0.05}, s); }, 0.11};
const Body kRod{"rod", [](const SurfaceSpec& s) { return cylinder_shape(0.0025, 0.3, s); }, 0.15};
const Body kCan{"can", [](const SurfaceSpec& s) { return cylinder_shape(0.04, 0.1, s); }, 0.06};
const Body kPill{"pill", [](const SurfaceSpec& s) { return capsule(0.02, 0.1, s); }, 0.07};
const Body kEgg{"egg", [](const SurfaceSpec& s) { return ellipsoid({0.02, 0.03, 0.05}, s); }, 0.05};
const Body kHull{"hull", [](const SurfaceSpec& s) { return mesh_shape(ball_mesh(0.03, 1), s); }, 0.03};

ModelSpec body_of(const Body& body, bool is_static, double mu) {
    LinkSpec l =
        link("body", 0.1, sphere_inertia(0.1, 0.05));  // round, so that it spins as it was set spinning
    l.collisions.push_back(body.shape(surface(mu)));
    ModelSpec m = one_link(l);
    m.is_static = is_static;
    return m;
}

/// A world of shots: body 2k flies at target 2k + 1, or at scenery k, far from the other shots.
struct Range {
    Body body, target;
    bool is_static = false, is_mesh = false, swapped = false;
    double speed = 0, spin = 0;
    std::uint64_t seed = 0;
    double mu = 0.5;
};

Vec3 direction(Random& random) {
    return rotate(random.rotation(), {1, 0, 0});
}

class Shooting {
  public:
    explicit Shooting(const Range& range) : range_(range), world_(empty_world(kTick, {})) {
        Random random(range.seed);
        for (int k = 0; k < kShots; ++k) add(k, random);
        sim_ = std::make_unique<Simulation>(world_);
        for (std::size_t k = 0; k < kShots; ++k) {
            body(k).v = velocities_[2 * k];
            if (!range.is_static) target(k).v = velocities_[2 * k + 1];
        }
        start_ = sim_->states;
    }

    void fly() {
        const auto ticks = static_cast<int>(kFlight / range_.speed / kTick) + 1;
        for (int i = 0; i < ticks; ++i) sim_->step();
        time_ = ticks * kTick;
    }

    RobotState& body(std::size_t k) { return sim_->states[index(k, false)]; }
    RobotState& target(std::size_t k) { return sim_->states[index(k, true)]; }
    const RobotState& start_of_body(std::size_t k) const { return start_[index(k, false)]; }

    double change(std::size_t k) {
        const RobotState& before = start_of_body(k);
        double change = 0;
        for (std::size_t i = 3; i < 6; ++i) change = std::fmax(change, std::fabs(body(k).v[i] - before.v[i]));
        return change;
    }

    /// The least distance along the free motion.
    double least_gap(std::size_t k) {
        const Shape& a = sim_->type(index(k, false)).shapes[0].shape;
        const double rate = range_.speed + range_.spin * 1.8 * (range_.body.size + range_.target.size);
        double least = 1e9;
        for (double t = 0; t <= time_;) {
            const Manifold m = collide(a, pose(k, false, t), target_shape(k), pose(k, true, t), 2.0);
            double gap = 2.0;
            for (int i = 0; i < m.count; ++i) gap = std::fmin(gap, m.points[static_cast<std::size_t>(i)].gap);
            least = std::fmin(least, gap);
            if (least < -kHit) break;
            t += std::fmax(0.99 * gap, 2e-5) / rate;
        }
        return least;
    }

  private:
    std::size_t index(std::size_t k, bool target) const {
        if (range_.is_static) return k;
        return 2 * k + (target != range_.swapped ? 1 : 0);
    }

    const Shape& target_shape(std::size_t k) const {
        if (range_.is_mesh) return truth_;
        if (range_.is_static) return sim_->model->statics[k].shape;
        return sim_->type(index(k, true)).shapes[0].shape;
    }

    Transform pose(std::size_t k, bool target, double t) const {
        if (target && range_.is_static) return sim_->model->statics[k].X_WS;
        const RobotState& s = start_[index(k, target)];
        const Quat q = exponential(Vec3{s.v[0], s.v[1], s.v[2]} * t) * Quat{s.q[3], s.q[4], s.q[5], s.q[6]};
        return {to_matrix(q), Vec3{s.q[0], s.q[1], s.q[2]} + Vec3{s.v[3], s.v[4], s.v[5]} * t};
    }

    void add(int k, Random& random) {
        const Vec3 centre{kSpacing * k, 0, 0}, along = direction(random);
        Vec3 t1, t2;
        tangents(along, t1, t2);
        const double aside = range_.body.size + range_.target.size;
        const Vec3 offset = t1 * random.uniform(-aside, aside) + t2 * random.uniform(-aside, aside);
        const double share = range_.is_static ? 1 : random.uniform(0.2, 0.8);  // of the speed
        const Vec3 v = along * range_.speed;
        const double displacement = 0.5 * kFlight;
        const auto put = [&](const Body& body, const Vec3& p, const Vec3& velocity, bool is_static) {
            ModelSpec model = body_of(body, is_static, range_.mu);
            if (is_static && range_.is_mesh) {
                truth_.kind = ShapeKind::kBox;
                truth_.half = body.shape(surface(0)).geometry.size * 0.5;
                model.links[0].collisions[0] = mesh_shape(box_mesh(truth_.half * 2), surface(0.5));
            }
            place(world_, model, body.name + std::to_string(world_.instances.size()), {p, random.rotation()});
            const Vec3 w = random.vector(range_.spin);
            velocities_.push_back({w.x, w.y, w.z, velocity.x, velocity.y, velocity.z});
        };
        const auto put_body = [&] {
            put(range_.body, centre + offset - along * (displacement * share), v * share, false);
        };
        const auto put_target = [&] {
            put(range_.target, centre + along * (displacement * (1 - share)), v * (share - 1),
                range_.is_static);
        };
        put_body();
        put_target();
        if (!range_.swapped) return;
        std::swap(world_.instances[world_.instances.size() - 1],
                  world_.instances[world_.instances.size() - 2]);
    }

    Range range_;
    World world_;
    std::vector<std::vector<double>> velocities_;
    Shape truth_;
    std::unique_ptr<Simulation> sim_;
    std::vector<RobotState> start_;
    double time_ = 0;
};

struct Count {
    int shots = 0, clear = 0, ghosts = 0, hits = 0, missed = 0;
};

void count(const Range& range, Count& sum) {
    Shooting shooting(range);
    shooting.fly();
    for (std::size_t k = 0; k < kShots; ++k) {
        const double gap = shooting.least_gap(k), change = shooting.change(k);
        const std::string where = range.body.name + " at " + range.target.name + ", " +
                                  std::to_string(range.speed) + " m/s, seed " + std::to_string(range.seed) +
                                  ", shot " + std::to_string(k) + ", gap " + std::to_string(gap);
        ++sum.shots;
        if (gap > kClear) {
            ++sum.clear;
            if (change != 0) ++sum.ghosts, ADD_FAILURE() << where << ": pushed by " << change << " m/s";
        } else if (gap < -kHit) {
            ++sum.hits;
            if (change == 0) ++sum.missed, ADD_FAILURE() << where << ": not felt";
        }
    }
}

constexpr double kSpeeds[] = {2, 5, 20, 100, 1000};

void tell(const std::string& what, const Count& sum) {
    std::printf("    measured: %s: %d shots, %d clear, %d hits, %d ghosts, %d not felt\n", what.c_str(),
                sum.shots, sum.clear, sum.hits, sum.ghosts, sum.missed);
}

TEST(SweptContact, WhatPassesSceneryIsNotPushedAndWhatHitsItIsFelt) {
    const std::pair<Body, Body> pairs[] = {{kBall, kCube},  {kCube, kCube}, {kRod, kCan},    {kBlock, kRod},
                                           {kPill, kBlock}, {kEgg, kBlock}, {kHull, kBlock}, {kCan, kPill}};
    Count sum;
    std::uint64_t seed = 1;
    for (const auto& [body, target] : pairs)
        for (const double speed : kSpeeds) count({body, target, true, false, false, speed, 20, seed++}, sum);
    tell("scenery", sum);
}

TEST(SweptContact, RobotsThatPassEachOtherAreNotPushedAndThoseThatHitAre) {
    const std::pair<Body, Body> pairs[] = {{kBall, kBall},  {kCube, kBlock}, {kRod, kRod},   {kHull, kHull},
                                           {kPill, kBlock}, {kEgg, kCan},    {kBall, kBlock}};
    Count sum;
    std::uint64_t seed = 101;
    for (const auto& [body, target] : pairs)
        for (const double speed : kSpeeds) count({body, target, false, false, false, speed, 20, seed++}, sum);
    tell("robots", sum);
}

TEST(SweptContact, WhatPassesAMeshIsNotPushedAndWhatHitsItIsFelt) {
    const std::pair<Body, Body> pairs[] = {{kBall, kCube}, {kCube, kCube}, {kRod, kBlock}, {kHull, kBlock}};
    Count sum;
    std::uint64_t seed = 201;
    for (const auto& [body, target] : pairs)
        for (const double speed : kSpeeds) count({body, target, true, true, false, speed, 20, seed++}, sum);
    tell("meshes", sum);
}

TEST(SweptContact, SwappingTheTwoRobotsMirrorsTheResult) {
    for (const double speed : kSpeeds)
        for (const auto& [body, target] : {std::pair{kBall, kBall}, {kCube, kBlock}, {kPill, kHull}}) {
            const auto seed = static_cast<std::uint64_t>(speed);
            Shooting straight({body, target, false, false, false, speed, 20, seed, 0});
            Shooting swapped({body, target, false, false, true, speed, 20, seed, 0});
            for (std::size_t k = 0; k < kShots; ++k) {  // the velocities belong to the bodies
                swapped.body(k) = straight.body(k), swapped.target(k) = straight.target(k);
            }
            straight.fly(), swapped.fly();
            for (std::size_t k = 0; k < kShots; ++k)
                for (std::size_t i = 0; i < 6; ++i)
                    EXPECT_NEAR(straight.body(k).v[i], swapped.body(k).v[i], 1e-5 * (speed + 20))
                        << body.name << " at " << target.name << ", seed " << seed << ", shot " << k;
        }
}

}  // namespace
}  // namespace roboss::test
