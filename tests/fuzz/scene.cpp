#include "fuzz/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <support/bodies.h>
#include <support/robots.h>

#include "core/check.h"
#include "fuzz/overlaps.h"
#include "model/accuracy.h"
#include "physics/dynamics/equality.h"

namespace roboss::fuzz {
namespace {

bool chance(Random& random, double probability) {
    return random.uniform(0, 1) < probability;
}

Scene still_air(const Setting& setting) {
    Scene scene;
    scene.world = test::empty_world(setting.dt_s, {});
    return scene;
}

Scene one_robot(const Setting& setting, ModelSpec model) {
    Scene scene = still_air(setting);
    test::place(scene.world, std::move(model), "robot");
    return scene;
}

Scene tree(Random& random, const Setting& setting) {
    return one_robot(setting, random_tree(random, {}));
}

Scene bare(Random& random, const Setting& setting) {
    MechanismOptions options;
    options.bare = true;
    return one_robot(setting, random_tree(random, options));
}

Scene anchored(Random& random, const Setting& setting) {
    MechanismOptions options;
    options.fixed_base = true;
    return one_robot(setting, random_tree(random, options));
}

Scene hanging(Random& random, const Setting& setting) {
    Scene scene = anchored(random, setting);
    scene.world.gravity = {0, 0, -9.81};
    return scene;
}

Scene loop(Random& random, const Setting& setting) {
    return one_robot(setting, random_loop(random, {}));
}

Scene net(Random& random, const Setting& setting) {
    return one_robot(setting, random_net(random, {}));
}

Scene coupled(Random& random, const Setting& setting) {
    return one_robot(setting, random_coupled(random, {}));
}

Scene idle_motors(Random& random, const Setting& setting) {
    MechanismOptions options;
    options.links_least = 2;
    Scene scene = one_robot(setting, random_tree(random, options));
    scene.zero_effort = true;
    return scene;
}

/// A mechanism with shapes, or a solid.
ModelSpec something(Random& random, double restitution_most) {
    MechanismOptions options;
    options.shapes = true;
    options.links_most = 4;
    options.restitution_most = restitution_most;
    return chance(random, 0.6) ? random_tree(random, options) : random_solid(random, restitution_most);
}

/// Puts 2 x 2 x 2 robots into cells in which none reaches another at the start; returns the edge of a cell.
double fill_cells(Random& random, double restitution_most, World& world) {
    std::vector<ModelSpec> models;
    double cell = 0;
    for (int i = 0; i < 8; ++i) {
        models.push_back(something(random, restitution_most));
        cell = std::fmax(cell, 2 * start_radius(models.back()));
    }
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner{i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5};
        test::place(world, models[static_cast<std::size_t>(i)], "robot_" + std::to_string(i),
                    {corner * cell, {}});
    }
    return cell;
}

constexpr double kRestitutionMost = 0.97;

/// A closed room, walls 0.2 m thick.
void add_room(Random& random, double edge, World& world) {
    constexpr double kThick = 0.2;
    const SurfaceSpec s =
        test::surface(random.uniform(0, 1), chance(random, 0.5) ? 0 : random.uniform(0, 0.97));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 size{edge + 2 * kThick, edge + 2 * kThick, edge + 2 * kThick}, p;
            size[axis] = kThick, p[axis] = side * 0.5 * (edge + kThick);
            test::place(world, test::scenery(test::box_shape(size, s)),
                        "wall_" + std::to_string(2 * axis) + (side < 0 ? "a" : "b"), {p, {}});
        }
    }
}

Scene room(Random& random, const Setting& setting) {
    Scene scene = still_air(setting);
    const double cell = fill_cells(random, chance(random, 0.5) ? kRestitutionMost : 0, scene.world);
    add_room(random, 2 * cell, scene.world);
    scene.base_speed = 3;
    return scene;
}

Scene cloud(Random& random, const Setting& setting) {
    Scene scene = still_air(setting);
    fill_cells(random, chance(random, 0.5) ? kRestitutionMost : 0, scene.world);
    scene.base_speed = 3;
    return scene;
}

/// Copies of one mechanism dropped on the ground, so that they go in lanes; some near each other.
Scene fleet(Random& random, const Setting& setting) {
    Scene scene;
    scene.world = test::empty_world(setting.dt_s);
    test::place(scene.world, test::ground(test::surface(random.uniform(0, 1))), "ground");
    const ModelSpec model = something(random, 0);
    const double radius = start_radius(model), spacing = random.uniform(1, 4) * radius;
    scene.world.prototypes.push_back(model);
    for (int i = 0; i < 12; ++i) {
        const Vec3 at{spacing * (i % 4), spacing * (i / 4), radius * random.uniform(1, 1.5)};
        scene.world.instances.push_back(
            {"robot_" + std::to_string(i), scene.world.prototypes.size() - 1, {at, random.rotation()}, {}});
    }
    return scene;
}

/// Cars, spiders and trees on the ground in each other's way, every motor with a target of its own.
Scene crowd(Random& random, const Setting& setting) {
    Scene scene;
    scene.world = test::empty_world(setting.dt_s);
    test::place(scene.world, test::ground(test::surface(0.7)), "ground");
    test::place(scene.world, test::scenery(test::box_shape({0.3, 3, 0.5}, test::surface(0.5))), "wall",
                {{0.4, 0, 0.2}, {}});
    for (int i = 0; i < 9; ++i) {
        const Vec3 at{0.6 * (i % 3 - 1) - 0.8, 0.5 * (i / 3 - 1), 0.01};
        const std::string name = "robot_" + std::to_string(i);
        const Quat turn = from_rpy(0, 0, random.uniform(-3, 3));
        const int pick = random.integer(0, 3);
        if (pick < 2) test::place(scene.world, with_own_joint_names(test::car()), name, {at, turn});
        if (pick == 2) test::place(scene.world, something(random, 0.5), name, {at + Vec3{0, 0, 0.8}, turn});
        if (pick == 3)
            test::place(scene.world, random_solid(random, 0.9), name, {at + Vec3{0, 0, 0.5}, turn});
    }
    scene.driven = true;
    return scene;
}

/// Some of the accuracy's numbers at an end of their range.
AccuracySpec random_corner(Random& random) {
    AccuracySpec spec;
    spec.setting = std::array{"fast", "standard", "high"}[static_cast<std::size_t>(random.integer(0, 2))];
    for (const AccuracyNumber& n : accuracy_numbers()) {
        const double pick = random.uniform(0, 1);
        if (pick < 0.4) continue;
        const double most = n.whole != nullptr ? std::fmin(n.high, 200) : n.high;
        spec.numbers.push_back({n.name, pick < 0.7 ? n.low : most});
    }
    return spec;
}

/// Mechanisms that start in each other and collide with themselves, hard or soft, driven by any motor.
Scene wild(Random& random, const Setting& setting) {
    Scene scene;
    scene.world = test::empty_world(setting.dt_s);
    test::place(scene.world, test::ground(test::surface(0.7)), "ground");
    const double stiffness = std::pow(10.0, random.uniform(2, 10)),
                 damping = std::pow(10.0, random.uniform(-1, 4));
    const bool soft = chance(random, 0.5);
    for (int i = 0; i < 5; ++i) {
        ModelSpec m = something(random, kRestitutionMost);
        m.self_collide = true;
        for (LinkSpec& l : m.links)
            for (CollisionSpec& c : l.collisions)
                if (soft) c.surface.stiffness = stiffness, c.surface.damping = damping;
        const Vec3 p{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(0, 0.5)};
        test::place(scene.world, m, "robot_" + std::to_string(i), {p, random.rotation()});
    }
    scene.world.accuracy.push_back(random_corner(random));
    scene.driven = true;
    return scene;
}

void put_on_board(ModelSpec& model, const char* name, OnboardParameters parameters) {
    model.onboard.push_back({name, std::move(parameters), {}});
}

/// A car that drives by commands, from a battery.
ModelSpec driven_car(Random& random) {
    ModelSpec model = with_own_joint_names(test::car());
    DiffDriveSpec drive;
    for (std::size_t i = 0; i < 4; ++i)
        (i % 2 == 0 ? drive.left : drive.right).push_back(model.joints[i].name);
    drive.linear.max_acceleration = random.uniform(0.5, 10);
    drive.linear.min_acceleration = -drive.linear.max_acceleration;
    put_on_board(model, "drive", drive);
    LinearBatterySpec battery;
    battery.battery_name = "cell", battery.voltage = 12, battery.capacity = 1e-3;
    battery.power_load = random.uniform(0, 50);
    put_on_board(model, "battery", battery);
    return model;
}

/// A solid with a gripper, a surface that moves, wings, or a velocity that is commanded.
ModelSpec acting_solid(Random& random) {
    ModelSpec model = random_solid(random, 0.9);
    const std::string& link = model.links[0].name;
    if (chance(random, 0.5)) {
        GripperSpec gripper;
        gripper.link = {link}, gripper.reach = 0.3, gripper.max_force = random.uniform(5, 500);
        put_on_board(model, "gripper", gripper);
    }
    if (chance(random, 0.4)) {
        SurfaceVelocitySpec surface;
        surface.link = {link}, surface.linear = random.vector(2), surface.angular = random.vector(2);
        put_on_board(model, "belt", surface);
    }
    if (chance(random, 0.3)) {
        LiftDragSpec wing;
        wing.link = {link};
        put_on_board(model, "wing", wing);
    }
    if (chance(random, 0.2)) put_on_board(model, "velocity", VelocityControlSpec{});
    return model;
}

/// A mechanism whose first joint with one axis is held by a controller.
ModelSpec held_mechanism(Random& random) {
    ModelSpec model = something(random, 0.5);
    for (const JointSpec& joint : model.joints) {
        if (joint.axes.size() != 1) continue;
        if (chance(random, 0.5)) {
            JointControllerSpec controller;
            controller.joints = {joint.name};
            put_on_board(model, "hold", controller);
        } else {
            JointPositionControllerSpec controller;
            controller.joints = {joint.name};
            put_on_board(model, "hold", controller);
        }
        break;
    }
    return model;
}

/// Robots with on-board controllers, to be commanded, that hold and carry each other.
Scene acting(Random& random, const Setting& setting) {
    Scene scene;
    scene.world = test::empty_world(setting.dt_s);
    scene.world.air_density = 1.2;
    scene.world.sleep = chance(random, 0.5);
    test::place(scene.world, test::ground(test::surface(0.7)), "ground");
    for (int i = 0; i < 8; ++i) {
        const Vec3 at{0.6 * (i % 3 - 1), 0.6 * (i / 3 - 1), 0.01};
        const std::string name = "robot_" + std::to_string(i);
        const int pick = random.integer(0, 2);
        if (pick == 0) test::place(scene.world, driven_car(random), name, {at, {}});
        if (pick == 1) test::place(scene.world, acting_solid(random), name, {at + Vec3{0, 0, 0.5}, {}});
        if (pick == 2) test::place(scene.world, held_mechanism(random), name, {at + Vec3{0, 0, 0.8}, {}});
    }
    return scene;
}

constexpr SceneKind kKinds[] = {
    {"tree", "a free tree of links in empty space", tree, true, true},
    {"bare", "a free tree on which no row ever acts", bare, true, true},
    {"anchored", "a tree on a fixed base, without gravity", anchored, true, false},
    {"hanging", "a tree on a fixed base under gravity", hanging, true, false},
    {"loop", "a free mechanism with a kinematic loop", loop, true, true},
    {"coupled", "a free mechanism with a mimic joint or a gearbox", coupled, true, true},
    {"idle-motors", "a free tree whose motors give an effort of 0", idle_motors, true, true},
    {"cloud", "eight free robots that collide in empty space", cloud, true, true},
    {"room", "eight free robots in a closed room", room, true, false},
    {"fleet", "twelve copies of one robot dropped on the ground", fleet, true, false},
    {"crowd", "nine driven robots on the ground that obstruct each other", crowd, false, false},
    {"wild", "driven robots that start interpenetrating, soft contacts, any accuracy", wild, false, false},
    {"acting", "robots with on-board controllers that are commanded and hold each other", acting, false,
     false},
    {"net", "a free mechanism with six loops and more", net, true, true},
    {"sunk", "a robot that starts in the ground", sunk, false, false, true},
    {"jammed", "robots that start in the ground and in each other", jammed, false, false, true},
};

/// Any motor at all, with targets far beyond what it can reach.
void drive(const RobotType& type, const Setting& setting, Random& random, RobotState& state) {
    for (std::size_t d = 0; d < state.motors.size(); ++d) {
        const int pick = random.integer(0, 3);
        const double most = std::isfinite(type.dofs[d].max_effort) ? type.dofs[d].max_effort : 50;
        MotorSetpoint& motor = state.motors[d];
        motor.mode = static_cast<MotorMode>(pick);
        const double target = random.uniform(-1, 1);
        motor.target = target * (motor.mode == MotorMode::kEffort     ? 5
                                 : motor.mode == MotorMode::kPosition ? 3
                                                                      : setting.spin);
        motor.max_effort = most;
    }
}

}  // namespace

std::span<const SceneKind> scene_kinds() {
    return kKinds;
}

const SceneKind* find_scene_kind(const std::string& name) {
    for (const SceneKind& kind : kKinds)
        if (name == kind.name) return &kind;
    return nullptr;
}

std::shared_ptr<const Model> compile_scene(const World& world) {
    Diagnostics diagnostics;
    validate(world, diagnostics);
    auto model = compile(world, {}, diagnostics);
    if (model == nullptr || diagnostics.count(Severity::kError) > 0)
        for (const Diagnostic& d : diagnostics.items())
            if (d.severity == Severity::kError) std::fprintf(stderr, "%s\n", to_text(d).c_str());
    ROBOSS_CHECK(model != nullptr && diagnostics.count(Severity::kError) == 0,
                 "a generated world does not compile");
    return model;
}

std::vector<RobotState> start_states(const Model& model, const Scene& scene, const Setting& setting,
                                     Random& random) {
    constexpr double kSlidePerTurn = 0.1;  // m/s of a slide for each rad/s of a hinge
    std::vector<RobotState> states;
    for (std::size_t r = 0; r < model.robots.size(); ++r) {
        const RobotId id(r);
        const RobotType& type = model.type_of(id);
        RobotState state = initial_state(model, id);
        for (const Body& body : type.bodies) {
            for (int k = 0; k < body.nv; ++k) {
                const bool base_linear = body.joint == JointKind::kFree && k >= 3;
                const double most = base_linear                           ? scene.base_speed
                                    : body.joint == JointKind::kPrismatic ? kSlidePerTurn * setting.spin
                                                                          : setting.spin;
                state.v[static_cast<std::size_t>(body.v_index + k)] = random.uniform(-most, most);
            }
        }
        if (type.has_equalities()) {
            RobotWork work;
            work.take(type, state);
            EqualityProjection projection;
            projection.close_velocities(work, state.q, state.v);
        }
        if (scene.driven) drive(type, setting, random, state);
        if (scene.zero_effort)
            for (std::size_t d = 0; d < state.motors.size(); ++d)
                state.motors[d].mode = MotorMode::kEffort,
                state.motors[d].max_effort = type.dofs[d].max_effort;
        states.push_back(std::move(state));
    }
    return states;
}

Start make_start(const Setting& setting, bool floats, bool sleeps) {
    const SceneKind* kind = find_scene_kind(setting.kind);
    ROBOSS_CHECK(kind != nullptr, "there is no such kind of scene");
    Random random(setting.seed);
    Scene scene = kind->make(random, setting);
    if (floats) scene.world.precision = Precision::kFloat;
    scene.world.sleep &= sleeps;
    Start start;
    start.model = compile_scene(scene.world);
    start.states = start_states(*start.model, scene, setting, random);
    return start;
}

Motion::Motion(const Setting& setting, bool sleeps) {
    Start start = make_start(setting, false, sleeps);
    model_ = std::move(start.model), states_ = std::move(start.states);
    for (std::size_t r = 0; r < states_.size(); ++r) ids_.emplace_back(r), pointers_.push_back(&states_[r]);
    bounds_.resize(states_.size());
}

const StepReport& Motion::step() {
    report_ = step_island(*model_, tick_++, ids_, pointers_, {}, bounds_, scratch_);
    return report_;
}

RobotId find_not_finite(const std::vector<RobotState>& states) {
    const auto finite = [](const std::vector<double>& x) {
        return std::ranges::all_of(x, [](double value) { return std::isfinite(value); });
    };
    for (std::size_t r = 0; r < states.size(); ++r)
        if (!finite(states[r].q) || !finite(states[r].v)) return RobotId(r);
    return {};
}

double Motion::fastest() const {
    double most = 0;
    for (const RobotState& state : states_)
        for (const double v : state.v) most = std::fmax(most, std::fabs(v));
    return most;
}

}  // namespace roboss::fuzz
