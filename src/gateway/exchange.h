// Exchange: what the run's thread and the gateway's thread hand each other. Neither ever waits for the other:
// of what is shown only the latest is kept, and while nobody watches the run's side costs one atomic read a
// turn.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "gateway/page_request.h"
#include "model/model.h"
#include "scene/scene_file.h"
#include "wire/message.h"
#include "wire/view_state.h"

namespace roboss {

/// What all pages together want to see.
struct WatchRequest {
    bool anyone = false;
    std::uint32_t interval_ms = 0;  // between two views; 0: none
    std::vector<RobotId> robots;    // whose exact states are wanted, ascending
    bool contacts = false, radio = false, bounds = false, groups = false, profile = false;
    bool cameras = false;  // pictures of cameras: the visuals are needed
    friend bool operator==(const WatchRequest&, const WatchRequest&) = default;
};

/// Whether everybody's exact state is had when this robot is looked at closely: its lasers see all, and in a
/// small world it costs little.
bool needs_everybody(const Model& model, RobotId robot);

/// A control request or an order of a page.
struct PageCall {
    std::uint64_t page = 0;
    std::int64_t id = 0;
    std::variant<ControlAction, PageOrder> what;
};

/// A Model and what it looks like; never changed.
struct ShownScene {
    std::uint32_t number = 0;
    std::shared_ptr<const Model> model;
    SceneFile file;
    ViewLayout layout;
};

/// The visuals of a scene's Model for cameras, as the Controller sends them (visuals/visual_fetch.h).
struct ShownVisuals {
    std::uint32_t scene = 0;
    std::shared_ptr<const std::vector<std::uint8_t>> bytes;
};

/// A line for pages. Its text is made where it is sent from, so that the run does not pay for it.
struct Line {
    enum class To { kPage, kAll, kStatus, kGroups, kBounds, kProfile, kTimeline };
    To to = To::kAll;
    std::uint64_t page = 0;
    bool may_miss = false;  // by a page that is slow
    std::function<std::string()> make;
    std::vector<std::uint8_t> preview{};  // a State message that follows the line; of kPage only
};

/// What the gateway's thread has not seen yet.
struct News {
    std::shared_ptr<const ShownScene> scene;  // nullptr: as before
    std::optional<ShownVisuals> visuals;      // none: as before
    std::vector<ViewStates> views;            // the latest of each sender
    std::vector<StateBlock> exact;            // of one tick
    std::vector<Line> lines;
};

class Exchange {
  public:
    // --- the gateway's side
    /// Called once from the run's thread when there is news after take_news().
    void set_bell(std::function<void()> bell);
    News take_news();
    void watch(const WatchRequest& request);
    /// False: too many are waiting.
    bool call(PageCall call);

    // --- the run's side
    /// Cheap; true if a page asked for anything since the last take.
    bool stirred() const { return stirred_.load(std::memory_order_acquire); }
    WatchRequest take_watch_request();
    std::vector<PageCall> take_calls();
    void show(std::shared_ptr<const ShownScene> scene);
    void show(ShownVisuals visuals);
    void show(const Address& sender, ViewStates views);
    void show(StateBlock exact);
    void send(Line line);

  private:
    void ring(std::unique_lock<std::mutex>& lock);

    std::mutex mutex_;
    std::function<void()> bell_;
    bool rung_ = false;
    std::atomic<bool> stirred_ = false;
    WatchRequest watch_request_;
    std::vector<PageCall> calls_;
    std::shared_ptr<const ShownScene> scene_;
    std::optional<ShownVisuals> visuals_;
    std::map<Address, ViewStates> views_;
    std::vector<StateBlock> exact_;
    std::vector<Line> lines_;
};

}  // namespace roboss
