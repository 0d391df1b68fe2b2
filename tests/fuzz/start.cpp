// Property: robots start with their joints within limits, followers behind their leaders, and stand on the
// ground where that is asked for: they touch it, and lie in nothing.
#include <cmath>
#include <cstdio>
#include <limits>

#include <support/bodies.h>

#include "fuzz/property.h"
#include "model/on_ground.h"
#include "physics/contact/contact.h"

namespace roboss::fuzz {
namespace {

/// Limits that leave zero out, and followers with offsets.
void move_limits(Random& random, ModelSpec& model) {
    for (JointSpec& joint : model.joints)
        for (AxisSpec& axis : joint.axes) {
            const double shift = random.uniform(-1.5, 1.5), offset = random.uniform(-0.5, 0.5);
            if (axis.has_limits() && random.integer(0, 1) == 0) axis.lower += shift, axis.upper += shift;
            if (axis.mimic) axis.mimic->offset += offset;
            if (random.integer(0, 2) == 0) axis.initial_position = random.uniform(-1, 1);
        }
}

/// A slope, a hilly field, or blocks on a plane, under all of it.
void add_ground(Random& random, World& world) {
    CollisionSpec ground = test::collision(GeometryKind::kPlane, test::surface(1));
    const Quat tilt = from_rpy(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0);
    const int kind = random.integer(0, 2);
    if (kind == 0) ground.X_LS.q = tilt;
    if (kind == 1) {
        auto grid = std::make_shared<HeightGridSpec>();
        grid->columns = grid->rows = 33, grid->size_x = grid->size_y = 40;
        for (std::size_t i = 0; i < grid->columns * grid->rows; ++i)
            grid->heights.push_back(random.uniform(-0.5, 0.5));
        ground.geometry.kind = GeometryKind::kHeightmap, ground.geometry.heights = grid;
    }
    test::place(world, test::scenery(ground), "ground");
    for (int i = 0; kind == 2 && i < 12; ++i) {
        const Vec3 at = random.vector(1.5);
        // Lower than the smallest robot, which comes down from its own height.
        const CollisionSpec block = test::box_shape({0.5, 0.5, 0.04}, test::surface(1));
        test::place(world, test::scenery(block), "block_" + std::to_string(i), {{at.x, at.y, 0.02}, {}});
    }
}

ModelSpec robot_of(Random& random, const std::string& kind) {
    MechanismOptions options;
    options.shapes = true;
    ModelSpec model = kind == "loop"      ? random_loop(random, options)
                      : kind == "coupled" ? random_coupled(random, options)
                                          : random_tree(random, options);
    move_limits(random, model);
    return model;
}

std::string amount(const char* what, double value) {
    char buffer[96];
    std::snprintf(buffer, sizeof buffer, "%s: %g", what, value);
    return buffer;
}

/// How far joints are beyond limits or off their leaders; what a warning names does not count.
Finding judge_joints(const Model& model, const Diagnostics& diagnostics) {
    Finding finding;
    for (const Diagnostic& d : diagnostics.items())
        if (d.code == "start-beyond-limits") return finding;
    const RobotType& type = model.types.front();
    const std::vector<double> q = initial_state(model, RobotId(std::size_t{0})).q;
    const auto at = [&](std::size_t dof) {
        return q[static_cast<std::size_t>(
            type.bodies[static_cast<std::size_t>(type.dofs[dof].body)].q_index)];
    };
    const auto judge = [&](double off, const char* what) {
        if (off > finding.figure) finding.figure = off, finding.text = amount(what, off);
    };
    for (std::size_t i = 0; i < type.dofs.size(); ++i) {
        const Dof& dof = type.dofs[i];
        if (type.bodies[static_cast<std::size_t>(dof.body)].nv != 1) continue;
        judge(std::fmax(dof.lower - at(i), at(i) - dof.upper), "a joint starts beyond its limits");
    }
    for (const CoordinateCoupling& c : type.couplings)
        judge(std::fabs(at(static_cast<std::size_t>(c.follower)) -
                        c.multiplier * at(static_cast<std::size_t>(c.leader)) - c.offset),
              "a follower starts off its leader");
    return finding;
}

/// The least gap to the scenery, m; infinite: nothing is near.
double least_gap(const Model& model) {
    RobotState state = initial_state(model, RobotId(std::size_t{0}));
    std::vector<RobotWork> works(1);
    place_robot(model, RobotId(std::size_t{0}), state, works[0]);
    ContactFinder finder;
    std::vector<Contact> contacts;
    finder.find(model, works, nullptr, false, contacts);
    double gap = std::numeric_limits<double>::infinity();
    for (const Contact& c : contacts)
        if (c.robot_b < 0) gap = std::fmin(gap, c.gap);
    return gap;
}

Finding judged(Finding finding) {
    finding.failed = !(finding.figure <= kStartErrorMost);
    return finding;
}

}  // namespace

Finding run_start(const Request& request) {
    Random random(request.setting.seed);
    World world = test::empty_world(request.setting.dt_s);
    test::place(world, robot_of(random, request.setting.kind), "robot",
                {{0, 0, random.uniform(-2, 2)}, random.rotation()});
    add_ground(random, world);
    Diagnostics diagnostics;
    const std::shared_ptr<const Model> model = compile(world, {}, diagnostics);
    if (!model || model->robots.empty()) return {};  // a loop that no start closes is an error of the file
    Finding finding = judge_joints(*model, diagnostics);
    const RobotType& type = model->types.front();
    if (!type.free_base || type.shapes.empty()) return judged(finding);  // it stays where it is
    const double gap = least_gap(*stood_on_ground(*model, {}, diagnostics));
    if (!(std::fabs(gap) <= finding.figure)) {
        finding.figure = std::fabs(gap);
        finding.text = amount("gap between the robot and the ground", gap);
    }
    if (request.print_line) request.print_line(amount("gap", gap));
    return judged(finding);
}

}  // namespace roboss::fuzz
