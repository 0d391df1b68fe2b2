// See board_builder.h.
#include "sdf/board_builder.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sdf/element_reader.h"
#include "sdf/parameter_reader.h"

namespace roboss::sdf_import {
namespace {

std::string text_of(const pugi::xml_node& parent, const char* child) {
    std::string text;
    for (const std::string_view word : words_of(parent.child(child).text().get()))
        text += (text.empty() ? "" : " ") + std::string(word);
    return text;
}

/// Three numbers; nullopt: it is something else.
std::optional<Vec3> vector_of(const std::string& text) {
    const auto words = words_of(std::string_view(text));
    double numbers[3] = {};
    if (words.size() < 3) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto number = parse_number(words[i]);
        if (!number || !std::isfinite(*number)) return std::nullopt;
        numbers[i] = *number;
    }
    return Vec3{numbers[0], numbers[1], numbers[2]};
}

bool is_true(const std::string& text) {
    return text == "true" || text == "1";
}

/// Links of the model whose contacts a TouchPlugin sees.
std::vector<BoardWord> touching_links(const pugi::xml_node& plugin, const ModelSpec& spec) {
    std::vector<std::string> named;
    for (const auto node : plugin.children("collision")) named.emplace_back(node.text().get());
    const bool all = is_true(text_of(plugin, "create_contact_sensor_for_collision"));
    std::vector<BoardWord> links;
    for (const LinkSpec& link : spec.links) {
        const bool senses = std::ranges::any_of(
            link.sensors, [](const SensorSpec& sensor) { return sensor.sdf_type == "contact"; });
        const bool is_named = std::ranges::any_of(link.collisions, [&](const CollisionSpec& collision) {
            return std::ranges::find(named, collision.name) != named.end();
        });
        if ((named.empty() || is_named) && (senses || (all && is_named))) links.push_back({link.name});
    }
    return links;
}

}  // namespace

std::string absolute(std::string topic) {
    while (topic.starts_with('/')) topic.erase(0, 1);
    return "/" + topic;
}

std::string with_model(std::string topic, const std::string& model) {
    if (const std::size_t at = topic.find("{model}"); at != std::string::npos) topic.replace(at, 7, model);
    return topic;
}

BoardBuilder::BoardBuilder(World& world) : world_(world) {
    for (const ModelInstance& instance : world.instances) {
        for (const OnboardSpec& onboard : world.prototypes[instance.prototype].onboard) {
            for (const Channel& channel : channels_of(onboard.parameters)) {
                auto& names = taken_[with_model(channel.topic, instance.name)];
                for (const ChannelValue& value : channel.values)
                    if (std::ranges::find(names, value.name) == names.end()) names.push_back(value.name);
            }
        }
    }
    find_outputs();
}

/// Number of a text in messages.
double BoardBuilder::number_of(const std::string& text) {
    if (text.empty()) return 0;
    const auto [known, is_new] = words_.try_emplace(text, static_cast<double>(board_.words.size() + 1));
    if (is_new) board_.words.push_back({text});
    return known->second;
}

std::vector<BoardValue> BoardBuilder::values_of(const std::vector<MessageField>& fields) {
    std::vector<BoardValue> values;
    for (const MessageField& field : fields)
        values.push_back({field.name, field.is_text ? number_of(field.text) : field.number, field.is_text});
    return values;
}

/// A name for a channel, unique on the board.
std::string BoardBuilder::name_for(const std::string& topic, const std::string& model) {
    const auto is_taken = [&](const std::string& name) {
        return std::ranges::any_of(board_.topics, [&](const BoardTopic& t) { return t.name == name; });
    };
    std::string name = topic.substr(1);
    if (is_taken(name) && !model.empty()) name += "#" + model;
    for (int i = 2; is_taken(name); ++i) name = topic.substr(1) + "#" + model + "#" + std::to_string(i);
    return name;
}

BoardTopic& BoardBuilder::add_topic(const std::string& topic, const std::string& model) {
    const std::string name = name_for(topic, model);
    board_.topics.push_back({name, topic, model, {}});
    return board_.topics.back();
}

bool BoardBuilder::has_model(const std::string& name) const {
    return find_model(name) != nullptr;
}

void BoardBuilder::add_performer(const pugi::xml_node& performer) {
    const auto size = vector_of(text_of(performer.child("geometry").child("box"), "size"));
    performers_.push_back(
        {performer.attribute("name").value(), text_of(performer, "ref"), size.value_or(Vec3{})});
}

std::string BoardBuilder::add_touch(const pugi::xml_node& plugin, const ModelInstance& instance) {
    const auto time = parse_number(text_of(plugin, "time"));
    BoardTouch touch;
    touch.model = instance.name;
    touch.target = text_of(plugin, "target");
    if (touch.target.empty()) return "names no <target>";
    if (!time || !std::isfinite(*time)) return "has no <time> in s";
    touch.time = *time;
    touch.enabled = is_true(text_of(plugin, "enabled"));
    touch.links = touching_links(plugin, world_.prototypes[instance.prototype]);
    if (touch.links.empty()) return "finds no contact sensor on a link of its model";
    std::string space = text_of(plugin, "namespace");
    if (space.empty()) space = "model/" + instance.name + "/touch";
    touch.enable = absolute(space) + "/enable";
    open_topic(touch.enable, *find_message_type("gz.msgs.Boolean"), {});
    BoardTopic& told = add_topic(absolute(space) + "/touched", instance.name);
    told.values.push_back({"data"});
    touch.told = told.name;
    board_.touches.push_back(std::move(touch));
    return {};
}

std::string BoardBuilder::add_detector(const pugi::xml_node& plugin, const ModelInstance& instance) {
    const auto size = vector_of(text_of(plugin.child("geometry").child("box"), "size"));
    if (!size) return "has no <geometry><box><size>";
    std::string topic = text_of(plugin, "topic");
    if (topic.empty()) topic = "model/" + instance.name + "/performer_detector/status";
    BoardDetector detector;
    detector.model = instance.name;
    detector.is_static = world_.prototypes[instance.prototype].is_static;
    detector.X_WM = instance.X_WM;
    detector.size = *size;
    detector.offset = vector_of(text_of(plugin, "pose")).value_or(Vec3{});
    detector.group = groups_++;
    for (const Performer& performer : performers_) {
        if (!has_model(performer.model)) continue;
        BoardTopic& told = add_topic(absolute(topic), instance.name);
        told.values.push_back({"name", number_of(performer.model), true});
        for (const char* part : {"position_x", "position_y", "position_z", "orientation_w", "orientation_x",
                                 "orientation_y", "orientation_z", "state", "count"})
            told.values.push_back({part});
        told.values.push_back({"frame_id", number_of(instance.name), true});
        for (const auto data : plugin.children("header_data")) {
            const std::string value = text_of(data, "value");
            const auto number = parse_number(value);
            told.values.push_back({text_of(data, "key"), number ? *number : number_of(value), !number});
        }
        detector.performer = performer.model, detector.performer_size = performer.size;
        detector.told = told.name;
        board_.detectors.push_back(detector);
    }
    return performers_.empty() ? "has no performer to detect: the world declares none" : "";
}

void BoardBuilder::open_topic(const std::string& topic, const MessageType& type,
                              const std::vector<BoardValue>& values) {
    if (taken_.contains(topic)) return;
    bool is_open = false;
    for (BoardTopic& known : board_.topics) {
        if (known.topic != topic) continue;
        is_open = true;
        if (!known.model.empty()) continue;  // an event has the values that it has
        for (const BoardValue& value : values)
            if (std::ranges::none_of(known.values, [&](const auto& v) { return v.name == value.name; }))
                known.values.push_back({value.name, 0, value.is_text});
    }
    if (is_open) return;
    BoardTopic& opened = add_topic(topic, "");
    for (const BoardValue& value : values) opened.values.push_back({value.name, 0, value.is_text});
    const bool is_string = std::string_view(type.name) == "StringMsg";
    for_each_part(type.fields, '|', [&](const std::string& field) {
        if (std::ranges::none_of(opened.values, [&](const auto& v) { return v.name == field; }))
            opened.values.push_back({field, 0, is_string});
    });
}

std::string BoardBuilder::add_match(const pugi::xml_node& node, const MessageType& type,
                                    BoardTrigger& trigger) {
    const std::string text = node.text().get(), path = node.attribute("field").value();
    const std::string logic = node.attribute("logic_type").as_string("positive");
    if (logic != "positive" && logic != "negative") return "has a <match> with logic_type '" + logic + "'";
    const auto fields = path.empty() ? parse_message(text, type) : parse_field(path, text, type);
    if (!fields || fields->empty()) return "has a <match> that cannot be read";
    BoardMatch match;
    match.whole = path.empty();
    match.negative = logic == "negative";
    match.any_order = !path.empty();
    match.tolerance = node.attribute("tol").as_double(match.tolerance);
    match.values = values_of(*fields);
    trigger.matches.push_back(std::move(match));
    return {};
}

std::string BoardBuilder::add_output(const pugi::xml_node& node, BoardTrigger& trigger) {
    const std::string written = node.attribute("type").value();
    const MessageType* type = find_message_type(written);
    if (type == nullptr) return "has an <output> of the type '" + written + "', which is not known";
    BoardOutput output;
    if (*node.attribute("topic").value() == '\0') return "has an <output> without a topic";
    output.topic = absolute(node.attribute("topic").value());
    const auto fields = parse_message(node.text().get(), *type);
    if (!fields) return "has an <output> that cannot be read";
    output.values = values_of(*fields);
    if (const auto taken = taken_.find(output.topic); taken != taken_.end()) {
        for (const BoardValue& value : output.values) {
            const bool is_only = value.name == "data" && taken->second.size() == 1;
            if (!is_only && std::ranges::find(taken->second, value.name) == taken->second.end())
                return "sets '" + value.name + "', which the command at '" + output.topic + "' does not have";
        }
    }
    open_topic(output.topic, *type, output.values);
    trigger.outputs.push_back(std::move(output));
    return {};
}

/// Position and orientation of a request to set_pose; nothing set: the identity.
std::string BoardBuilder::read_pose(const std::vector<MessageField>& fields, BoardOutput& output) const {
    bool turned = false;
    Quat q{0, 0, 0, 0};
    for (const MessageField& f : fields) {
        if (f.name == "name") output.robot = f.text;
        if (f.name == "position_x") output.X_WR.p.x = f.number;
        if (f.name == "position_y") output.X_WR.p.y = f.number;
        if (f.name == "position_z") output.X_WR.p.z = f.number;
        turned |= f.name.starts_with("orientation");
        if (f.name == "orientation_w") q.w = f.number;
        if (f.name == "orientation_x") q.x = f.number;
        if (f.name == "orientation_y") q.y = f.number;
        if (f.name == "orientation_z") q.z = f.number;
    }
    const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (turned && !(size > 1e-6)) return "puts a model with an orientation of zero length";
    if (turned) output.X_WR.q = normalized(q);
    if (!has_model(output.robot)) return "puts a model '" + output.robot + "', which is not in the world";
    return {};
}

std::string BoardBuilder::add_service(const pugi::xml_node& node, BoardTrigger& trigger) {
    const MessageType* type = find_message_type(node.attribute("reqType").value());
    if (type == nullptr || find_message_type(node.attribute("repType").value()) == nullptr)
        return "has a <service> with a request or response of a type that is not known";
    const auto fields = parse_message(node.attribute("reqMsg").value(), *type);
    if (!fields) return "has a <service> with a request that cannot be read";
    if (*node.attribute("name").value() == '\0') return "has a <service> without a name";
    BoardOutput output;
    output.topic = absolute(node.attribute("name").value());
    if (output.topic == "/world/" + world_.name + "/set_pose") {
        if (std::string fault = read_pose(*fields, output); !fault.empty()) return fault;
    } else {
        output.values = values_of(*fields);
        open_topic(output.topic, *type, output.values);
    }
    trigger.outputs.push_back(std::move(output));
    return {};
}

std::string BoardBuilder::add_trigger(const pugi::xml_node& plugin) {
    const pugi::xml_node input = plugin.child("input");
    const std::string written = input.attribute("type").value();
    const MessageType* type = find_message_type(written);
    if (type == nullptr) return "has an <input> of the type '" + written + "', which is not known";
    if (*input.attribute("topic").value() == '\0') return "has no topic of its <input>";
    const auto before = std::tuple(board_, words_);
    const auto fail = [&](std::string fault) {
        std::tie(board_, words_) = before;  // nothing stays of a trigger that cannot run
        return fault;
    };
    BoardTrigger trigger;
    trigger.topic = absolute(input.attribute("topic").value());
    for (const auto node : input.children("match"))
        if (std::string fault = add_match(node, *type, trigger); !fault.empty()) return fail(fault);
    std::vector<BoardValue> named;
    for (const BoardMatch& match : trigger.matches)
        named.insert(named.end(), match.values.begin(), match.values.end());
    open_topic(trigger.topic, *type, named);
    for (const auto node : plugin.children("output"))
        if (std::string fault = add_output(node, trigger); !fault.empty()) return fail(fault);
    for (const auto node : plugin.children("service"))
        if (std::string fault = add_service(node, trigger); !fault.empty()) return fail(fault);
    if (trigger.outputs.empty()) return fail("has neither an <output> nor a <service>");
    const double delay_ms = parse_number(text_of(plugin, "delay_ms")).value_or(0);
    trigger.delay = delay_ms > 0 && delay_ms < 1e12 ? delay_ms * 1e-3 : 0;
    if (std::ranges::find(board_.triggers, trigger) == board_.triggers.end())  // copies do the same
        board_.triggers.push_back(std::move(trigger));
    return {};
}

std::vector<std::string> BoardBuilder::topics_of_users() const {
    std::vector<std::string> topics;
    const auto is_published = [&](const std::string& topic) {
        const auto publishes = [&](const BoardOutput& output) { return output.topic == topic; };
        const auto is_event = [&](const BoardTopic& t) { return t.topic == topic && !t.model.empty(); };
        return taken_.contains(topic) || std::ranges::any_of(board_.topics, is_event) ||
               outputs_.contains(topic) ||
               std::ranges::any_of(board_.triggers, [&](const BoardTrigger& trigger) {
                   return std::ranges::any_of(trigger.outputs, publishes);
               });
    };
    for (const BoardTrigger& trigger : board_.triggers)
        if (!is_published(trigger.topic) && std::ranges::find(topics, trigger.topic) == topics.end())
            topics.push_back(trigger.topic);
    return topics;
}

void BoardBuilder::finish() {
    if (!board_.triggers.empty()) add_sensors(), add_arrivals();
    if (board_.triggers.empty() && board_.touches.empty() && board_.detectors.empty() &&
        board_.supplies.empty() && board_.reports.empty() && board_.followers.empty())
        return;
    ModelSpec spec;
    spec.name = "message_board";
    while (has_model(spec.name)) spec.name += "_";
    spec.is_static = true;
    spec.canonical_link = "board";
    spec.links.emplace_back().name = "board";
    spec.onboard.push_back({"message board", std::move(board_), {world_.file, 0}});
    world_.instances.push_back({spec.name, world_.prototypes.size(), {}, {world_.file, 0}});
    world_.prototypes.push_back(std::move(spec));
}

}  // namespace roboss::sdf_import
