// BusClient: a Client over a Bus, the same in this process and elsewhere. It joins, fetches the exact state
// of each observation from whoever holds it, and sends one reply to each, again and again until the
// Controller acknowledges it.
#pragma once

#include <deque>
#include <map>
#include <memory>

#include "bus/bus.h"
#include "bus/state_pull.h"
#include "client/client.h"
#include "client/refusals.h"
#include "render/camera_scene.h"

namespace roboss {

struct BusClientOptions {
    std::string name = "client";
    Tick period = 1, latency = 1;  // ticks
    bool synchronous = true;
    bool observer = false;         // comes and goes: the run never waits for it
    std::int64_t resend_ms = 100;  // what is not acknowledged; of a free-running Client sooner at first
};

class BusClient : public Client {
  public:
    BusClient(std::shared_ptr<const Model> model, const Address& self, BusClientOptions options);

    const Model& model() const override { return *model_; }
    Tick tick() const override { return tick_; }
    const RobotState& state(RobotId robot) const override {
        (void)known(robot);
        return states_[robot.index()];
    }
    /// All states at tick(), by RobotId.
    const std::vector<RobotState>& states() const { return states_; }
    std::uint64_t seed() const override { return seed_; }
    Result<> order(RobotId robot, const Action& action) override;
    void control(ControlAction request) override;
    std::vector<ControlAnswer> take_control_answers() override { return std::exchange(answers_, {}); }

    /// Handles the messages received and requests what is missing. Never waits.
    void advance(Bus& bus);
    /// Sets the visuals that cameras render. Before, cameras cannot be read.
    void set_visuals(render::VisualsOf visuals) { visuals_ = std::move(visuals); }
    /// A new observation is shown and waits for an answer().
    bool observing() const { return observing_; }
    /// Sends the reply to the observation shown, with the orders given since.
    void answer(Bus& bus);
    /// A free-running Client sends the orders given so far at once, having seen the world at
    /// `observed`.
    void send(Bus& bus, Tick observed);
    /// Leaves the run. `failure`: why, if the program failed; it ends the run.
    void leave(Bus& bus, const std::string& failure = {});

    bool joined() const { return id_.valid(); }
    /// How often it was welcomed: again after each restart, reset and rewind of the run.
    std::size_t welcomes() const { return welcomes_; }
    bool synchronous() const { return options_.synchronous; }
    /// Tick of the next observation of a synchronous Client.
    Tick expected() const { return expected_; }
    /// The Controller has acknowledged every reply.
    bool heard() const { return replies_.empty() && !bye_; }
    /// Number of the last reply that was given, and of the last one that was acknowledged.
    std::uint64_t last_reply() const { return reply_number_; }
    std::uint64_t acknowledged() const { return acknowledged_; }
    /// Why the run has ended; empty: it has not.
    const std::string& over() const { return over_; }
    /// It has ended because it could not go on.
    bool failed() const { return failed_; }
    /// The text of the Error with which the Controller refused it; empty: it has not. After a refusal it does
    /// not ask again.
    const std::string& refusal() const { return refusal_; }
    /// The run has another Model than this one: make another BusClient with that.
    bool outdated() const { return outdated_; }
    /// Orders that were refused since the last call, by the Controller and here. Each text once.
    std::vector<std::string> take_refusals();
    /// Those by the Controller alone; take_refusals() then has the others.
    std::vector<RefusedOrder> take_refused_orders() { return std::exchange(refused_orders_, {}); }

  protected:
    RayScene& ray_scene() override;
    Result<const CameraScene*> camera_scene() override;
    Tick observed_before() const override { return before_; }

  private:
    Error report_refusal(Error error) override;
    /// Sent again and again, at growing intervals, until it is acknowledged.
    struct Resent {
        static constexpr std::int64_t kLongAgo = -1'000'000'000;
        std::int64_t sent_ms = kLongAgo, wait_ms = 0;
        int times = 0;
        /// Whether it is to be sent now; then it counts as sent.
        bool due(std::int64_t now_ms, std::int64_t first_ms, std::int64_t most_ms);
    };
    struct OpenReply {
        ClientReply reply;
        Resent resent;
    };

    void handle(Envelope& envelope);
    void take_ack(const ReplyAck& ack);
    void take_welcome(const ClientWelcome& welcome);
    void join_again();
    void heard_up_to(std::uint64_t number);
    void take_observation(Observation& observation);
    void pull_next();
    void show();
    void resend(Bus& bus);
    void send_open_replies(Bus& bus, std::int64_t now_ms);
    std::int64_t first_resend_ms() const;
    ClientHello hello() const;

    std::shared_ptr<const Model> model_;
    Address self_;
    BusClientOptions options_;
    ClientId id_;
    bool was_here_ = false;  // with an earlier Controller of this run
    std::uint64_t seed_ = 0;

    Tick tick_ = -1;
    Tick before_ = 0;  // of the observation before, also if an earlier Client of this name had it
    std::vector<RobotState> states_, coming_;
    bool observing_ = false;
    StatePull pull_;
    std::map<Tick, std::vector<Holding>> offers_;  // observations announced and not shown yet
    Tick expected_ = 0;                            // the next observation of a synchronous Client

    std::vector<ClientOrder> orders_;  // for the next reply
    std::uint64_t sequence_ = 0, reply_number_ = 0, acknowledged_ = 0;
    std::deque<OpenReply> replies_;  // not known to have arrived
    std::optional<ClientBye> bye_;
    Resent hello_resent_, bye_resent_;
    static constexpr std::int64_t kLongAgo = Resent::kLongAgo;
    std::int64_t sent_ms_ = kLongAgo;             // when the last reply was
    std::int64_t requested_ms_ = kLongAgo;        // when the first of `requests_` was sent
    static constexpr std::int64_t kAskEvery = 5;  // resend times
    bool outdated_ = false;
    std::size_t welcomes_ = 0;
    std::uint64_t request_ = 0;
    std::deque<ControlRequest> requests_;  // the first is sent again until it is answered, then the next
    std::vector<ControlAnswer> answers_;
    Refusals refusals_;
    std::vector<RefusedOrder> refused_orders_;
    std::uint64_t refused_up_to_ = 0;  // sequence number of the last refusal taken
    std::string over_, refusal_;
    bool failed_ = false;

    std::unique_ptr<RayScene> scene_;
    Tick scene_tick_ = -1;
    render::VisualsOf visuals_;
    std::unique_ptr<CameraScene> cameras_;
    Tick cameras_tick_ = -1;
    std::vector<Envelope> inbox_;
};

}  // namespace roboss
