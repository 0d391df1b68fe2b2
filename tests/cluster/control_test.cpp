// A Client asks the run itself for something, and hears what became of it, over a bad Bus too.
#include <gtest/gtest.h>

#include <utility>

#include "bus/faulty_bus.h"
#include "client/bus_client.h"
#include "roles/controller/controller.h"
#include "roles/simulator/simulator.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

TEST(Control, AClientsRequestsComeOnceAndInOrderAndAreAnswered) {
    const auto model = pair_world();
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        FaultyBus bus({seed, 0.2, 0.2, 5});
        ControllerOptions options;
        options.resend_ms = 20;
        Controller controller(model, options, beginning_of(*model));
        BusClientOptions asking;
        asking.synchronous = false;
        asking.resend_ms = 20;
        BusClient client(model, {Role::kClient, 1}, asking);
        const SetSpeed twice{SetSpeed::Kind::kFactor, 2};
        client.control(PauseRun{});
        client.control(twice);
        std::vector<ControlAction> heard;
        std::vector<ControlAnswer> answers;
        for (int turns = 0; turns < 5'000 && answers.size() < 2; ++turns) {
            bus.advance_clock(1);
            controller.advance(bus);
            for (const ControlCall& call : controller.control().take_calls()) {
                heard.push_back(call.request.action);
                const ControlOutcome refused = ControlRefused(Error{"no", "", "refused"});
                controller.control().answer(bus, call, heard.size() == 1 ? ControlDone{3, "heard"} : refused);
            }
            client.advance(bus);
            for (ControlAnswer& answer : client.take_control_answers()) answers.push_back(std::move(answer));
        }
        EXPECT_EQ(heard, (std::vector<ControlAction>{PauseRun{}, twice})) << "seed " << seed;
        ASSERT_EQ(answers.size(), 2u) << "seed " << seed;
        EXPECT_TRUE(answers[0].done());
        EXPECT_FALSE(answers[1].done());
        EXPECT_EQ(answers[1].request, ControlAction(twice));
        EXPECT_EQ(std::get<ControlRefused>(answers[1].outcome).code, "refused");
    }
}

/// A synchronous Client that answers all the time asks in between.
TEST(Control, ARequestDoesNotWaitForAPauseInTheAnswers) {
    const auto model = pair_world();
    FaultyBus bus({1, 0, 0, 0});
    Controller controller(model, {}, beginning_of(*model));
    ThreadPool pool{1};
    Simulator simulator(model, {Role::kSimulator, 1}, {}, pool);
    BusClient client(model, {Role::kClient, 1}, {});
    controller.run_until(1'000);
    bool asked = false, heard = false;
    for (int turns = 0; turns < 20'000 && controller.tick() < 200 && !heard; ++turns) {
        if (turns % 10 == 0) bus.advance_clock(1);
        controller.advance(bus);
        simulator.advance(bus);
        client.advance(bus);
        heard = !controller.control().take_calls().empty();
        if (!client.observing()) continue;
        if (client.tick() >= 50 && !std::exchange(asked, true)) client.control(PauseRun{});
        client.answer(bus);
    }
    EXPECT_TRUE(asked);
    EXPECT_TRUE(heard) << "at tick " << controller.tick();
    EXPECT_LT(controller.tick(), 60);
}

}  // namespace
}  // namespace roboss::test
