// One parser per form of request.
#include "client/control_text.h"

#include <cmath>
#include <concepts>
#include <sstream>

#include "core/number_text.h"
#include "math/quat.h"

namespace roboss {
namespace {

using Words = std::vector<std::string>;
/// Takes each type of request as it is.
struct Parsed : Result<ControlAction> {
    Parsed(Error error) : Result(std::move(error)) {}
    template <class Request>
    requires std::constructible_from<ControlAction, Request> Parsed(Request request)
        : Result(ControlAction(std::move(request))) {}
};

constexpr std::size_t kShownMost = 40;  // characters of a word in an error

std::string together(const Words& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word.substr(0, kShownMost);
    return text;
}

Error unknown(const Words& words) {
    return {"unknown request '" + together(words) + "'", "see `roboss control --help`", "unknown-request"};
}

Error bad_value(const Words& words, const std::string& wanted) {
    return {"'" + together(words) + "': " + wanted, "see `roboss control " + words[0] + " --help`",
            "bad-value"};
}

/// A whole number from 0 on.
std::optional<std::int64_t> whole(const std::string& text) {
    const std::optional<double> value = read_number(text);
    if (!value || *value < 0 || *value > 1e15 || *value != std::floor(*value)) return std::nullopt;
    return static_cast<std::int64_t>(*value);
}

/// "x y z roll pitch yaw", as SDFormat writes a pose.
std::optional<Pose> pose_of(const std::string& text) {
    std::istringstream in(text);
    double x[6] = {};
    for (double& value : x)
        if (!(in >> value)) return std::nullopt;
    std::string rest;
    if (in >> rest) return std::nullopt;
    return Pose{{x[0], x[1], x[2]}, from_rpy(x[3], x[4], x[5])};
}

Parsed step(const Words& words) {
    if (words.size() == 1) return StepRun{};
    const std::optional<std::int64_t> ticks = whole(words[1]);
    if (!ticks) return bad_value(words, "give a whole number of ticks");
    return StepRun{*ticks};
}

Parsed speed(const Words& words) {
    if (words[1] == "max") return SetSpeed{SetSpeed::Kind::kMax};
    if (words[1] == "world") return SetSpeed{SetSpeed::Kind::kWorld};
    const std::optional<double> factor = read_number(words[1]);
    if (!factor) return bad_value(words, "give a number greater than 0, max or world");
    return SetSpeed{SetSpeed::Kind::kFactor, *factor};
}

Parsed window(const Words& words) {
    if (words[1] == "auto") return SetWindow{};
    const std::optional<std::int64_t> ticks = whole(words[1]);
    if (!ticks || *ticks == 0) return bad_value(words, "give a whole number of ticks, or auto");
    return SetWindow{*ticks};
}

Parsed simulators(const Words& words) {
    if (words.size() == 2 && words[1] == "add") return AddSimulator{};
    if (words.size() == 2 && words[1] == "remove") return RemoveSimulator{};
    if (words.size() != 3 || words[1] != "kill") return unknown(words);
    const std::optional<std::int64_t> id = whole(words[2]);
    if (!id || *id >= RobotId::kNone) return bad_value(words, "give a Simulator's id from `status`");
    return KillSimulator{static_cast<std::uint32_t>(*id)};
}

/// [#BRANCH@]TIME; branch 0: none is given.
std::optional<RewindRun> moment(const std::string& text) {
    RewindRun moment;
    const std::size_t at = text.find('@');
    const std::optional<double> time_s = read_number(at == std::string::npos ? text : text.substr(at + 1));
    if (!time_s) return std::nullopt;
    moment.time_s = *time_s;
    if (at == std::string::npos || at == 0) return moment;
    const std::optional<std::int64_t> branch = text[0] == '#' ? whole(text.substr(1, at - 1)) : std::nullopt;
    if (!branch || *branch == 0) return std::nullopt;
    moment.branch = *branch;
    return moment;
}

constexpr const char* kMoment = "give a time in s, or #BRANCH@TIME";

Parsed rewind(const Words& words) {
    const std::optional<RewindRun> to = moment(words[1]);
    if (!to) return bad_value(words, kMoment);
    return *to;
}

Parsed preview(const Words& words) {
    const std::optional<RewindRun> of = moment(words[1]);
    if (!of) return bad_value(words, kMoment);
    return PreviewRun{of->branch, of->time_s};
}

/// NAME [MOMENT], or "remove" and a number.
Parsed bookmark(const Words& words) {
    if (words.size() == 2) return AddBookmark{words[1]};
    if (words[1] == "remove") {
        const std::optional<std::int64_t> id = whole(words[2]);
        if (!id) return bad_value(words, "give the number of a bookmark from `timeline`");
        return RemoveBookmark{*id};
    }
    const std::optional<RewindRun> at = moment(words[2]);
    if (!at) return bad_value(words, kMoment);
    if (at->time_s < 0) return bad_value(words, "a time is at least 0 s");
    return AddBookmark{words[1], at->branch, at->time_s};
}

Parsed reset(const Words& words) {
    if (words.size() == 1 || words[1] == "start") return ResetRun{};
    if (words[1] == "save") return ResetRun{ResetRun::To::kLastSave};
    return bad_value(words, "give start or save");
}

Parsed accuracy(const Words& words) {
    ChangeAccuracy change;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        if (equals == std::string::npos) {
            change.setting = words[i];
            continue;
        }
        const std::optional<double> value = read_number(words[i].substr(equals + 1));
        if (!value) return bad_value(words, "give NAME=NUMBER");
        change.numbers.push_back({words[i].substr(0, equals), *value});
    }
    return change;
}

Error bad_pose(const std::string& text, const std::string& wanted) {
    return Error{"'" + text.substr(0, kShownMost) + "' is not a pose", wanted, "bad-pose"};
}

/// Lines "NAME x y z roll pitch yaw"; empty ones, and what follows a #, are skipped.
Result<std::vector<CopyPlace>> copies_of(const std::string& text) {
    std::vector<CopyPlace> copies;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line.substr(0, line.find('#')));
        CopyPlace copy;
        if (!(words >> copy.name)) continue;
        std::string pose;
        std::getline(words, pose);
        const std::optional<Pose> X_WA = pose_of(pose);
        if (!X_WA) return bad_pose(line, "write lines NAME x y z roll pitch yaw, m and rad");
        copy.X_WA = *X_WA;
        copies.push_back(std::move(copy));
    }
    if (copies.empty()) return bad_pose(text, "write at least one line NAME x y z roll pitch yaw, m and rad");
    return copies;
}

constexpr const char* kOnGround = "on-ground";  // last word of an addition

Parsed add(const Words& words) {
    const std::optional<Pose> X_WA = pose_of(words[3]);
    if (!X_WA) return bad_pose(words[3], "give \"x y z roll pitch yaw\", m and rad");
    AddModels add{words[1], words[2], *X_WA, words[4]};
    add.on_ground = words.size() > 5 && words.back() == kOnGround;
    const std::size_t rest = words.size() - (add.on_ground ? 1 : 0);
    if (rest < 6) return add;
    if (rest > 6) return bad_value(words, "the word behind the copies is on-ground, or none");
    Result<std::vector<CopyPlace>> copies = copies_of(words[5]);
    if (!copies) return copies.error();
    add.copies = std::move(copies).value();
    return add;
}

Parsed copy(const Words& words) {
    CopyRobots copies;
    for (std::size_t i = 1; i + 2 < words.size(); i += 3) {
        const std::optional<Pose> X_WR = pose_of(words[i + 2]);
        if (!X_WR) return bad_pose(words[i + 2], "give \"x y z roll pitch yaw\", m and rad");
        copies.copies.push_back({words[i], words[i + 1], *X_WR});
    }
    return copies;
}

Parsed parse(const Words& words) {
    if (words.empty()) return unknown(words);
    const std::string& verb = words[0];
    const std::size_t n = words.size();
    if (verb == "status" && n == 1) return GetStatus{true};
    if (verb == "groups" && n == 1) return GetGroups{};
    if (verb == "bounds" && n == 1) return GetBounds{};
    if (verb == "profile" && n == 1) return GetProfile{};
    if (verb == "pause" && n == 1) return PauseRun{};
    if (verb == "resume" && n == 1) return ResumeRun{};
    if (verb == "quit" && n == 1) return QuitRun{};
    if (verb == "reset" && n <= 2) return reset(words);
    if (verb == "step" && n <= 2) return step(words);
    if (verb == "speed" && n == 2) return speed(words);
    if (verb == "window" && n == 2) return window(words);
    if (verb == "simulators" && n >= 2) return simulators(words);
    if (verb == "save" && n == 2) return SaveRun{words[1]};
    if (verb == "save" && n == 3 && words[2] == "overwrite") return SaveRun{words[1], true};
    if (verb == "rewind" && n == 2) return rewind(words);
    if (verb == "timeline" && n == 1) return GetTimeline{};
    if (verb == "preview" && n == 2) return preview(words);
    if (verb == "bookmark" && (n == 2 || n == 3)) return bookmark(words);
    if (verb == "accuracy" && n >= 2) return accuracy(words);
    if (verb == "add" && n >= 5 && n <= 7) return add(words);
    if (verb == "remove" && n >= 2) return RemoveRobots{{words.begin() + 1, words.end()}};
    if (verb == "copy" && n >= 4 && n % 3 == 1) return copy(words);
    if (verb == "restore" && n >= 2) return RestoreRobots{{words.begin() + 1, words.end()}};
    return unknown(words);
}

}  // namespace

Result<ControlAction> parse_control(const Words& words) {
    Parsed parsed = parse(words);
    if (!parsed) return parsed;
    if (const char* broken = broken_rule(parsed.value())) {
        if (std::holds_alternative<AddModels>(parsed.value()))
            return Error{"'" + words[words.size() > 5 ? 5 : 3].substr(0, kShownMost) + "': " + broken,
                         "give \"x y z roll pitch yaw\", m and rad", "bad-pose"};
        return bad_value(words, broken);
    }
    return parsed;
}

}  // namespace roboss
