// A user's program: makes a world in code, a ball above a floor, lets it fall for a second, and looks at
// where it is. Ends with 0 if the ball lies on the floor and a second run gave the same state hash.
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "model/model.h"
#include "model/robot_state.h"
#include "physics/step.h"

namespace {

constexpr double kRadius = 0.1;

roboss::ModelSpec model_of(const char* name, bool is_static, roboss::GeometrySpec geometry) {
    roboss::LinkSpec link;
    link.name = "link";
    link.inertia_C = roboss::Mat3::diagonal(0.004, 0.004, 0.004);
    link.collisions.push_back({"shape", geometry, {}, {}, {}});
    roboss::ModelSpec model;
    model.name = name;
    model.is_static = is_static;
    model.canonical_link = "link";
    model.links.push_back(link);
    return model;
}

roboss::World ball_above_floor() {
    roboss::GeometrySpec plane, sphere;
    plane.kind = roboss::GeometryKind::kPlane;
    sphere.kind = roboss::GeometryKind::kSphere;
    sphere.radius = kRadius;
    roboss::World world;
    world.name = "outside";
    world.prototypes = {model_of("floor", true, plane), model_of("ball", false, sphere)};
    world.instances = {{"floor", 0, {}, {}}, {"ball", 1, {{0, 0, 0.5}, {}}, {}}};
    return world;
}

struct Outcome {
    double height = 0;
    std::uint64_t hash = 0;
};

std::optional<Outcome> fall() {
    roboss::Diagnostics diagnostics;
    const std::shared_ptr<const roboss::Model> model = roboss::compile(ball_above_floor(), {}, diagnostics);
    for (const roboss::Diagnostic& d : diagnostics.items()) std::printf("%s\n", to_text(d).c_str());
    if (!model) return std::nullopt;
    const roboss::RobotId ball = model->find_robot("ball").value();
    roboss::RobotState state = initial_state(*model, ball);
    roboss::RobotState* states[] = {&state};
    roboss::Aabb bounds[1];
    roboss::StepScratch scratch;
    roboss::Tick tick = 0;
    for (; tick < 1000; ++tick) step_island(*model, tick, {&ball, 1}, states, {}, bounds, scratch);
    return Outcome{base_pose(state).p.z, state_hash(ball, tick, state)};
}

}  // namespace

int main() {
    const std::optional<Outcome> first = fall(), second = fall();
    if (!first || !second) return 1;
    std::printf("height of the ball after 1 s: %.6f m, state hash %s\n", first->height,
                roboss::to_hex(first->hash).c_str());
    return std::fabs(first->height - kRadius) < 1e-3 && first->hash == second->hash ? 0 : 1;
}
