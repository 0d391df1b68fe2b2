// See test_run.h.
#include "test_run.h"

#include "core/monotonic.h"
#include "sdf/load_world.h"

namespace roboss::test {
namespace {

constexpr Tick kPeriod = 10;  // ticks of a turn, and between looks of the Client

std::shared_ptr<const Model> model_of(const std::string& sdf, double dt_s, Diagnostics& found) {
    const std::optional<World> world = load_world_text(sdf, "test.sdf", {}, found);
    CompileOptions options;
    if (dt_s > 0) options.dt_s = dt_s;
    return world && !found.has_errors() ? compile(*world, options, found) : nullptr;
}

}  // namespace

TestRun::TestRun(const std::string& sdf, ros2::SimulationOptions options) {
    Diagnostics found;
    world_ = model_of(sdf, 0, found);
    for (const Diagnostic& d : found.items())
        if (d.severity == Severity::kError) ADD_FAILURE() << to_text(d);
    begin(world_, nullptr);
    services = std::make_unique<ros2::SimulationServices>(transport, transport.add_node("/", "roboss"),
                                                          control, std::move(options));
    EXPECT_TRUE(until([&] { return client_ && client_->tick() >= 0; }));
}

void TestRun::begin(const std::shared_ptr<const Model>& model, const SavedRun* from) {
    SimulationOptions options;
    options.world_file = "test.sdf";
    options.observer = [this](Bus& bus) { look(bus); };
    if (simulation_) {
        options.controller.before = simulation_->hand_over();
        options.controller.before.went_back = from->tick < simulation_->tick();
    }
    auto made =
        Simulation::create(model, options, {}, from, simulation_ ? simulation_->release_bus() : nullptr);
    ASSERT_TRUE(made) << made.error().text();
    simulation_ = std::move(made).value();
    model_ = model;
}

void TestRun::look(Bus& bus) {
    if (!client_ || client_->outdated()) {
        BusClientOptions options;
        options.synchronous = false, options.observer = true, options.period = kPeriod;
        options.resend_ms = 5;
        auto next = std::make_unique<BusClient>(model_, Address{Role::kClient, ++clients_}, options);
        control.use(*next);
        client_ = std::move(next);
    }
    client_->advance(bus);
    control.advance();
    if (client_->observing()) client_->answer(bus);
    for (const ros2::Incoming& call : transport.take(0))
        if (!services->take(call) && take) take(call);
    if (services) services->advance(bus.now_ms());
    if (advance) advance(bus.now_ms());
    if (control.take_ordered()) client_->send(bus, client_->tick());
}

void TestRun::turn() {
    if (paused_) {
        simulation_->serve();
    } else {
        const Tick next = tick() + kPeriod;
        const Result<> ran = simulation_->run_until(step_until_ ? std::min(next, *step_until_) : next);
        EXPECT_TRUE(ran);
        if (step_until_ && tick() >= *step_until_) paused_ = true, step_until_.reset();
    }
    for (const ControlCall& call : simulation_->take_control_calls()) {
        ControlOutcome outcome = execute(call.request.action);  // which may make another Simulation
        simulation_->answer(call, std::move(outcome));
    }
}

bool TestRun::until(const std::function<bool()>& condition) {
    constexpr std::int64_t kPatience_ms = 20'000;
    const std::int64_t begin_ms = monotonic_ms();
    while (!condition() && monotonic_ms() - begin_ms < kPatience_ms) turn();
    return condition();
}

std::string TestRun::wait_for(std::int64_t call) {
    EXPECT_TRUE(until([&] { return transport.replies.contains(call); })) << "no reply to call " << call;
    if (!transport.replies.contains(call)) return "";
    EXPECT_EQ(transport.replies[call].size(), 1u);
    return transport.replies[call].front();
}

ControlOutcome TestRun::change(const Result<ModelEdit>& edit) {
    if (!edit) return ControlRefused(edit.error());
    SavedRun run = simulation_->saved_run();
    run.states = carry_over(edit.value(), run.states);
    begin(edit.value().model, &run);
    return ControlDone{tick(), "changed"};
}

ControlOutcome TestRun::execute(const ControlAction& action) {
    if (std::holds_alternative<GetStatus>(action)) {
        RunStatus status;
        status.world = "test.sdf", status.tick = tick(), status.paused = paused_;
        return status;
    }
    if (std::holds_alternative<PauseRun>(action)) {
        paused_ = true, step_until_.reset();
    } else if (std::holds_alternative<ResumeRun>(action)) {
        paused_ = false, step_until_.reset();
    } else if (const auto* step = std::get_if<StepRun>(&action)) {
        paused_ = false, step_until_ = tick() + step->ticks;
    } else if (std::holds_alternative<ResetRun>(action)) {
        SavedRun run;
        for (std::size_t i = 0; i < world_->robots.size(); ++i)
            run.states.push_back(initial_state(*world_, RobotId(i)));
        begin(world_, &run);
    } else if (const auto* remove = std::get_if<RemoveRobots>(&action)) {
        return change(without_robots(*model_, remove->names));
    } else if (const auto* add = std::get_if<AddModels>(&action)) {
        Diagnostics found;
        const auto addition = model_of(add->content, model_->dt_s, found);
        if (!addition) return ControlRefused(Error{"it is no model", "", "bad-model"});
        return change(with_models(*model_, *addition, add->X_WA, add->name));
    } else {
        return ControlRefused(Error{"the test does not have this request", "", "unknown"});
    }
    return ControlDone{tick(), "done"};
}

std::string ball_and_arm() {
    return R"(<sdf version="1.9"><world name="hall">
<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry></collision>
</link></model>
<model name="ball"><pose>0 0 2 0 0 0</pose><link name="l"><collision name="c"><geometry><sphere><radius>0.5</radius>
</sphere></geometry></collision></link></model>
<model name="arm"><pose>5 0 0 0 0 0</pose><link name="base"/><link name="upper"><pose>0 0 1 0 0 0</pose></link>
<link name="lower"><pose>0 0 2 0 0 0</pose></link>
<joint name="weld" type="fixed"><parent>world</parent><child>base</child></joint>
<joint name="shoulder" type="revolute"><parent>base</parent><child>upper</child><axis><xyz>0 0 1</xyz></axis></joint>
<joint name="elbow" type="revolute"><parent>upper</parent><child>lower</child><axis><xyz>0 0 1</xyz></axis></joint>
</model></world></sdf>)";
}

std::string box_model(const std::string& name) {
    return R"(<sdf version="1.9"><model name=")" + name +
           R"("><pose>0 0 1 0 0 0</pose><link name="l"><collision name="c"><geometry><box><size>1 1 1</size></box>
</geometry></collision></link></model></sdf>)";
}

}  // namespace roboss::test
