// See triggers.h.
#include "client/triggers/triggers.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/archive.h"

namespace roboss {
namespace {

using wire::field;

/// Messages that triggers publish at one observation at most: triggers may start each other for ever.
constexpr int kPublishedMax = 1000;

double value_of(const std::vector<BoardValue>& values, const std::string& name) {
    const auto found =
        std::ranges::find_if(values, [&](const BoardValue& value) { return value.name == name; });
    if (found != values.end()) return found->value;
    return name == "data" && values.size() == 1 ? values.front().value : 0.0;
}

bool are_equal(const BoardValue& wanted, double value, double tolerance) {
    return wanted.is_text ? wanted.value == value : std::fabs(wanted.value - value) <= tolerance;
}

/// "data_" of the element "data_3" of a repeated field; empty: it is none.
std::string_view list_of(std::string_view name) {
    const std::size_t end = name.find_last_not_of("0123456789");
    if (end == std::string_view::npos || end + 1 == name.size() || name[end] != '_') return {};
    return name.substr(0, end + 1);
}

/// Whether some element of the repeated field has the value; nullopt: the message has no such field.
std::optional<bool> contains(const std::vector<BoardValue>& message, const BoardValue& wanted,
                             double tolerance) {
    const std::string_view written = list_of(wanted.name);
    const std::string list = written.empty() ? wanted.name + "_" : std::string(written);
    std::optional<bool> found;
    for (const BoardValue& value : message)
        if (list_of(value.name) == list)
            found = found.value_or(false) || are_equal(wanted, value.value, tolerance);
    return found;
}

bool holds(const BoardMatch& match, const std::vector<BoardValue>& message) {
    bool equal = std::ranges::all_of(match.values, [&](const BoardValue& wanted) {
        if (match.any_order)
            if (const auto found = contains(message, wanted, match.tolerance)) return *found;
        return are_equal(wanted, value_of(message, wanted.name), match.tolerance);
    });
    if (match.whole) {
        for (const BoardValue& value : message) {
            const bool named = std::ranges::any_of(
                match.values, [&](const BoardValue& wanted) { return wanted.name == value.name; });
            const bool only = message.size() == 1 && match.values.size() == 1;
            equal = equal && (named || only || std::fabs(value.value) <= match.tolerance);
        }
    }
    return equal != match.negative;
}

bool meet(const Vec3& a, const Vec3& size_a, const Vec3& b, const Vec3& size_b) {
    const Vec3 d = a - b, reach = (size_a + size_b) * 0.5;
    return std::fabs(d.x) <= reach.x && std::fabs(d.y) <= reach.y && std::fabs(d.z) <= reach.z;
}

void set(std::vector<BoardValue>& values, const char* name, double value) {
    for (BoardValue& v : values)
        if (v.name == name) v.value = value;
}

template <class A, class Item>
auto& resized(A& a, Item& items, std::size_t bytes_each) {
    if constexpr (A::kReading)
        items.resize(a.count(bytes_each));
    else
        a.count(items.size());
    return items;
}

}  // namespace

bool has_message_board(const Model& model) {
    return std::ranges::any_of(model.robots, [&](const Robot& robot) {
        return board_of(model.types[robot.type.index()]) != nullptr;
    });
}

Triggers::Triggers(std::shared_ptr<const Model> model, std::function<void(Tick, const std::string&)> told)
    : model_(std::move(model)), told_(std::move(told)) {
    const auto use = [&](const std::string& topic) { places_.try_emplace(topic); };
    std::vector<std::string> inputs;
    for (std::size_t r = 0; r < model_->robots.size(); ++r) {
        const MessageBoardSpec* spec = board_of(model_->type_of(RobotId(r)));
        if (spec == nullptr) continue;
        Board board{RobotId(r),
                    spec,
                    {},
                    std::vector<char>(spec->detectors.size(), 0),
                    BoardWatch(*model_, RobotId(r), *spec)};
        for (const BoardTouch& touch : spec->touches) {
            board.touches.push_back({ContactWatch(*model_, touch), touch.enabled});
            if (touch.time < 2 * kPeriod) period_ = std::min(kPeriod, model_->dt_s);
            inputs.push_back(touch.enable);
        }
        for (const BoardTrigger& trigger : spec->triggers) {
            inputs.push_back(trigger.topic);
            for (const BoardOutput& output : trigger.outputs) use(output.topic);
        }
        boards_.push_back(std::move(board));
    }
    std::ranges::for_each(inputs, use);
    for (std::size_t r = 0; r < model_->robots.size(); ++r) {
        const std::size_t channels = model_->type_of(RobotId(r)).channels.size();
        for (std::uint32_t c = 0; c < channels; ++c) {
            const TopicPlace place{RobotId(r), c};
            const std::string topic = topic_of(*model_, place);
            if (const auto used = places_.find(topic); used != places_.end()) used->second.push_back(place);
            if (std::ranges::find(inputs, topic) != inputs.end()) inputs_.push_back(place);
        }
    }
}

void Triggers::control(Client& client) {
    read_messages(client);
    own_.clear();
    for (Board& board : boards_) {
        watch_touches(client, board);
        watch_regions(client, board);
        watch_others(client, board);
    }
    publish_due(client);
    seen_ = client.tick();
}

/// Messages of others since the last observation, in the order of their ticks.
void Triggers::read_messages(Client& client) {
    std::vector<std::pair<Tick, TopicPlace>> news;
    for (const TopicPlace& place : inputs_) {
        const ChannelInfo& info = model_->type_of(place.robot).channels[place.channel];
        const auto tick =
            static_cast<Tick>(client.state(place.robot).onboard[static_cast<std::size_t>(info.index)]);
        if (tick < 0 || tick < seen_ || tick >= client.tick()) continue;
        const bool is_own = tick == seen_ && std::ranges::find(own_, place) != own_.end();
        if (!is_own) news.emplace_back(tick, place);
    }
    std::ranges::sort(news);
    for (const auto& [tick, place] : news) react(message_at(client, place), tick);
}

Triggers::Message Triggers::message_at(const Client& client, const TopicPlace& place) const {
    Message message{topic_of(*model_, place), {}};
    const ChannelInfo& info = model_->type_of(place.robot).channels[place.channel];
    if (info.channel.is_list) return message;
    const std::vector<double>& onboard = client.state(place.robot).onboard;
    for (std::size_t i = 0; i < info.channel.values.size(); ++i)
        message.values.push_back({info.channel.values[i].name,
                                  onboard[static_cast<std::size_t>(info.index) + 1 + i],
                                  !info.channel.values[i].words.empty()});
    return message;
}

/// What the message starts goes to the pending ones.
void Triggers::react(const Message& message, Tick tick) {
    for (std::uint32_t b = 0; b < boards_.size(); ++b) {
        Board& board = boards_[b];
        for (std::size_t i = 0; i < board.touches.size(); ++i) {
            if (board.spec->touches[i].enable != message.topic) continue;
            board.touches[i].enabled = value_of(message.values, "data") != 0;
            board.touches[i].since = -1;
        }
        for (std::uint32_t t = 0; t < board.spec->triggers.size(); ++t) {
            const BoardTrigger& trigger = board.spec->triggers[t];
            const auto matches = [&](const BoardMatch& match) { return holds(match, message.values); };
            if (trigger.topic != message.topic || !std::ranges::all_of(trigger.matches, matches)) continue;
            const auto delay = static_cast<Tick>(std::floor(trigger.delay / model_->dt_s + 0.5));
            for (std::uint32_t o = 0; o < trigger.outputs.size(); ++o) {
                const Pending one{tick + delay, b, t, o};
                const auto later = [](Tick due, const Pending& other) { return due < other.due; };
                pending_.insert(std::upper_bound(pending_.begin(), pending_.end(), one.due, later), one);
            }
        }
    }
}

void Triggers::watch_others(Client& client, Board& board) {
    const auto tell_it = [&](const std::string& channel, std::vector<BoardValue> values) {
        tell(client, board, channel, std::move(values));
    };
    board.watch.read_sensors(client, [&](const std::string& topic, std::vector<BoardValue> values) {
        react({topic, std::move(values)}, client.tick());
    });
    board.watch.report(client, tell_it);
    board.watch.guide_actors(client);
    board.watch.drop_crumbs(client, tell_it);
}

void Triggers::watch_touches(Client& client, Board& board) {
    for (std::size_t i = 0; i < board.touches.size(); ++i) {
        Touch& touch = board.touches[i];
        const BoardTouch& spec = board.spec->touches[i];
        if (!touch.enabled) continue;
        if (!touch.watch.touches(client)) {
            touch.since = -1;
            continue;
        }
        // The contact was there in the tick before this one.
        if (touch.since < 0) touch.since = client.tick() - 1;
        if (static_cast<double>(client.tick() - touch.since) * model_->dt_s < spec.time) continue;
        touch.enabled = false, touch.since = -1;
        tell(client, board, spec.told, {{"data", 1}});
    }
}

/// Origin of the robot's frame and its axes.
Transform Triggers::pose_of(const Client& client, const std::string& model) const {
    const auto robot = model_->find_robot(model);
    if (!robot) return {};
    return robot_pose(model_->type_of(*robot), base_pose(client.state(*robot)));
}

void Triggers::watch_regions(Client& client, Board& board) {
    const std::vector<BoardDetector>& detectors = board.spec->detectors;
    const std::vector<char> before = board.inside;
    std::vector<Transform> poses(detectors.size());  // of the performers, in the detectors
    for (std::size_t i = 0; i < detectors.size(); ++i) {
        const BoardDetector& d = detectors[i];
        if (!model_->find_robot(d.performer)) continue;
        const Transform X_WM = d.is_static ? to_transform(d.X_WM) : pose_of(client, d.model);
        const Transform X_WP = pose_of(client, d.performer);
        board.inside[i] = meet(X_WM * d.offset, d.size, X_WP.p, d.performer_size) ? 1 : 0;
        poses[i] = inverse(X_WM) * X_WP;
    }
    for (std::size_t i = 0; i < detectors.size(); ++i) {
        if (board.inside[i] == before[i]) continue;
        double count = 0;
        for (std::size_t k = 0; k < detectors.size(); ++k)
            if (detectors[k].group == detectors[i].group) count += board.inside[k];
        const Quat q = to_quat(poses[i].R);
        const auto topic = std::ranges::find(board.spec->topics, detectors[i].told, &BoardTopic::name);
        if (topic == board.spec->topics.end()) continue;
        std::vector<BoardValue> values = topic->values;
        set(values, "position_x", poses[i].p.x), set(values, "position_y", poses[i].p.y);
        set(values, "position_z", poses[i].p.z), set(values, "orientation_w", q.w);
        set(values, "orientation_x", q.x), set(values, "orientation_y", q.y);
        set(values, "orientation_z", q.z);
        set(values, "state", board.inside[i]), set(values, "count", count);
        tell(client, board, detectors[i].told, std::move(values));
    }
}

void Triggers::publish_due(Client& client) {
    for (int n = 0; n < kPublishedMax && !pending_.empty() && pending_.front().due <= client.tick(); ++n) {
        const Pending one = pending_.front();
        pending_.pop_front();
        publish(client, boards_[one.board].spec->triggers[one.trigger].outputs[one.output]);
    }
}

/// An event of the board's own.
void Triggers::tell(Client& client, const Board& board, const std::string& channel,
                    std::vector<BoardValue> values) {
    const auto found = model_->type_of(board.robot).find_channel(channel);
    if (!found) return;
    const TopicPlace place{board.robot, static_cast<std::uint32_t>(*found)};
    const Message message{topic_of(*model_, place), std::move(values)};
    give(client, place, message);
    react(message, client.tick());
}

void Triggers::publish(Client& client, const BoardOutput& output) {
    if (!output.robot.empty()) {
        const auto robot = model_->find_robot(output.robot);
        const Result<> put = robot ? client.set_pose(*robot, output.X_WR) : Result<>(Ok{});
        if (told_)
            told_(client.tick(), output.topic + " " + output.robot + (put ? "" : ": " + put.error().text()));
        return;
    }
    const Message message{output.topic, output.values};
    for (const TopicPlace& place : places_.at(output.topic)) {
        const RobotType& type = model_->type_of(place.robot);
        const MessageBoardSpec* board = board_of(type);
        const bool is_event = board != nullptr && !board->topics[place.channel].model.empty();
        if (!is_event) give(client, place, message);
    }
    react(message, client.tick());
}

/// The message as a command, values by their names.
void Triggers::give(Client& client, const TopicPlace& place, const Message& message) {
    const Channel& channel = model_->type_of(place.robot).channels[place.channel].channel;
    Command command{place.channel, {}};
    std::string text = message.topic + " to " + model_->robots[place.robot.index()].name;
    for (const ChannelValue& value : channel.values) {
        const bool only = channel.values.size() == 1 && message.values.size() == 1;
        command.values.push_back(only ? message.values.front().value : value_of(message.values, value.name));
    }
    const Result<> given = client.order(place.robot, command);
    if (given) own_.push_back(place);
    if (told_) told_(client.tick(), given ? text : text + ": " + given.error().text());
}

template <class A, class Self>
void Triggers::remember(A& a, Self& self) {
    field(a, self.seen_);
    for (auto& place : resized(a, self.own_, 8)) field(a, place.robot.value), field(a, place.channel);
    for (auto& one : resized(a, self.pending_, 20)) {
        field(a, one.due), field(a, one.board);
        field(a, one.trigger), field(a, one.output);
    }
    for (auto& board : self.boards_) {
        for (auto& touch : board.touches) field(a, touch.enabled), field(a, touch.since);
        for (auto& inside : board.inside) field(a, inside);
    }
}

std::string Triggers::memory() const {
    wire::Writer writer;
    remember(writer, *this);
    const std::vector<std::uint8_t> bytes = writer.take();
    return {bytes.begin(), bytes.end()};
}

/// After an edit of the world the boards may be others: what does not fit is forgotten.
void Triggers::restore(const std::string& bytes) {
    const auto fresh = std::tuple(boards_, own_, pending_);
    wire::Reader reader({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    remember(reader, *this);
    const bool fits = std::ranges::all_of(pending_, [&](const Pending& one) {
        return one.board < boards_.size() && one.trigger < boards_[one.board].spec->triggers.size() &&
               one.output < boards_[one.board].spec->triggers[one.trigger].outputs.size();
    });
    if (reader.failed() || reader.left() > 0 || !fits) std::tie(boards_, own_, pending_) = fresh;
}

}  // namespace roboss
