// RunWatcher: the gateway's side towards the run. It fetches Model and scene, asks for views and exact states
// of what pages want, and brings their words and orders; all over the Bus, so it is the same in the run's
// process and elsewhere. A role: no thread, clock or socket.
#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/model_pull.h"
#include "bus/whole_pull.h"
#include "client/bus_client.h"
#include "gateway/exchange.h"

namespace roboss {

class RunWatcher {
  public:
    RunWatcher(std::shared_ptr<Exchange> exchange, std::function<Address()> new_address)
        : exchange_(std::move(exchange)), new_address_(std::move(new_address)) {}

    /// Handles what has come and asks for what is wanted. Never waits.
    void advance(Bus& bus);
    const std::string& over() const { return over_; }
    /// What went wrong, one line each, since the last call.
    std::vector<std::string> take_notices() { return std::exchange(notices_, {}); }

  private:
    /// Requests to the Controller, one after the other, each sent until it is answered.
    struct Requester {
        struct Question {
            ControlAction action;
            std::function<void(const ControlOutcome&)> answered;
        };
        Address self;
        std::uint64_t number = 0;
        std::deque<Question> questions;
        std::optional<std::int64_t> asked_ms;
        std::vector<Envelope> inbox;
        void advance(Bus& bus);
    };
    /// The newest preview that a page has requested; each page asks from an address of its own.
    struct PreviewAsk {
        Address self;
        std::uint64_t number = 0;  // of its requests
        std::int64_t id = 0;       // of the page's message
        std::optional<PreviewRun> wanted;
        std::optional<std::int64_t> asked_ms;
    };
    struct OpenOrder {
        std::uint64_t page = 0, sequence = 0, reply = 0;
        std::int64_t id = 0;
    };
    struct Pulls {
        Address self;
        ModelPull model;
        WholePull scene{Whole::kScene};
    };
    /// Of the visuals of scene_.
    struct VisualPull {
        Address self;
        WholePull pull{Whole::kVisuals};
    };

    void rest(Bus& bus);
    void fetch(Bus& bus);
    void finish_fetch(std::int64_t now_ms);
    void fetch_visuals(Bus& bus);
    void handle(Bus& bus, Envelope& envelope);
    void look(Bus& bus);
    void poll(std::int64_t now_ms);
    void show_status(const RunStatus& status, std::int64_t asked_at_ms);
    void show_groups(const RobotGroups& groups, const ShownScene& scene);
    void show_bounds(const RobotBounds& bounds, const ShownScene& scene);
    void show_profile(const ControlOutcome& outcome);
    void show_timeline(const RunTimeline& timeline);
    void preview(std::uint64_t page, std::int64_t id, const PreviewRun& wanted);
    void serve_previews(Bus& bus);
    void serve(Bus& bus, PageCall& call);
    void order(Bus& bus, const PageCall& call, const PageOrder& order);
    void serve_orders(Bus& bus);
    void drop_client();
    void answer(std::uint64_t page, std::int64_t id, const ControlOutcome& outcome);
    void answer(std::uint64_t page, std::int64_t id, const RunPreview& preview);
    void answer(std::uint64_t page, std::int64_t id, bool done, std::string text, std::string code = {});

    std::shared_ptr<Exchange> exchange_;
    std::function<Address()> new_address_;
    WatchRequest watch_request_;
    std::optional<Address> self_;  // for views
    std::shared_ptr<const ShownScene> scene_;
    std::uint32_t scenes_ = 0;
    std::unique_ptr<Pulls> pulls_;
    std::unique_ptr<VisualPull> visual_pull_;
    std::uint32_t visuals_ = 0;  // number of the scene whose visuals are here
    bool outdated_ = true;
    std::int64_t fetch_from_ms_ = std::numeric_limits<std::int64_t>::min();  // not before, after a failure
    Tick tick_ = 0;                                                          // of the last view

    std::optional<std::int64_t> sent_ms_;  // when the last ViewRequest was
    bool watch_request_changed_ = false;
    Requester polls_, control_;
    std::map<std::uint64_t, PreviewAsk> previews_;  // by page
    std::uint64_t timeline_ = 0;                    // RunTimeline::serial that was shown last
    std::optional<std::int64_t> status_ms_, groups_ms_, bounds_ms_, profile_ms_;
    double status_time_s_ = 0;
    std::int64_t status_at_ms_ = 0;

    std::unique_ptr<BusClient> client_;  // for orders; made by the first
    std::uint64_t sequence_ = 0;
    std::deque<OpenOrder> orders_;
    std::vector<std::string> notices_;
    std::string over_;
    std::vector<Envelope> inbox_;
};

}  // namespace roboss
