// The test worlds: prototypes and instances, as the SDF loader would make them.
#include "test_worlds.h"

#include <cmath>
#include <cstdio>

#include "world/joint_type.h"

namespace roboss::test {

namespace {

constexpr double kQuarterTurn = 1.5707963267948966;

Mat3 box_inertia(double mass, const Vec3& size) {
    const double k = mass / 12;
    return Mat3::diagonal(k * (size.y * size.y + size.z * size.z), k * (size.x * size.x + size.z * size.z),
                          k * (size.x * size.x + size.y * size.y));
}

CollisionSpec collision(const std::string& name, GeometryKind kind, const Vec3& size, double radius,
                        double length) {
    CollisionSpec c;
    c.name = name;
    c.geometry.kind = kind;
    c.geometry.size = size;
    c.geometry.radius = radius;
    c.geometry.length = length;
    c.surface.mu = c.surface.mu2 = 0.8;
    return c;
}

LinkSpec link(const std::string& name, double mass, const Mat3& inertia, CollisionSpec shape,
              const Pose& X_ML = {}) {
    LinkSpec l;
    l.name = name;
    l.mass = mass;
    l.inertia_C = inertia;
    l.X_ML = X_ML;
    l.collisions.push_back(std::move(shape));
    return l;
}

ModelSpec one_link_model(const std::string& name, LinkSpec only) {
    ModelSpec m;
    m.name = name;
    m.canonical_link = only.name;
    m.links.push_back(std::move(only));
    return m;
}

ModelSpec ground() {
    ModelSpec m = one_link_model("ground", link("link", 1, Mat3::identity(),
                                                collision("plane", GeometryKind::kPlane, {1, 1, 0}, 0, 0)));
    m.is_static = true;
    return m;
}

ModelSpec wall() {
    ModelSpec m = one_link_model(
        "wall", link("link", 1, Mat3::identity(), collision("box", GeometryKind::kBox, {0.4, 6, 1}, 0, 0)));
    m.is_static = true;
    return m;
}

ModelSpec crate() {
    const Vec3 size{0.4, 0.4, 0.4};
    return one_link_model(
        "crate", link("link", 2, box_inertia(2, size), collision("box", GeometryKind::kBox, size, 0, 0)));
}

ModelSpec ball() {
    CollisionSpec shape = collision("ball", GeometryKind::kSphere, {}, 0.2, 0);
    shape.surface.restitution = 0.6;
    return one_link_model("ball", link("link", 1, Mat3::diagonal(0.016, 0.016, 0.016), std::move(shape)));
}

ModelSpec cart() {
    const Vec3 size{0.8, 0.5, 0.2};
    ModelSpec m =
        one_link_model("cart", link("body", 10, box_inertia(10, size),
                                    collision("box", GeometryKind::kBox, size, 0, 0), {{0, 0, 0.25}, {}}));
    int i = 0;
    for (const double x : {-0.3, 0.3})
        for (const double y : {-0.32, 0.32}) {
            const std::string name = "wheel_" + std::to_string(i);
            const Pose X_ML{{x, y, 0.15}, axis_angle({1, 0, 0}, kQuarterTurn)};
            m.links.push_back(link(name, 1, Mat3::diagonal(0.006, 0.006, 0.011),
                                   collision("tyre", GeometryKind::kCylinder, {}, 0.15, 0.1), X_ML));
            JointSpec j;
            j.name = "axle_" + std::to_string(i++);
            j.kind = JointSpecKind::kContinuous;
            j.parent = "body";
            j.child = name;
            j.X_MJ = {{x, y, 0.15}, {}};
            j.axes.emplace_back();
            j.axes[0].xyz = {0, 1, 0};
            j.axes[0].max_effort = 8;
            m.joints.push_back(std::move(j));
        }
    return m;
}

World empty_world(const std::string& name) {
    World world;
    world.name = name;
    world.dt_s = 0.002;
    world.sleep = true;
    world.prototypes.push_back(ground());
    world.instances.push_back({"ground", 0, {}, {}});
    return world;
}

std::shared_ptr<const Model> compiled(const World& world) {
    Diagnostics diagnostics;
    std::shared_ptr<const Model> model = compile(world, {}, diagnostics);
    for (const Diagnostic& d : diagnostics.items())
        if (d.severity == Severity::kError) std::fprintf(stderr, "%s\n", to_text(d).c_str());
    return model;
}

}  // namespace

std::shared_ptr<const Model> piles_world(int piles) {
    World world = empty_world("piles");
    world.prototypes.push_back(crate());
    world.prototypes.push_back(ball());
    int n = 0;
    for (int h = 0; h < piles; ++h) {
        const double x = 2.5 * h;
        for (int i = 0; i < 3; ++i)
            world.instances.push_back(
                {"crate_" + std::to_string(n++), 1, {{x + 0.1 * i, 0.05 * i, 0.21 + 0.45 * i}, {}}, {}});
        world.instances.push_back(
            {"ball_" + std::to_string(n++), 2, {{x - 0.8, 0.1, 1.5 + 0.3 * h}, {}}, {}});
    }
    for (int i = 0; i < 5; ++i)
        world.instances.push_back({"row_" + std::to_string(i), 1, {{0.55 * i, 4, 0.2}, {}}, {}});
    return compiled(world);
}

std::shared_ptr<const Model> sleepers_world() {
    World world = empty_world("sleepers");
    world.prototypes.push_back(crate());
    world.prototypes.push_back(ball());
    for (int stack = 0; stack < 4; ++stack)
        for (int i = 0; i < 3; ++i)
            world.instances.push_back({"crate_" + std::to_string(3 * stack + i),
                                       1,
                                       {{1.5 * stack + 0.02 * i, 0, 0.2 + 0.401 * i}, {}},
                                       {}});
    world.instances.push_back({"ball", 2, {{0, 6, 0.2}, {}}, {}});
    return compiled(world);
}

std::shared_ptr<const Model> pair_world() {
    World world = empty_world("pair");
    world.prototypes.push_back(crate());
    world.prototypes.push_back(ball());
    world.instances.push_back({"lower", 1, {{0, 0, 0.2}, {}}, {}});
    world.instances.push_back({"upper", 1, {{0.1, 0.05, 0.601}, {}}, {}});
    world.instances.push_back({"lone_crate", 1, {{8, 0, 0.2}, {}}, {}});
    world.instances.push_back({"lone_ball", 2, {{-8, 0, 0.9}, {}}, {}});
    return compiled(world);
}

std::shared_ptr<const Model> carts_world(int carts) {
    World world = empty_world("carts");
    world.prototypes.push_back(wall());
    world.prototypes.push_back(cart());
    world.prototypes.push_back(ball());
    world.instances.push_back({"wall", 1, {{5, 0, 0.5}, {}}, {}});
    for (int i = 0; i < carts; ++i) {
        const Quat turn = axis_angle({0, 0, 1}, 0.9 * i);
        world.instances.push_back(
            {"cart_" + std::to_string(i), 2, {{1.6 * (i % 3), 1.4 * (i / 3), 0.01}, turn}, {}});
        world.instances.push_back(
            {"ball_" + std::to_string(i), 3, {{1.6 * (i % 3) + 0.9, 1.4 * (i / 3) + 0.5, 0.3}, {}}, {}});
    }
    return compiled(world);
}

void DrivingProgram::control(Client& client) {
    ++calls_;
    const Model& model = client.model();
    for (std::size_t r = 0; r < model.robots.size(); ++r) {
        const RobotId robot(r);
        const RobotType& type = model.type_of(robot);
        const RobotState& state = client.state(robot);
        if (type.joints.empty()) {
            if (calls_ % 7 == static_cast<int>(r % 7))
                if (!client.apply_wrench(robot, LinkId(0u), {3 * state.q[1] - 2 * state.q[0], 4, 1}, {},
                                         0.05))
                    return;
            continue;
        }
        const double pull = state.q[0] * 0.7 - state.q[1] * 0.4;  // what it does depends on where it is
        for (std::size_t j = 0; j < type.joints.size(); ++j) {
            const double speed = 6 + (j % 2 == 0 ? pull : -pull) + 0.1 * (calls_ % 11);
            if (!client.set_joint(robot, JointId(j), MotorMode::kVelocity, speed)) return;
        }
    }
}

void DisturbingProgram::control(Client& client) {
    ++calls_;
    Result<> given = Ok{};
    if (calls_ == 40) given = client.set_pose(RobotId(0u), {{-4, 3, 0.2}, {}});  // from under its stack
    if (calls_ == 55) given = client.set_pose(RobotId(12u), {{1.5, -2, 0.6}, {}});
    if (calls_ == 56) given = client.set_velocity(RobotId(12u), {0, 6, 1}, {});  // at the second stack
    if (calls_ == 70) given = client.apply_wrench(RobotId(8u), LinkId(0u), {0, 0, 60}, {}, 0.1);
    if (calls_ == 80) given = client.set_pose(RobotId(11u), {{4.5, 0, 1.0}, {}});  // where it is already
    ok_ = ok_ && given.ok();
}

}  // namespace roboss::test
