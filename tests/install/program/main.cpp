// A user's program: reads a world, a ball above a floor, lets it fall for a second, and looks at where it is.
// Then again with the world made in code, and with two Simulators. Ends with 0 if the ball lies on the floor
// and all agree.
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "core/hash.h"
#include "sdf/load_world.h"
#include "simulation/simulation.h"

namespace {

constexpr double kRadius = 0.1;
constexpr roboss::Tick kTicks = 1000;

roboss::ModelSpec model_of(const char* name, bool is_static, roboss::GeometrySpec geometry) {
    roboss::LinkSpec link;
    link.name = "link";
    link.inertia_C = roboss::Mat3::diagonal(0.004, 0.004, 0.004);
    roboss::CollisionSpec collision;
    collision.name = "shape";
    collision.geometry = geometry;
    link.collisions.push_back(collision);
    roboss::ModelSpec model;
    model.name = name;
    model.is_static = is_static;
    model.canonical_link = "link";
    model.links.push_back(link);
    return model;
}

roboss::World made_in_code() {
    roboss::GeometrySpec plane, sphere;
    plane.kind = roboss::GeometryKind::kPlane;
    sphere.kind = roboss::GeometryKind::kSphere;
    sphere.radius = kRadius;
    roboss::World world;
    world.name = "ball";
    world.prototypes = {model_of("floor", true, plane), model_of("ball", false, sphere)};
    world.instances = {{"floor", 0, {}, {}}, {"ball", 1, {{0, 0, 0.5}, {}}, {}}};
    return world;
}

struct Outcome {
    double height = 0;
    std::uint64_t hash = 0;
};

std::optional<Outcome> fall(const roboss::World& world, std::size_t simulators) {
    roboss::Diagnostics diagnostics;
    const std::shared_ptr<const roboss::Model> model = roboss::compile(world, {}, diagnostics);
    for (const roboss::Diagnostic& d : diagnostics.items()) std::printf("%s\n", to_text(d).c_str());
    if (!model) return std::nullopt;
    roboss::SimulationOptions options;
    options.simulators = simulators;
    auto created = roboss::Simulation::create(model, options);
    if (!created) return std::nullopt;
    const std::unique_ptr<roboss::Simulation> simulation = std::move(created).value();
    if (const auto run = simulation->run_until(kTicks); !run) {
        std::printf("%s\n", run.error().text().c_str());
        return std::nullopt;
    }
    const roboss::RobotId ball = model->find_robot("ball").value();
    return Outcome{base_pose(simulation->states()[ball.index()]).p.z, simulation->hash()};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    roboss::Diagnostics diagnostics;
    const std::optional<roboss::World> read = roboss::load_world(argv[1], {}, diagnostics);
    if (!read || diagnostics.has_errors()) return 3;
    const std::optional<Outcome> from_file = fall(*read, 1), from_code = fall(made_in_code(), 1),
                                 shared = fall(*read, 2);
    if (!from_file || !from_code || !shared) return 4;
    std::printf("height of the ball after 1 s: %.6f m, state hash %s\n", from_file->height,
                roboss::to_hex(from_file->hash).c_str());
    if (std::fabs(from_file->height - kRadius) > 1e-3 || std::fabs(from_code->height - kRadius) > 1e-3)
        return 5;
    return from_file->hash == shared->hash ? 0 : 6;
}
