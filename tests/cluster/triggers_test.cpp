// A chain of messages over several robots: a message starts a car, it touches a wall, that moves a crate, and
// the crate enters a region. The same bits for every grouping, over saves, and with faults.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "client/triggers/triggers.h"
#include "faulty_cluster.h"
#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

constexpr double kDt = 0.002;
constexpr Tick kStart = 50, kEnd = 1400, kPeriod = 5;  // ticks
constexpr double kSpeed = 0.5;                         // m/s, of the car
constexpr Tick kTouchTime = 10, kDelay = 25;           // ticks

ModelSpec box(const std::string& name, const Vec3& size, bool is_static) {
    ModelSpec spec;
    spec.name = name, spec.canonical_link = "body", spec.is_static = is_static;
    LinkSpec& link = spec.links.emplace_back();
    link.name = "body";
    link.inertia_C = Mat3::diagonal(0.02, 0.02, 0.02);
    CollisionSpec& collision = link.collisions.emplace_back();
    collision.name = "c", collision.geometry.size = size, collision.surface.mu = 0.1;
    return spec;
}

BoardTrigger trigger(const std::string& topic, std::vector<BoardOutput> outputs) {
    BoardTrigger one;
    one.topic = topic, one.outputs = std::move(outputs);
    return one;
}

BoardOutput drive(const std::string& robot, std::vector<BoardValue> values) {
    BoardOutput output;
    output.topic = "/model/" + robot + "/cmd_vel", output.values = std::move(values);
    return output;
}

BoardOutput message(const std::string& topic) {
    BoardOutput output;
    output.topic = topic;
    return output;
}

/// What an importer makes of TouchPlugin, PerformerDetector and TriggeredPublisher.
MessageBoardSpec board(Tick touch_time) {
    MessageBoardSpec board;
    board.topics = {{"start", "/start", "", {}},
                    {"wall/touched", "/wall/touched", "wall", {{"data"}}},
                    {"wall/enable", "/wall/enable", "", {{"data"}}},
                    {"gate", "/gate", "gate", {{"state"}, {"count"}, {"position_y"}}},
                    {"done", "/done", "", {}},
                    {"left", "/left", "", {}}};
    BoardTrigger touched = trigger("/wall/touched", {drive("crate", {{"linear_y", 0.4}})});
    touched.delay = static_cast<double>(kDelay) * kDt;
    touched.matches.push_back({true, false, false, 1e-8, {{"data", 1}}});
    BoardTrigger entered = trigger("/gate", {message("/done"), drive("crate", {})});
    entered.matches.push_back({false, false, false, 1e-8, {{"state", 1}}});
    BoardTrigger left = trigger("/gate", {message("/left")});
    left.matches.push_back({false, true, false, 1e-8, {{"state", 1}}});
    board.triggers = {trigger("/start", {drive("car", {{"linear_x", kSpeed}})}),
                      trigger("/wall/touched", {drive("car", {})}), touched, entered, left};
    board.touches = {{"wall",
                      {{"body"}},
                      "car",
                      static_cast<double>(touch_time) * kDt,
                      true,
                      "/wall/enable",
                      "wall/touched"}};
    BoardDetector gate;
    gate.model = "gate", gate.is_static = true, gate.X_WM.p = {0, 4, 0};
    gate.size = {1, 1, 1}, gate.performer = "crate", gate.performer_size = {0.4, 0.4, 0.4},
    gate.told = "gate";
    board.detectors = {gate};
    return board;
}

std::shared_ptr<const Model> chain_world(Tick touch_time = kTouchTime) {
    World world;
    world.dt_s = kDt;
    ModelSpec floor = box("floor", {1, 1, 1}, true);
    floor.links[0].collisions[0].geometry.kind = GeometryKind::kPlane;
    ModelSpec car = box("car", {0.4, 0.4, 0.2}, false);
    car.onboard.push_back({"VelocityControl", VelocityControlSpec{}, {}});
    ModelSpec messages;
    messages.name = "message_board", messages.is_static = true, messages.canonical_link = "board";
    messages.links.emplace_back().name = "board";
    messages.onboard.push_back({"message board", board(touch_time), {}});
    world.prototypes = {floor, car, box("wall", {0.1, 2, 1}, true), messages};
    world.instances = {{"floor", 0, {}, {}},
                       {"car", 1, {{0, 0, 0.1}, {}}, {}},
                       {"wall", 2, {{1, 0, 0.5}, {}}, {}},
                       {"crate", 1, {{0, 3, 0.1}, {}}, {}},
                       {"message_board", 3, {}, {}}};
    Diagnostics diagnostics;
    auto model = compile(world, {}, diagnostics);
    EXPECT_TRUE(model != nullptr && !diagnostics.has_errors());
    return model;
}

/// Publishes /start, and notes the events that it sees.
class Watcher : public ControlProgram {
  public:
    explicit Watcher(std::vector<std::string>* seen = nullptr, double period_s = 0.02)
        : seen_(seen), period_s_(period_s) {}
    ControlOptions options() const override { return {period_s_, period_s_, true}; }
    void control(Client& client) override {
        if (client.tick() == kStart - 10) ok_ = client.publish("/start", {}).ok();
        for (const RobotEvent& event : client.events())
            if (seen_ != nullptr) seen_->push_back(std::to_string(event.tick) + " " + to_text(event));
    }

  private:
    std::vector<std::string>* seen_;
    double period_s_;
    bool ok_ = false;
};

std::vector<NamedProgram> programs_for(const std::shared_ptr<const Model>& model,
                                       std::vector<std::string>* seen = nullptr) {
    std::vector<NamedProgram> programs;
    programs.push_back({"watcher", std::make_unique<Watcher>(seen)});
    programs.push_back({Triggers::kName, std::make_unique<Triggers>(model)});
    return programs;
}

std::unique_ptr<Simulation> make(const std::shared_ptr<const Model>& model, std::size_t simulators,
                                 unsigned threads, Tick window, const SavedRun* from = nullptr) {
    SimulationOptions options;
    options.simulators = simulators, options.threads = threads, options.controller.window = window;
    auto made = Simulation::create(model, options, programs_for(model), from);
    EXPECT_TRUE(made.ok());
    return std::move(made).value();
}

/// When the robot was commanded last.
Tick commanded(const Model& model, const std::vector<RobotState>& states, const std::string& robot) {
    return static_cast<Tick>(states[model.find_robot(robot)->index()].onboard[0]);
}

TEST(Triggers, AChainFromAMessageOverATouchToARegion) {
    const auto model = chain_world();
    std::vector<std::string> seen;
    auto made = Simulation::create(model, {}, programs_for(model, &seen));
    ASSERT_TRUE(made.ok());
    Simulation& run = *made.value();
    ASSERT_TRUE(run.run_until(kStart + kPeriod + 1).ok());
    EXPECT_EQ(commanded(*model, run.states(), "car"), kStart + kPeriod)
        << "the message is seen at the next observation, and the order takes effect there";
    ASSERT_TRUE(run.run_until(kEnd).ok());

    // The car drives 0.75 m. The wall tells it after kTouchTime, up to two periods late.
    const Tick met = kStart + kPeriod + static_cast<Tick>(0.75 / kSpeed / kDt + 0.5);
    ASSERT_EQ(seen.size(), 4u) << ::testing::PrintToString(seen);
    EXPECT_EQ(seen[0], std::to_string(kStart) + " /start");
    std::istringstream touched(seen[1]);
    Tick tick = 0;
    std::string rest;
    std::getline(touched >> tick, rest);
    EXPECT_EQ(rest, " /wall/touched data=1");
    EXPECT_GE(tick, met + kTouchTime - 1);
    EXPECT_LE(tick, met + kTouchTime + 2 * kPeriod);
    EXPECT_EQ(commanded(*model, run.states(), "car"), tick) << "it stops at once";

    // The crate stands at y = 3 and meets the region (3.5 to 4.5, with 0.2 of its own) at 3.3.
    const Tick entered = tick + kDelay + static_cast<Tick>(0.3 / 0.4 / kDt + 0.5);
    std::istringstream gate(seen[2]);
    Tick at_gate = 0;
    std::getline(gate >> at_gate, rest);
    EXPECT_GE(at_gate, entered - 1);
    EXPECT_LE(at_gate, entered + 2 * kPeriod);
    EXPECT_EQ(rest.find(" /gate state=1 count=1 position_y=-0."), 0u) << rest;
    EXPECT_EQ(seen[3], std::to_string(at_gate) + " /done") << "and nobody has left";
}

TEST(Triggers, ATouchOfOneTickIsSeenInThatTick) {
    const auto model = chain_world(1);
    EXPECT_EQ(Triggers(model).options().period_s, kDt);
    std::vector<std::string> seen;
    auto made = Simulation::create(model, {}, programs_for(model, &seen));
    ASSERT_TRUE(made.value()->run_until(kEnd).ok());
    ASSERT_GE(seen.size(), 2u);
    const Tick touched = std::stol(seen[1]);
    auto again = make(model, 1, 1, 0);
    const auto touches_wall = [&] {
        const auto& contacts = again->states()[model->find_robot("car")->index()].contacts;
        return std::ranges::any_of(contacts, [&](const ContactMemory& contact) {
            return model->statics[contact.other_shape].name.starts_with("wall::");
        });
    };
    ASSERT_TRUE(again->run_until(touched - 1).ok());
    EXPECT_FALSE(touches_wall());
    ASSERT_TRUE(again->run_until(touched).ok());
    EXPECT_TRUE(touches_wall());
}

TEST(Triggers, ATouchIsToldOnceUntilItIsEnabledAgain) {
    const auto model = chain_world();
    std::vector<std::string> seen;
    auto made = Simulation::create(model, {}, programs_for(model, &seen));
    Simulation& run = *made.value();
    const auto board = model->find_robot("message_board");
    const auto car = model->find_robot("car");
    ASSERT_TRUE(board && car);
    const auto channel = static_cast<std::uint32_t>(*model->type_of(*board).find_channel("wall/enable"));
    // Pressed against the wall from tick 900 on, and enabled again at tick 1000.
    ASSERT_TRUE(run.submit({900, ClientId(), 1, *car, Command{0, {0.1, 0, 0, 0, 0, 0}}}).ok());
    ASSERT_TRUE(run.submit({1000, ClientId(), 2, *board, Command{channel, {1}}}).ok());
    ASSERT_TRUE(run.run_until(1100).ok());
    std::vector<Tick> touches;
    for (const std::string& line : seen)
        if (line.find("/wall/touched") != std::string::npos) touches.push_back(std::stol(line));
    ASSERT_EQ(touches.size(), 2u) << ::testing::PrintToString(seen);
    EXPECT_GE(touches[1], 1000 + kTouchTime);
    EXPECT_LE(touches[1], 1000 + kTouchTime + 3 * kPeriod);
}

TEST(Triggers, TheSameBitsForAllGroupings) {
    const auto model = chain_world();
    auto reference = make(model, 1, 1, 0);
    ASSERT_TRUE(reference->run_until(kEnd).ok());
    for (const std::size_t simulators : {1u, 2u, 3u}) {
        for (const Tick window : {Tick{0}, Tick{3}, Tick{7}}) {
            auto other = make(model, simulators, 2, window);
            ASSERT_TRUE(other->run_until(kEnd).ok());
            EXPECT_EQ(other->hash(), reference->hash()) << simulators << " Simulators, window " << window;
        }
    }
}

TEST(Triggers, ASavedRunGoesOnExactly) {
    const auto model = chain_world();
    auto whole = make(model, 2, 1, 0);
    ASSERT_TRUE(whole->run_until(kEnd).ok());
    const Tick touched = 805 + kTouchTime;
    // Before, on and after observations; during the touch, during the delay, before the region.
    for (const Tick half : {Tick{0}, kStart, kStart + 2, kStart + kPeriod, touched - 7, touched - 3, touched,
                            touched + 4, touched + 15, touched + 29, Tick{1000}, Tick{1205}}) {
        auto first = make(model, 2, 1, 0);
        ASSERT_TRUE(first->run_until(half).ok());
        const SavedRun saved = first->saved_run();
        auto second = make(model, 1, 1, 4, &saved);
        ASSERT_TRUE(second->run_until(kEnd).ok());
        EXPECT_EQ(second->hash(), whole->hash()) << "saved at tick " << half;
    }
}

TEST(Triggers, SeedsOfABadBusWithKillsEndWithTheUndisturbedHash) {
    const auto model = chain_world();
    auto undisturbed = make(model, 1, 1, 0);
    ASSERT_TRUE(undisturbed->run_until(kEnd).ok());
    int kills = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        ControllerOptions options;
        options.checkpoint_ticks = 20 + static_cast<Tick>(seed % 4) * 30;
        FaultyCluster cluster(model, options, bad_network(seed), {60, 30, 20, 250, 2000}, 1 + seed % 3);
        for (NamedProgram& program : programs_for(model))
            cluster.add_program(program.name, std::move(program.program));
        ASSERT_TRUE(cluster.run_until(kEnd)) << "stuck at tick " << cluster.controller().tick();
        EXPECT_EQ(cluster.controller().hash(), undisturbed->hash());
        kills += cluster.kills();
    }
    EXPECT_GT(kills, 5) << "else this test did not test";
}

TEST(Triggers, TriggersThatStartEachOtherForEverDoNotStopTheRun) {
    auto changed = std::make_shared<Model>(*chain_world());
    for (RobotType& type : changed->types)
        for (OnboardInfo& info : type.onboard)
            if (auto* spec = std::get_if<MessageBoardSpec>(&info.spec.parameters))
                spec->triggers = {trigger("/start", {message("/done")}),
                                  trigger("/done", {message("/start")})};
    std::vector<NamedProgram> programs = programs_for(changed);
    auto made = Simulation::create(changed, {}, std::move(programs));
    EXPECT_TRUE(made.value()->run_until(kStart + 4 * kPeriod).ok());
}

}  // namespace
}  // namespace roboss::test
