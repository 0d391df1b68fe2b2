// Fetching, watching, asking.
#include "gateway/run_watcher.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "gateway/page_order.h"
#include "gateway/run_json.h"
#include "wire/orders_only.h"
#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kAgain_ms = 250;         // what is not answered is asked again
constexpr std::int64_t kFetchAgain_ms = 1'000;  // the Model, after it could not be read or has changed
constexpr std::int64_t kWatchAgain_ms = 1'000;
constexpr std::int64_t kPreviewAgain_ms = 1'000;  // longer than a preview takes
constexpr std::int64_t kStatusEvery_ms = 500, kGroupsEvery_ms = 500, kBoundsEvery_ms = 250,
                       kProfileEvery_ms = 500;
constexpr std::uint32_t kExactEvery_ms = 100;
constexpr std::size_t kQuestionsMax = 200;
constexpr std::size_t kPreviewsMax = 32;  // pages whose requests are remembered

/// Contacts and radio links need everybody's state too.
ViewRequest request_of(const WatchRequest& wanted, const Model& model) {
    ViewRequest request{model.hash, wanted.interval_ms, 0, wanted.contacts || wanted.radio, {}};
    for (const RobotId robot : wanted.robots) {
        if (robot.index() >= model.robots.size()) continue;
        request.exact.push_back(robot);
        request.exact_all = request.exact_all || needs_everybody(model, robot);
    }
    if (request.exact_all) request.exact.clear();
    if (request.exact_all || !request.exact.empty()) request.exact_interval_ms = kExactEvery_ms;
    return request;
}

std::string dumped(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string groups_line(const RobotGroups& groups, std::uint32_t scene) {
    return dumped(
        {{"type", "groups"}, {"scene", scene}, {"simulator", groups.simulator}, {"island", groups.island}});
}

/// A State message with the robots that existed then.
std::vector<std::uint8_t> preview_message(const RunPreview& preview, const ShownScene& scene) {
    namespace protocol = viewer_protocol;
    std::uint32_t robots = 0;
    std::size_t offset = 0;
    while (const std::optional<RobotId> robot = scene.layout.entry_at(preview.entries, offset)) {
        offset += scene.layout.bytes_of(*robot);
        ++robots;
    }
    std::vector<std::uint8_t> bytes(protocol::kStateBytes + offset);
    std::copy_n(preview.entries.begin(), offset, bytes.begin() + protocol::kStateBytes);
    const auto put = [&](std::size_t at, const auto& value) {
        std::memcpy(bytes.data() + at, &value, sizeof(value));
    };
    const bool whole = robots == scene.layout.robots();
    put(protocol::kStateKindAt, protocol::kStateKind);
    put(protocol::kStateFlagsAt,
        static_cast<std::uint8_t>(protocol::kFlagPreview | (whole ? protocol::kFlagWhole : 0)));
    put(protocol::kStateSceneAt, scene.number);
    put(protocol::kStateTickAt, static_cast<double>(preview.tick));
    put(protocol::kStateTimeAt, preview.time_s);
    put(protocol::kStateRobotsAt, robots);
    return bytes;
}

std::string bounds_line(const RobotBounds& bounds, Tick tick, std::uint32_t scene) {
    Json list = Json::array();
    for (std::size_t r = 0; r < bounds.boxes.size(); ++r) {
        const Box32& box = bounds.boxes[r];
        list.push_back({{"robot", r},
                        {"box", {box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]}}});
    }
    return dumped({{"type", "overlay"}, {"scene", scene}, {"tick", tick}, {"bounds", std::move(list)}});
}

}  // namespace

void RunWatcher::Requester::advance(Bus& bus) {
    if (questions.empty()) return;
    bus.drain(self, inbox);
    for (const Envelope& envelope : inbox) {
        const auto* reply = std::get_if<ControlReply>(&envelope.message);
        if (reply == nullptr || reply->number != number || !asked_ms || questions.empty()) continue;
        const Question question = std::move(questions.front());
        questions.pop_front();
        asked_ms.reset();
        question.answered(reply->outcome);
    }
    if (questions.empty()) return;
    const std::int64_t now = bus.now_ms();
    if (!asked_ms) ++number;
    if (asked_ms && now - *asked_ms < kAgain_ms) return;
    asked_ms = now;
    bus.send(self, kControllerAddress, ControlRequest{number, questions.front().action});
}

void RunWatcher::advance(Bus& bus) {
    if (exchange_->stirred()) {
        WatchRequest request = exchange_->take_watch_request();
        watch_request_changed_ = watch_request_changed_ || !(request == watch_request_);
        watch_request_ = std::move(request);
        for (PageCall& call : exchange_->take_calls()) serve(bus, call);
    }
    if (!watch_request_.anyone) return rest(bus);
    if (!self_) self_ = new_address_(), polls_.self = new_address_(), control_.self = new_address_();
    if (outdated_) fetch(bus);
    bus.drain(*self_, inbox_);
    for (Envelope& envelope : inbox_) handle(bus, envelope);
    if (scene_ && !outdated_) look(bus), fetch_visuals(bus);
    poll(bus.now_ms());
    polls_.advance(bus);
    control_.advance(bus);
    serve_previews(bus);
    serve_orders(bus);
}

/// Nobody watches: what was begun is brought to its end, and nothing else is done.
void RunWatcher::rest(Bus& bus) {
    if (!control_.questions.empty()) control_.advance(bus);
    if (!client_) return;
    serve_orders(bus);
    if (client_ && orders_.empty()) {
        if (client_->joined()) client_->leave(bus);
        client_.reset();
    }
}

void RunWatcher::fetch(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    if (now < fetch_from_ms_) return;
    if (!pulls_) {
        pulls_ = std::make_unique<Pulls>();
        pulls_->self = new_address_();
    }
    if (!pulls_->model.model()) {
        pulls_->model.advance(bus, pulls_->self, kAgain_ms);
    } else {
        pulls_->scene.advance(bus, pulls_->self, kAgain_ms);
    }
    if (pulls_->scene.complete()) finish_fetch(now);
}

void RunWatcher::finish_fetch(std::int64_t now_ms) {
    fetch_from_ms_ = now_ms + kFetchAgain_ms;
    const std::unique_ptr<Pulls> pulls = std::move(pulls_);
    const ModelPull::Outcome& outcome = *pulls->model.model();
    if (!outcome) return notices_.push_back("the Model cannot be read: " + outcome.error().text());
    const std::shared_ptr<const Model>& model = outcome.value();
    SceneFile file;
    if (pulls->scene.bytes().empty()) {  // the Controller does not know how it looks
        file = scene_file(make_scene(*model, nullptr), *model, 0);
    } else {
        Result<SceneFile> decoded = decode_scene_file(pulls->scene.bytes());
        if (!decoded) return notices_.push_back(decoded.error().text());
        file = std::move(decoded).value();
    }
    if (file.model_hash != model->hash) return;  // it changed in between: once more
    scene_ =
        std::make_shared<const ShownScene>(ShownScene{++scenes_, model, std::move(file), ViewLayout(*model)});
    outdated_ = false;
    visual_pull_.reset();
    fetch_from_ms_ = now_ms;
    sent_ms_.reset();
    drop_client();
    timeline_ = 0;  // it may be another run
    exchange_->show(scene_);
}

/// When the first page looks through a camera. They are decoded where pictures are rendered.
void RunWatcher::fetch_visuals(Bus& bus) {
    if (!watch_request_.cameras || visuals_ == scene_->number) return;
    if (!visual_pull_) {
        visual_pull_ = std::make_unique<VisualPull>();
        visual_pull_->self = new_address_();
    }
    visual_pull_->pull.advance(bus, visual_pull_->self, kAgain_ms);
    if (!visual_pull_->pull.complete()) return;
    visuals_ = scene_->number;
    exchange_->show(ShownVisuals{
        visuals_, std::make_shared<const std::vector<std::uint8_t>>(visual_pull_->pull.bytes())});
    visual_pull_.reset();
}

void RunWatcher::handle(Bus&, Envelope& envelope) {
    if (auto* views = std::get_if<ViewStates>(&envelope.message)) {
        if (outdated_ || views->model_hash != scene_->model->hash) return;
        tick_ = views->tick;
        exchange_->show(envelope.from, std::move(*views));
    } else if (auto* exact = std::get_if<StateReply>(&envelope.message)) {
        if (!outdated_) exchange_->show(std::move(exact->states));
    } else if (const auto* changed = std::get_if<ModelChanged>(&envelope.message)) {
        outdated_ = outdated_ || changed->model_hash != scene_->model->hash;
    } else if (const auto* over = std::get_if<RunOver>(&envelope.message)) {
        over_ = over->reason;
        Line line;
        line.make = [over = *over] { return over_line(over); };
        exchange_->send(std::move(line));
    }
}

void RunWatcher::look(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    if (sent_ms_ && now - *sent_ms_ < kWatchAgain_ms && !watch_request_changed_) return;
    watch_request_changed_ = false;
    sent_ms_ = now;
    bus.send(*self_, kControllerAddress, request_of(watch_request_, *scene_->model));
}

void RunWatcher::poll(std::int64_t now_ms) {
    const auto due = [now_ms](std::optional<std::int64_t>& last_ms, std::int64_t every_ms) {
        if (last_ms && now_ms - *last_ms < every_ms) return false;
        last_ms = now_ms;
        return true;
    };
    if (polls_.questions.size() > 3) return;  // no answer yet
    if (due(status_ms_, kStatusEvery_ms))
        polls_.questions.push_back({GetStatus{}, [this, now_ms](const ControlOutcome& outcome) {
                                        if (const auto* status = std::get_if<RunStatus>(&outcome))
                                            show_status(*status, now_ms);
                                    }});
    if (watch_request_.profile && due(profile_ms_, kProfileEvery_ms))
        polls_.questions.push_back(
            {GetProfile{}, [this](const ControlOutcome& outcome) { show_profile(outcome); }});
    if (!scene_ || outdated_) return;
    if (watch_request_.groups && due(groups_ms_, kGroupsEvery_ms))
        polls_.questions.push_back({GetGroups{}, [this, scene = scene_](const ControlOutcome& outcome) {
                                        if (const auto* groups = std::get_if<RobotGroups>(&outcome))
                                            show_groups(*groups, *scene);
                                    }});
    if (watch_request_.bounds && due(bounds_ms_, kBoundsEvery_ms))
        polls_.questions.push_back({GetBounds{}, [this, scene = scene_](const ControlOutcome& outcome) {
                                        if (const auto* bounds = std::get_if<RobotBounds>(&outcome))
                                            show_bounds(*bounds, *scene);
                                    }});
}

void RunWatcher::show_status(const RunStatus& status, std::int64_t asked_at_ms) {
    const double wall_s = 1e-3 * static_cast<double>(asked_at_ms - std::exchange(status_at_ms_, asked_at_ms));
    const double simulated_s = status.time_s - std::exchange(status_time_s_, status.time_s);
    if (status.timeline != timeline_ && status.timeline != 0)
        polls_.questions.push_back({GetTimeline{}, [this](const ControlOutcome& outcome) {
                                        if (const auto* timeline = std::get_if<RunTimeline>(&outcome))
                                            show_timeline(*timeline);
                                    }});
    const bool known = wall_s > 0 && wall_s < 10 && simulated_s >= 0;
    exchange_->send({Line::To::kStatus, 0, true, [status, factor = known ? simulated_s / wall_s : 0.0]() {
                         return status_line(status, factor);
                     }});
}

void RunWatcher::show_timeline(const RunTimeline& timeline) {
    timeline_ = timeline.serial;
    exchange_->send({Line::To::kTimeline, 0, false, [timeline]() { return timeline_line(timeline); }});
}

/// A page has one request under way at most: a newer one replaces it.
void RunWatcher::preview(std::uint64_t page, std::int64_t id, const PreviewRun& wanted) {
    if (!previews_.contains(page)) {
        if (previews_.size() >= kPreviewsMax) previews_.erase(previews_.begin());  // of the oldest page
        previews_[page].self = new_address_();
    }
    PreviewAsk& ask = previews_[page];
    if (ask.wanted) answer(page, ask.id, false, "a newer preview was requested", "superseded");
    ++ask.number;
    ask.id = id, ask.wanted = wanted, ask.asked_ms.reset();
}

void RunWatcher::serve_previews(Bus& bus) {
    const std::int64_t now = bus.now_ms();
    for (auto& [page, ask] : previews_) {
        if (!ask.wanted) continue;
        bus.drain(ask.self, inbox_);
        for (const Envelope& envelope : inbox_) {
            const auto* reply = std::get_if<ControlReply>(&envelope.message);
            if (reply == nullptr || reply->number != ask.number || !ask.wanted) continue;
            ask.wanted.reset();
            answer(page, ask.id, reply->outcome);
        }
        if (!ask.wanted || (ask.asked_ms && now - *ask.asked_ms < kPreviewAgain_ms)) continue;
        ask.asked_ms = now;
        bus.send(ask.self, kControllerAddress, ControlRequest{ask.number, *ask.wanted});
    }
}

void RunWatcher::show_groups(const RobotGroups& groups, const ShownScene& scene) {
    if (groups.model_hash != scene.model->hash) return;
    exchange_->send({Line::To::kGroups, 0, true,
                     [groups, number = scene.number]() { return groups_line(groups, number); }});
}

void RunWatcher::show_bounds(const RobotBounds& bounds, const ShownScene& scene) {
    if (bounds.model_hash != scene.model->hash) return;
    exchange_->send({Line::To::kBounds, 0, true, [bounds, tick = tick_, number = scene.number]() {
                         return bounds_line(bounds, tick, number);
                     }});
}

void RunWatcher::show_profile(const ControlOutcome& outcome) {
    Line line{Line::To::kProfile, 0, true, {}};
    if (const auto* profile = std::get_if<RunProfile>(&outcome))
        line.make = [profile = *profile]() { return profile_line(profile); };
    else if (const auto* refused = std::get_if<ControlRefused>(&outcome))
        line.make = [error = refused->error()]() { return profile_line(error); };
    if (line.make) exchange_->send(std::move(line));
}

void RunWatcher::answer(std::uint64_t page, std::int64_t id, const ControlOutcome& outcome) {
    if (const auto* done = std::get_if<ControlDone>(&outcome)) return answer(page, id, true, done->text);
    if (const auto* refused = std::get_if<ControlRefused>(&outcome))
        return answer(page, id, false, refused->error().text(), refused->code);
    if (const auto* status = std::get_if<RunStatus>(&outcome))
        return answer(page, id, true, status_json(*status));
    if (const auto* groups = std::get_if<RobotGroups>(&outcome))
        return answer(page, id, true, groups_json(*groups));
    if (const auto* profile = std::get_if<RunProfile>(&outcome))
        return answer(page, id, true, profile_json(*profile));
    if (const auto* timeline = std::get_if<RunTimeline>(&outcome))
        return answer(page, id, true, timeline_json(*timeline));
    if (const auto* preview = std::get_if<RunPreview>(&outcome)) return answer(page, id, *preview);
    answer(page, id, true, bounds_json(std::get<RobotBounds>(outcome)));
}

void RunWatcher::answer(std::uint64_t page, std::int64_t id, const RunPreview& preview) {
    if (!scene_ || outdated_ || preview.model_hash != scene_->model->hash)
        return answer(page, id, false, "the scene has changed in the meantime: ask again", "scene-changed");
    exchange_->send({Line::To::kPage, page, false, [id, preview]() { return preview_line(preview, id); },
                     preview_message(preview, *scene_)});
}

void RunWatcher::answer(std::uint64_t page, std::int64_t id, bool done, std::string text, std::string code) {
    exchange_->send(
        {Line::To::kPage, page, false, [id, done, text = std::move(text), code = std::move(code)]() {
             Json line{{"type", "answer"}, {"id", id}, {"done", done}, {"text", text}};
             if (!code.empty()) line["code"] = code;
             return dumped(line);
         }});
}

void RunWatcher::serve(Bus& bus, PageCall& call) {
    if (const auto* page_order = std::get_if<PageOrder>(&call.what)) return order(bus, call, *page_order);
    if (const auto* wanted = std::get_if<PreviewRun>(&std::get<ControlAction>(call.what)))
        return preview(call.page, call.id, *wanted);
    if (control_.questions.size() >= kQuestionsMax)
        return answer(call.page, call.id, false, "too many requests are waiting for replies", "busy");
    control_.questions.push_back({std::move(std::get<ControlAction>(call.what)),
                                  [this, page = call.page, id = call.id](const ControlOutcome& outcome) {
                                      answer(page, id, outcome);
                                  }});
}

void RunWatcher::order(Bus& bus, const PageCall& call, const PageOrder& wanted) {
    if (!scene_ || outdated_)
        return answer(call.page, call.id, false, "the scene has changed and is being fetched");
    if (!client_) {
        BusClientOptions options;
        options.name = "viewer";
        options.period = options.latency = kOrdersOnly;
        options.synchronous = false;
        options.observer = true;
        client_ = std::make_unique<BusClient>(scene_->model, new_address_(), options);
        sequence_ = 0;
    }
    const Result<> given = give(*client_, wanted);
    if (!given) return answer(call.page, call.id, ControlRefused(given.error()));
    client_->send(bus, tick_);
    orders_.push_back({call.page, ++sequence_, client_->last_reply(), call.id});
}

/// It knows a world that is no more; the next order makes another.
void RunWatcher::drop_client() {
    for (const OpenOrder& o : std::exchange(orders_, {}))
        answer(o.page, o.id, false, "the world has changed in the meantime");
    client_.reset();
}

void RunWatcher::serve_orders(Bus& bus) {
    if (!client_) return;
    client_->advance(bus);
    for (const RefusedOrder& refused : client_->take_refused_orders()) {
        const auto found = std::ranges::find(orders_, refused.sequence, &OpenOrder::sequence);
        if (found == orders_.end()) continue;
        answer(found->page, found->id, false, refused.reason, refused.code);
        orders_.erase(found);
    }
    if (client_->outdated() || !client_->over().empty()) return drop_client();
    for (; !orders_.empty() && orders_.front().reply <= client_->acknowledged(); orders_.pop_front())
        answer(orders_.front().page, orders_.front().id, true, "order accepted");
}

}  // namespace roboss
