// See spawner.h.
#include "ros2/spawner.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "ros2/model_text.h"

namespace roboss::ros2 {

namespace si = simulation_interfaces;

namespace {

using Codes = si::SpawnEntity::Response;

constexpr std::size_t kLongestName = 200;
constexpr std::size_t kWaitingBytesMost = std::size_t{64} << 20;  // of descriptions whose turn has not come

std::size_t size_of(const Spawn& wanted) {
    return sizeof(Spawn) + wanted.name.size() + wanted.space.size() + wanted.uri.size() + wanted.text.size() +
           wanted.frame.size();
}

bool is_name(const std::string& name) {
    return name.size() <= kLongestName && std::ranges::all_of(name, [](char c) {
               return std::isalnum(static_cast<unsigned char>(c)) ||
                      std::string_view("_-.: /+").find(c) != std::string_view::npos;
           });
}

/// The namespace as the first part of a robot's name: "a::b"; nothing if it is none.
std::optional<std::string> scope_of(std::string space) {
    if (space.starts_with('/')) space.erase(0, 1);
    if (space.ends_with('/')) space.pop_back();
    std::string scope;
    for (std::size_t i = 0; i < space.size(); ++i) {
        const char c = space[i];
        const bool begins = i == 0 || space[i - 1] == '/';
        if (c == '/' ? begins : !std::isalnum(static_cast<unsigned char>(c)) && c != '_') return {};
        if (begins && std::isdigit(static_cast<unsigned char>(c))) return {};
        scope += c == '/' ? "::" : std::string(1, c);
    }
    return space.size() <= kLongestName ? std::optional(scope) : std::nullopt;
}

/// The result of a request that the run refused.
si::Result refusal(const ControlRefused& refused) {
    const std::uint8_t code = refused.code == "name-taken"  ? Codes::kNameNotUnique
                              : refused.code == "bad-model" ? Codes::kResourceParseError
                                                            : si::Result::kOperationFailed;
    return result_of(code, refused.error().text());
}

}  // namespace

struct Spawner::Addition {
    AddModels request;
    Spawned then;
    std::function<void()> over;    // the next one may begin
    std::set<std::string> before;  // robots of the world
    std::uint64_t hash = 0;        // of the Model

    void end(const si::Result& result, const std::string& name) const {
        then(result, name);
        over();
    }
};

void Spawner::spawn(const Spawn& wanted, const Spawned& then) {
    const std::size_t bytes = size_of(wanted);
    if (waiting_bytes_ + bytes > kWaitingBytesMost)
        return then(result_of(si::Result::kOperationFailed, "too many others wait: spawn it later"), "");
    waiting_bytes_ += bytes;
    waits_.in_turn([this, wanted, then, bytes](std::function<void()> over) {
        const auto begin = [this, wanted, then, bytes, over = std::move(over)](bool) {
            waiting_bytes_ -= bytes;
            const auto addition = std::make_shared<Addition>();
            addition->then = then, addition->over = over;
            const si::Result ready = prepare(wanted, *addition);
            if (ready.result != si::Result::kOk) return addition->end(ready, "");
            add(addition);
        };
        // A node may ask before the face has seen the world, at the start and after a change of the world.
        const auto is_seen = [this] { return run_.tick() >= 0; };
        if (is_seen()) return begin(true);
        waits_.until(is_seen, begin);
    });
}

si::Result Spawner::choose_name(const Spawn& wanted, const std::string& in_file, std::string& name) const {
    const std::optional<std::string> scope = scope_of(wanted.space);
    if (!scope) return result_of(Codes::kNamespaceInvalid, "the namespace is none of ROS 2");
    name = wanted.name.empty() ? in_file : wanted.name;
    if (!is_name(name))
        return result_of(Codes::kNameInvalid, "the name has characters that names do not have");
    if (name.empty()) {
        if (!wanted.may_rename)
            return result_of(Codes::kNameInvalid, "neither request nor description has a name");
        name = "entity";
    }
    if (!scope->empty()) name = *scope + "::" + name;
    const std::string first = name;
    for (int number = 2; run_.model().find_robot(name); ++number) {
        if (!wanted.may_rename)
            return result_of(Codes::kNameNotUnique, "there is a robot '" + name + "' already");
        name = first + "_" + std::to_string(number);
    }
    return fine();
}

si::Result Spawner::prepare(const Spawn& wanted, Addition& addition) const {
    if (run_.tick() < 0) return result_of(si::Result::kIncorrectState, "no world was seen yet");
    if (wanted.uri.empty() && wanted.text.empty())
        return result_of(Codes::kNoResource, "neither a URI nor a description is given");
    ModelContent content{"model.sdf", wanted.text};
    if (!wanted.uri.empty()) {
        Result<ModelContent> read = folders_.read(wanted.uri);
        if (!read)
            return result_of(
                read.error().code == "bad-format" ? Codes::kUnsupportedFormat : si::Result::kNotFound,
                read.error().message);
        content = std::move(read).value();
    }
    const Result<ModelText> text = read_model_text(content.text);
    if (!text) return result_of(Codes::kResourceParseError, text.error().message);
    if (text.value().format.empty())
        return result_of(Codes::kUnsupportedFormat, "the description is neither SDF, URDF nor MJCF");
    const bool by_uri = content.text != wanted.text && text.value().name.empty();
    const std::string in_file =
        by_uri ? std::filesystem::path(wanted.uri).stem().string() : text.value().name;
    si::Result named = choose_name(wanted, in_file, addition.request.name);
    if (named.result != si::Result::kOk) return named;
    const Result<Pose> X_WM = entities_.pose_in_world(wanted.frame, wanted.pose);
    if (!X_WM) return result_of(Codes::kInvalidPose, X_WM.error().message);
    addition.request.X_WA = X_WM.value() * inverse(text.value().X_FM);
    addition.request.file = content.file, addition.request.content = std::move(content.text);
    addition.hash = run_.model().hash;
    for (const Robot& robot : run_.model().robots) addition.before.insert(robot.name);
    return fine();
}

void Spawner::add(const std::shared_ptr<Addition>& addition) {
    waits_.ask(
        addition->request,
        [this, addition](const ControlOutcome& outcome) {
            const auto* refused = std::get_if<ControlRefused>(&outcome);
            if (refused != nullptr && refused->code != "changed-world")
                return addition->end(refusal(*refused), "");
            await(addition);
        },
        RunWaits::kLong_ms);
}

/// The run has added something: its name is that of the first robot that is new.
void Spawner::await(const std::shared_ptr<Addition>& addition) {
    waits_.until(
        [this, addition] { return run_.model().hash != addition->hash && run_.tick() >= 0; },
        [this, addition](bool is_seen) {
            std::string name;
            const std::string& wanted = addition->request.name;
            for (const RobotId robot : entities_.all()) {
                const std::string& one = entities_.name(robot);
                if (addition->before.contains(one)) continue;
                spawned_.insert(one);
                if (name.empty() || one == wanted) name = one;
            }
            if (!is_seen)
                addition->end(
                    result_of(si::Result::kOperationFailed, "the world with it was not seen in time"), "");
            else if (name.empty())
                addition->end(result_of(si::Result::kOk,
                                        "it is static and has no sensors: it became scenery, "
                                        "which is no entity and stays"),
                              wanted);
            else
                addition->end(fine(), name);
        });
}

void Spawner::remove(std::vector<std::string> names, const Removed& then) {
    waits_.in_turn([this, names = std::move(names), then](const std::function<void()>& over) {
        std::vector<std::string> present;
        std::ranges::copy_if(names, std::back_inserter(present),
                             [&](const std::string& n) { return run_.model().find_robot(n).has_value(); });
        const auto end = [then, over](const si::Result& result) {
            then(result);
            over();
        };
        if (present.empty()) return end(fine());
        const auto are_gone = [this, present] {
            return run_.tick() >= 0 && std::ranges::none_of(present, [&](const std::string& n) {
                       return run_.model().find_robot(n).has_value();
                   });
        };
        waits_.ask(RemoveRobots{present}, [this, are_gone, end](const ControlOutcome& outcome) {
            const auto* refused = std::get_if<ControlRefused>(&outcome);
            if (refused != nullptr && refused->code != "changed-world")
                return end(result_of(si::Result::kOperationFailed, refused->error().text()));
            waits_.until(are_gone, [end](bool gone) {
                end(gone ? fine()
                         : result_of(si::Result::kOperationFailed,
                                     "the world without it was not seen in time"));
            });
        });
    });
}

std::vector<std::string> Spawner::spawned() const {
    std::vector<std::string> names;
    std::ranges::copy_if(spawned_, std::back_inserter(names),
                         [&](const std::string& n) { return run_.model().find_robot(n).has_value(); });
    return names;
}

}  // namespace roboss::ros2
