// A real robot's twin in a simulated run.
#include "device/twin.h"

#include "devices.h"
#include "simulation/simulation.h"

namespace roboss::test {
namespace {

TEST(Twin, FollowsTheRealRobotByItsWheelsAndLeavesOthersAlone) {
    const auto model = world_file("khepera.sdf");
    const RobotId robot = id_of(*model, "khepera");
    FakeKhepera real;
    real.turning = {5, 5};
    std::vector<Device> devices(1);
    devices[0] = {std::move(make_adapter("khepera", *model, robot)).value(), "fake", robot};

    auto made = Simulation::create(model, {});
    ASSERT_TRUE(made.ok());
    Simulation& run = *made.value();
    const auto body = [&] {
        return link_pose(model->type_of(robot), run.states()[robot.index()], LinkId(0u));
    };
    const Transform start = body();
    BusClient client(model, {Role::kClient, 77}, twin_options(*model, "twin"));
    Twin twin(client, devices);
    constexpr Tick kTicks = 500;  // 40 mm: before the block
    double now = 0;
    for (Tick tick = 0; tick <= kTicks; tick += 10) {
        real.counts = {tick, tick};  // 0.08 mm a tick
        for (int i = 0; i < 4; ++i, now += 0.005) {
            for (const std::string& bytes : devices[0].adapter->due(now)) real.hear(bytes);
            for (const std::string& bytes : real.say()) devices[0].adapter->receive(bytes, now);
        }
        twin.advance(run.bus());
        ASSERT_TRUE(run.run_until(tick).ok());
        run.serve();
    }
    EXPECT_GT(twin.placed(), 10u);
    const RobotState& state = run.states()[robot.index()];
    const Vec3 moved = transpose(start.R) * (body().p - start.p);  // ahead, to the left
    EXPECT_NEAR(moved.x, kTicks * KheperaUnits::kMetres, 0.004);
    EXPECT_NEAR(moved.y, 0, 1e-3);
    const RobotType& type = model->type_of(robot);
    EXPECT_NEAR(joint_state(type, state, *type.find_joint("left")).position, kTicks * KheperaUnits::kRadians,
                0.6);
    ASSERT_NE(twin.state(robot), nullptr);
}

}  // namespace
}  // namespace roboss::test
