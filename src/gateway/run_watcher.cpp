// Fetching, watching, asking.
#include "gateway/run_watcher.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/hash.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kAgain_ms = 250;         // what is not answered is asked again
constexpr std::int64_t kFetchAgain_ms = 1'000;  // the Model, after it could not be read or has changed
constexpr std::int64_t kWatchAgain_ms = 1'000;
constexpr std::int64_t kStatusEvery_ms = 500, kGroupsEvery_ms = 500, kBoundsEvery_ms = 250;
constexpr std::int64_t kUnknownWord_ms =
    30'000;  // a word that the run does not know is tried again after so long
constexpr std::uint32_t kExactEvery_ms = 100;
constexpr std::size_t kQuestionsMax = 200;
constexpr Tick kNoPeriod = Tick{1} << 49;  // the orders' Client observes nothing, and so holds up no window

/// Contacts need everybody's state too.
ViewRequest request_of(const WatchRequest& wanted, const Model& model) {
    ViewRequest request{model.hash, wanted.interval_ms, 0, wanted.contacts, {}};
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

/// What the run says by robot; nothing where it is of another Model than this scene's.
Json read_by_robot(const std::string& text, const ShownScene& scene) {
    Json read = Json::parse(text, nullptr, false);
    const bool fits =
        read.is_object() && read.contains("model_hash") && read["model_hash"] == to_hex(scene.model->hash);
    return fits ? std::move(read) : Json();
}

std::string groups_line(const std::string& text, const ShownScene& scene) {
    const Json read = read_by_robot(text, scene);
    if (read.is_null()) return {};
    Json line{{"type", "groups"}, {"scene", scene.number}};
    for (const char* name : {"simulator", "island"})
        if (read.contains(name)) line[name] = read[name];
    return dumped(line);
}

std::string bounds_line(const std::string& text, Tick tick, const ShownScene& scene) {
    const Json read = read_by_robot(text, scene);
    if (!read.is_object() || !read.contains("boxes") || !read["boxes"].is_array()) return {};
    Json bounds = Json::array();
    for (std::size_t r = 0; r < read["boxes"].size(); ++r)
        bounds.push_back({{"robot", r}, {"box", read["boxes"][r]}});
    return dumped(
        {{"type", "overlay"}, {"scene", scene.number}, {"tick", tick}, {"bounds", std::move(bounds)}});
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
        question.answered(*reply);
    }
    if (questions.empty()) return;
    const std::int64_t now = bus.now_ms();
    if (!asked_ms) ++number;
    if (asked_ms && now - *asked_ms < kAgain_ms) return;
    asked_ms = now;
    bus.send(self, kControllerAddress, ControlRequest{number, questions.front().words});
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
    if (scene_ && !outdated_) look(bus);
    poll(bus.now_ms());
    polls_.advance(bus);
    control_.advance(bus);
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
    fetch_from_ms_ = now_ms;
    sent_ms_.reset();
    drop_client();
    exchange_->show(scene_);
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
        polls_.questions.push_back({{"status"}, [this, now_ms](const ControlReply& reply) {
                                        status_at_ms_ = now_ms;
                                        tell_status(reply);
                                    }});
    if (!scene_ || outdated_) return;
    const auto ask_for = [&](const char* word, Line::To to, std::optional<std::int64_t>& last_ms) {
        polls_.questions.push_back(
            {{word}, [this, to, &last_ms, scene = scene_, now_ms](const ControlReply& reply) {
                 if (!reply.done) last_ms = now_ms + kUnknownWord_ms;
                 if (reply.done) tell_by_robot(reply, to, scene);
             }});
    };
    if (watch_request_.groups && due(groups_ms_, kGroupsEvery_ms))
        ask_for("groups", Line::To::kGroups, groups_ms_);
    if (watch_request_.bounds && due(bounds_ms_, kBoundsEvery_ms))
        ask_for("bounds", Line::To::kBounds, bounds_ms_);
}

/// The status of the run with what only the gateway knows. Names of robots are in the scene.
void RunWatcher::tell_status(const ControlReply& reply) {
    if (!reply.done) return;
    const Json read = Json::parse(reply.text, nullptr, false);
    if (!read.is_object()) return;
    Json status{{"type", "status"}};
    for (const auto& [name, value] : read.items())
        if (name != "robots" && name != "type") status[name] = value;
    const bool has_time = read.contains("time_s") && read["time_s"].is_number();
    const double time_s = has_time ? read["time_s"].get<double>() : 0.0;
    const double wall_s =
        1e-3 * static_cast<double>(status_at_ms_ - std::exchange(status_was_ms_, status_at_ms_));
    const double way_s = time_s - std::exchange(status_time_s_, time_s);
    const bool known = wall_s > 0 && wall_s < 10 && way_s >= 0;
    status["rtf"] = known ? std::round(1e3 * way_s / wall_s) / 1e3 : 0.0;
    exchange_->say({Line::To::kStatus, 0, true,
                    [text = status.dump(-1, ' ', false, Json::error_handler_t::replace)]() { return text; }});
}

void RunWatcher::tell_by_robot(const ControlReply& reply, Line::To to,
                               std::shared_ptr<const ShownScene> scene) {
    exchange_->say({to, 0, true, [text = reply.text, to, tick = tick_, scene = std::move(scene)]() {
                        return to == Line::To::kGroups ? groups_line(text, *scene)
                                                       : bounds_line(text, tick, *scene);
                    }});
}

void RunWatcher::answer(std::uint64_t page, std::int64_t id, bool done, std::string text) {
    exchange_->say({Line::To::kPage, page, false, [id, done, text = std::move(text)]() {
                        return Json{{"type", "answer"}, {"id", id}, {"done", done}, {"text", text}}.dump(
                            -1, ' ', false, Json::error_handler_t::replace);
                    }});
}

void RunWatcher::serve(Bus& bus, PageCall& call) {
    if (const auto* order_said = std::get_if<PageOrder>(&call.what)) return order(bus, call, *order_said);
    if (control_.questions.size() >= kQuestionsMax)
        return answer(call.page, call.id, false, "too many requests are waiting for replies");
    control_.questions.push_back({std::move(std::get<ControlArguments>(call.what).words),
                                  [this, page = call.page, id = call.id](const ControlReply& reply) {
                                      answer(page, id, reply.done, reply.text);
                                  }});
}

void RunWatcher::order(Bus& bus, const PageCall& call, const PageOrder& said) {
    if (!scene_ || outdated_)
        return answer(call.page, call.id, false, "the scene has changed and is being fetched");
    if (!client_) {
        BusClientOptions options;
        options.name = "viewer";
        options.period = options.latency = kNoPeriod;
        options.synchronous = false;
        options.observer = true;
        client_ = std::make_unique<BusClient>(scene_->model, new_address_(), options);
        sequence_ = 0;
    }
    Result<> given = Error{"", ""};
    if (const auto* wrench = std::get_if<PageWrench>(&said.action)) {
        given = client_->apply_wrench(said.robot, wrench->link, wrench->force, wrench->torque,
                                      wrench->duration_s);
    } else {
        std::visit(
            [&](const auto& action) {
                if constexpr (!std::is_same_v<std::decay_t<decltype(action)>, PageWrench>)
                    given = client_->order(said.robot, action);
            },
            said.action);
    }
    if (!given) return answer(call.page, call.id, false, given.error().text());
    orders_.push_back({call.page, ++sequence_, call.id});
    client_->send(bus, tick_);
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
    const auto end = [&](const OpenOrder& o, bool done, const std::string& text) {
        answer(o.page, o.id, done, text);
    };
    for (const std::string& refusal : client_->take_refusals()) {
        const auto found = std::find_if(orders_.begin(), orders_.end(), [&](const OpenOrder& o) {
            return refusal.starts_with("order " + std::to_string(o.sequence) + ": ");
        });
        if (found == orders_.end()) continue;
        end(*found, false, refusal);
        orders_.erase(found);
    }
    if (client_->outdated() || !client_->over().empty()) return drop_client();
    if (!client_->heard()) return;
    for (const OpenOrder& o : std::exchange(orders_, {})) end(o, true, "order accepted");
}

}  // namespace roboss
