// The whole chain on the real thing: the committed city is loaded, compiled, simulated, and driven by the
// control program as a loaded library. Counted: the way of each car, and touches of anything that stands
// still.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "client/plugin.h"
#include "sdf/load_world.h"
#include "simulation/simulation.h"

namespace roboss {
namespace {

struct Drive {
    std::vector<double> way;          // m, one a car
    std::vector<int> static_touches;  // observed ticks with a contact that is not the ground
};

bool touches_scenery(const Model& model, const RobotState& state) {
    return std::any_of(state.contacts.begin(), state.contacts.end(), [&](const ContactMemory& contact) {
        return contact.other_robot == RobotId::kNone &&
               model.statics[contact.other_shape].shape.kind != ShapeKind::kPlane;
    });
}

std::shared_ptr<const Model> compiled_city() {
    Diagnostics diagnostics;
    const auto world = load_world(ROBOSS_WORLDS "/city.sdf", {}, diagnostics);
    auto model = world ? compile(*world, {}, diagnostics) : nullptr;
    for (const Diagnostic& finding : diagnostics.items()) ADD_FAILURE() << to_text(finding);
    return model;
}

Drive drive_city(double duration_s, std::uint64_t seed) {
    const auto model = compiled_city();
    auto program = load_control_program(ROBOSS_CITY_DRIVER);
    if (!model || !program.ok()) {
        ADD_FAILURE() << (model ? program.error().text() : "no model");
        return {};
    }
    SimulationOptions options;
    options.controller.seed = seed;
    std::vector<NamedProgram> programs;
    programs.push_back({"driver", std::move(program).value()});
    auto simulation = Simulation::create(model, options, std::move(programs)).value();
    Drive drive{std::vector<double>(model->robots.size()), std::vector<int>(model->robots.size())};
    std::vector<RobotState> before = simulation->states();
    const Tick last = static_cast<Tick>(std::floor(duration_s / model->dt_s));
    for (Tick tick = 50; tick <= last; tick += 50) {
        const Result<> result = simulation->run_until(tick);
        if (!result.ok()) {
            ADD_FAILURE() << result.error().text();
            break;
        }
        const std::vector<RobotState>& now = simulation->states();
        for (std::size_t i = 0; i < now.size(); ++i) {
            drive.way[i] += norm(base_pose(now[i]).p - base_pose(before[i]).p);
            drive.static_touches[i] += touches_scenery(*model, now[i]) ? 1 : 0;
        }
        before = now;
    }
    return drive;
}

TEST(City, NineOfTenCarsDriveAMetreASecondAndBuildingsAreLeftAlone) {
    const double duration_s = ROBOSS_CITY_SECONDS;
    const Drive drive = drive_city(duration_s, 1);
    ASSERT_EQ(drive.way.size(), 50u);
    const auto fast =
        std::count_if(drive.way.begin(), drive.way.end(), [&](double way) { return way > duration_s; });
    EXPECT_GE(fast, 45);
    int touching = 0;
    for (int touches : drive.static_touches) touching += touches > 0 ? 1 : 0;
    EXPECT_LE(touching, 2) << "cars that touched a building or a parked obstacle";
    RecordProperty("cars_over_a_metre_a_second", static_cast<int>(fast));
    RecordProperty("cars_that_touched_scenery", touching);
}

}  // namespace
}  // namespace roboss
