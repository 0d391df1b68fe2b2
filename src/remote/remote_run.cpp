// See remote_run.h.
#include "remote/remote_run.h"

#include <random>

#include "bus/model_pull.h"
#include "client/bus_client.h"
#include "core/error_text.h"
#include "net/stream_bus.h"
#include "visuals/visual_fetch.h"

namespace roboss {

namespace {

constexpr std::int64_t kTurn_ms = 10, kResend_ms = 250, kLeave_ms = 5'000;

Address client_address() {
    std::random_device device;
    return {Role::kClient, static_cast<std::uint64_t>(device()) << 32 | device()};
}

Error no_controller(const RemoteOptions& options) {
    return {"no Controller of " + describe(options.network) + " was found for " +
                std::to_string(static_cast<int>(options.patience_s)) + " s",
            "start `roboss controller` with the same --simulation, or give the address of its computer",
            "no-controller"};
}

Error interrupted() {
    return {"interrupted", "", "interrupted"};
}

/// Why waiting ends, or nothing: a Controller is there.
class Patience {
  public:
    Patience(StreamBus& bus, const RemoteOptions& options) : bus_(bus), o_(options), seen_ms_(bus.now_ms()) {}

    Result<> wait(const RemoteRun::GoOn& go_on) {
        bus_.wait(kTurn_ms);
        if (!go_on()) return interrupted();
        if (std::optional<Error> refusal = bus_.refusal()) return *refusal;
        if (const std::optional<RunOver> ended = bus_.run_end_after_turn())
            return Error{"the run is over: " + ended->reason, "connect to another one", "run-over"};
        const std::int64_t now = bus_.now_ms();
        if (bus_.present(kControllerAddress)) seen_ms_ = now;
        if (static_cast<double>(now - seen_ms_) > 1e3 * o_.patience_s) return no_controller(o_);
        return Ok{};
    }

  private:
    StreamBus& bus_;
    const RemoteOptions& o_;
    std::int64_t seen_ms_;
};

}  // namespace

RemoteRun::RemoteRun(std::shared_ptr<const Model> model, const RemoteOptions& options,
                     std::unique_ptr<StreamBus> bus, std::unique_ptr<BusClient> client)
    : RunAccess(std::move(model)), options_(options), bus_(std::move(bus)), client_(std::move(client)) {}
RemoteRun::~RemoteRun() = default;

Tick RemoteRun::tick() const {
    return client_->tick();
}

std::uint64_t RemoteRun::seed() const {
    return client_->seed();
}

const std::vector<RobotState>& RemoteRun::states() const {
    return client_->states();
}

std::vector<std::string> RemoteRun::take_refusals() {
    return client_->take_refusals();
}

void RemoteRun::advance() {
    const Tick before = tick();
    client_->advance(*bus_);
    if (tick() != before) changed();
}

Result<std::unique_ptr<RemoteRun>> RemoteRun::connect(const RemoteOptions& options, const GoOn& go_on) {
    Result<std::unique_ptr<StreamBus>> opened = StreamBus::join(options.network, "client", options.name);
    if (!opened) return opened.error();
    return join(options, std::move(opened).value(), go_on);
}

Result<std::unique_ptr<RemoteRun>> RemoteRun::join(const RemoteOptions& options,
                                                   std::unique_ptr<StreamBus> bus, const GoOn& go_on) {
    const Address self = client_address();
    Patience patience(*bus, options);
    ModelPull pull;
    for (pull.advance(*bus, self, kResend_ms); !pull.model(); pull.advance(*bus, self, kResend_ms))
        if (Result<> waited = patience.wait(go_on); !waited) return waited.error();
    if (!pull.model()->ok()) return pull.model()->error();
    const std::shared_ptr<const Model> model = pull.model()->value();
    BusClientOptions wanted;
    wanted.name = options.name;
    wanted.period = options.period;
    wanted.latency = options.latency;
    auto client = std::make_unique<BusClient>(model, self, std::move(wanted));
    std::unique_ptr<RemoteRun> run(new RemoteRun(model, options, std::move(bus), std::move(client)));
    const auto wait = [&bus = *run->bus_, go_on]() -> Result<> {
        bus.wait(kTurn_ms);
        return go_on() ? Result<>(Ok{}) : Result<>(interrupted());
    };
    run->set_visuals(fetched_visuals({*run->bus_, &client_address, wait}), options.threads);
    if (Result<> shown = run->wait_until([&] { return run->client_->observing(); }, go_on); !shown)
        return shown.error();
    run->until_ = run->tick();
    run->forget_received();
    return run;
}

Result<> RemoteRun::wait_until(const std::function<bool()>& done, const GoOn& go_on, bool even_outdated) {
    Patience patience(*bus_, options_);
    for (;;) {
        advance();
        if (done()) return Ok{};
        if (!client_->over().empty())
            return Error{"the run is over: " + client_->over(), "connect to another one", "run-over"};
        if (client_->outdated() && !even_outdated)
            return Error{"the world of the run has changed", "connect again", "changed-world"};
        if (!client_->refusal().empty())
            return error_of_text("the run refuses the Client '" + options_.name + "': ", client_->refusal(),
                                 "connect again", "refused");
        if (Result<> waited = patience.wait(go_on); !waited) return waited;
    }
}

Result<> RemoteRun::step(Tick ticks, const GoOn& go_on) {
    if (ticks < 0 || ticks % options_.period != 0)
        return Error{"a step of " + std::to_string(ticks) + " ticks, where the run is observed every " +
                         std::to_string(options_.period),
                     "give a multiple of it, or connect with another period", "bad-ticks"};
    until_ = tick() + ticks;
    return finish(go_on);
}

Result<> RemoteRun::finish(const GoOn& go_on) {
    while (tick() < until_) {
        if (client_->observing()) client_->answer(*bus_);
        if (Result<> shown = wait_until([&] { return client_->observing(); }, go_on); !shown) return shown;
        changed();
    }
    return Ok{};
}

Result<> RemoteRun::order(std::vector<Order> orders) {
    for (Order& order : orders) {
        order.apply_at = tick();
        if (Result<> checked = check_order(model(), order); !checked) return checked;
    }
    for (const Order& order : orders)
        if (Result<> given = client_->order(order.robot, order.action); !given) return given;
    return Ok{};
}

Result<> RemoteRun::change(RobotId robot, const Action& action) {
    return order({Order{0, ClientId(0U), 0, robot, action}});
}

Result<std::optional<ControlOutcome>> RemoteRun::ask(const ControlAction& action, const GoOn& go_on,
                                                     bool even_outdated) {
    client_->control(action);
    std::vector<ControlAnswer> answers;
    const auto answered = [&] {
        answers = client_->take_control_answers();
        return !answers.empty() || (even_outdated && client_->outdated());
    };
    if (Result<> waited = wait_until(answered, go_on, even_outdated); !waited) return waited.error();
    if (answers.empty()) return std::optional<ControlOutcome>();
    return std::optional(std::move(answers.back().outcome));
}

Result<ControlOutcome> RemoteRun::control(const ControlAction& action, const GoOn& go_on) {
    Result<std::optional<ControlOutcome>> outcome = ask(action, go_on, false);
    if (!outcome) return outcome.error();
    return *std::move(outcome.value());
}

Result<std::string> RemoteRun::change_run(const ControlAction& action, const GoOn& go_on) {
    const std::size_t welcomes = client_->welcomes();
    // A run whose Model was changed may wait for this Client before it answers: it is there again by
    // renewed().
    const Result<std::optional<ControlOutcome>> answer = ask(action, go_on, true);
    if (!answer) return answer.error();
    if (!answer.value()) return std::string();
    const ControlOutcome& outcome = *answer.value();
    if (const auto* refused = std::get_if<ControlRefused>(&outcome)) return refused->error();
    const auto goes_on = [&] {
        return client_->outdated() || (client_->welcomes() > welcomes && client_->observing());
    };
    if (Result<> waited = wait_until(goes_on, go_on, true); !waited) return waited.error();
    until_ = tick();
    changed();
    forget_received();
    const auto* done = std::get_if<ControlDone>(&outcome);
    return done ? done->text : std::string();
}

bool RemoteRun::outdated() const {
    return client_->outdated();
}

Result<std::unique_ptr<RemoteRun>> RemoteRun::renewed(const GoOn& go_on) {
    return join(options_, std::move(bus_), go_on);
}

void RemoteRun::leave() {
    const std::int64_t begin_ms = bus_->now_ms();
    if (client_->over().empty() && client_->joined()) client_->leave(*bus_);
    while (client_->over().empty() && !client_->heard() && bus_->now_ms() - begin_ms < kLeave_ms) {
        bus_->wait(kTurn_ms);
        client_->advance(*bus_);
    }
    bus_->flush(500);
}

}  // namespace roboss
