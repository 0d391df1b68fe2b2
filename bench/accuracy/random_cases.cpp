// Random worlds that nobody tuned an engine to (tests/fuzz): mechanisms that must not gain energy, shots that
// must not be pushed where they pass, nor pass where something is in the way. Figures are counts.
#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <limits>

#include <support/bodies.h>

#include "accuracy/trial.h"
#include "fuzz/shot.h"
#include "fuzz/swept.h"

namespace roboss::bench {
namespace {

constexpr std::uint64_t kWorlds = 60;
constexpr double kLost = std::numeric_limits<double>::infinity();  // the state is none any more

/// A tree of one to five links with hinges, slides and ball joints: limits, damping, joint friction; nothing
/// touches.
World passive_tree(std::uint64_t seed, double dt_s) {
    fuzz::Random random(seed);
    fuzz::MechanismOptions options;
    options.kinds = {JointSpecKind::kRevolute, JointSpecKind::kPrismatic, JointSpecKind::kBall};
    options.stores = false;
    World world = test::empty_world(dt_s, {});
    test::place(world, fuzz::random_tree(random, options), "tree");
    return world;
}

/// Base and joints at up to `spin` about each axis; ball joints at rest, for peers take no start of theirs.
void spin_up(Engine& engine, const World& world, double spin, std::uint64_t seed) {
    constexpr double kSlidePerTurn = 0.1;  // m/s of a slide for each rad/s of a hinge
    fuzz::Random random(seed + 1000);
    engine.set_base(0, {}, random.vector(spin), random.vector(1));
    const std::vector<JointSpec>& joints = world.prototypes[0].joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const double most = joints[j].kind == JointSpecKind::kPrismatic ? kSlidePerTurn * spin : spin;
        if (joints[j].kind != JointSpecKind::kBall)
            engine.set_joint({0, j, 0}, {0, random.uniform(-most, most)});
    }
}

/// False: the engine gave up.
template <class Run>
bool survives(Run&& run) {
    try {
        run();
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

/// Largest growth of the energy above its lowest value before; infinite if it is none any more.
double growth_of(Trial& trial) {
    constexpr double kSeconds = 5, kAtRest = 1e-6;  // of the energy at the start
    const double start = trial.energy();
    double lowest = start, growth = 0;
    const bool whole = survives([&] {
        trial.run(kSeconds, trial.dt_s(), [&] {
            const double energy = trial.energy();
            const double now = energy / std::fmax(lowest, kAtRest * start) - 1;
            growth = std::isfinite(now) ? std::fmax(growth, now) : kLost;
            lowest = std::fmin(lowest, energy);
        });
    });
    return whole ? growth : kLost;
}

std::string expressed(std::uint64_t count) {
    return count == kWorlds ? "" : fmt::format("{} of {} worlds expressed", count, kWorlds);
}

Outcome spin_trees(const Contender& contender) {
    double grew = 0, fourfold = 0, lost = 0;
    std::uint64_t count = 0;
    for (std::uint64_t seed = 0; seed < kWorlds; ++seed) {
        Trial trial(contender, passive_tree(seed, contender.dt_s), true);
        if (!trial.possible()) continue;
        ++count;
        spin_up(trial.engine(), trial.world(), 30, seed);
        trial.begin();
        const double growth = growth_of(trial);
        grew += growth > 1e-3, fourfold += growth > 3, lost += std::isinf(growth);
    }
    if (count == 0) return Trial::impossible(3);
    Outcome out{{grew, fourfold, lost}};
    out.remark = expressed(count);
    return out;
}

/// Kinds, spins and speeds by turns.
fuzz::Setting setting_of(std::uint64_t seed, const std::vector<std::string>& kinds, double dt_s) {
    constexpr double kSpeeds[] = {5, 20, 100};
    return {seed, kinds[seed % kinds.size()], dt_s, seed % 2 == 0 ? 0.0 : 20.0,
            kSpeeds[seed / kinds.size() % 3]};
}

/// Starts as the shot's own states say: robots follow the instances that are not static.
void launch(Engine& engine, const World& world, const std::vector<RobotState>& states) {
    std::size_t robot = 0;
    for (std::size_t i = 0; i < world.instances.size(); ++i) {
        if (world.prototypes[world.instances[i].prototype].is_static) continue;
        const std::vector<double>& v = states[robot++].v;
        engine.set_base(i, world.instances[i].X_WM, {v[0], v[1], v[2]}, {v[3], v[4], v[5]});
    }
}

/// Largest change of a velocity of a centre, m/s; nothing else can change it.
double pushed(const Trial& trial, const std::vector<RobotState>& states) {
    double most = 0;
    std::size_t robot = 0;
    for (std::size_t i = 0; i < trial.world().instances.size(); ++i) {
        if (trial.world().prototypes[trial.world().instances[i].prototype].is_static) continue;
        const std::vector<double>& v = states[robot++].v;
        const double change = norm(trial.link(i).v_WC - Vec3{v[3], v[4], v[5]});
        most = std::isfinite(change) ? std::fmax(most, change) : kLost;
    }
    return most;
}

Outcome shoot_past(const Contender& contender) {
    constexpr std::uint64_t kShots = 600;
    constexpr double kClear = 1e-3, kPushed = 1e-6;  // m; of the speed
    double ghosts = 0, clear = 0;
    for (std::uint64_t seed = 0; seed < kShots; ++seed) {
        const fuzz::Setting setting =
            setting_of(seed, {"ball-box", "box-box", "rod-cylinder", "balls", "boxes"}, contender.dt_s);
        const fuzz::Shot shot = fuzz::make_shot(setting);
        const auto way = fuzz::unhindered_flight(setting);
        const auto model = fuzz::compile_scene(shot.world);
        fuzz::SweptDistance swept(*model, shot.stand_ins);
        for (const auto& states : way) swept.add(states);
        if (swept.least_gap(kClear, 1e-4) < kClear) continue;
        Trial trial(contender, shot.world, true);
        if (!trial.possible()) return Trial::impossible(2);
        ++clear;
        launch(trial.engine(), trial.world(), way.front());
        trial.begin();
        const bool whole = survives([&] { trial.run(shot.flight_s); });
        ghosts += !whole || pushed(trial, way.front()) > kPushed * setting.speed;
    }
    return {{ghosts, clear}};
}

Outcome shoot_at_walls(const Contender& contender) {
    constexpr std::uint64_t kShots = 300;
    double through = 0, shots = 0;
    for (std::uint64_t seed = 0; seed < kShots; ++seed) {
        const fuzz::Setting setting = setting_of(seed, {"wall-box"}, contender.dt_s);
        const fuzz::Shot shot = fuzz::make_shot(setting);
        Trial trial(contender, shot.world, true);
        if (!trial.possible()) continue;  // hulls
        ++shots;
        launch(trial.engine(), trial.world(), fuzz::unhindered_flight(setting).front());
        trial.begin();
        const bool whole = survives([&] { trial.run(shot.flight_s); });
        const Vec3 at = trial.centre(1);
        const bool beside = std::fmax(std::fabs(at.y), std::fabs(at.z)) > shot.wall->half_extent;
        through += !whole || !is_finite(at) || (at.x > 0 && !beside);
    }
    if (shots == 0) return Trial::impossible(2);
    return {{through, shots}};
}

Case trees_case(double dt_s) {
    Case c{fmt::format("trees-{:g}ms", dt_s * 1e3),
           fmt::format(
               "60 random passive trees of 1 to 5 links, spun at up to 30 rad/s, no gravity, 5 s, dt {:g} ms",
               dt_s * 1e3),
           "no motor, nothing touches: energy falls or stays",
           {{"trees whose energy grows by more than 1e-3", "", 0},
            {"trees whose energy grows more than fourfold", "", 0},
            {"trees that become infinite", "", 0}},
           spin_trees};
    c.dt_s = dt_s, c.slow = true;
    return c;
}

}  // namespace

std::vector<Case> random_cases() {
    Case past{"shots-past",
              "600 random shots past something at 5, 20 and 100 m/s, dt 2 ms",
              "who stays clear by more than a millimetre (swept distance, by bisection) keeps its velocity",
              {{"shots that were pushed though clear", "", 0}, {"shots that were clear", ""}},
              shoot_past};
    Case walls{"shots-at-walls",
               "300 random shots of small solids at a wall of 1 cm, 5, 20 and 100 m/s, dt 2 ms",
               "nothing comes out behind it",
               {{"shots that came out behind the wall", "", 0}, {"shots that the engine can express", ""}},
               shoot_at_walls};
    for (Case* c : {&past, &walls}) c->dt_s = 2e-3, c->slow = true;
    return {trees_case(4e-3), trees_case(2e-3), trees_case(1e-3), past, walls};
}

}  // namespace roboss::bench
