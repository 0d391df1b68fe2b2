// Names and rules of requests.
#include "wire/control.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/order.h"

namespace roboss {
namespace {

constexpr Tick kMostTicks = Tick{1} << 50;
constexpr Tick kLongestWindow = 1'000'000;
constexpr double kLatest_s = 1e12;
constexpr std::uint32_t kLongestPatience_ms = 10'000;
constexpr std::size_t kLongestName = 200;

template <class T>
const char* rule(const T&) {
    return nullptr;
}
const char* rule(const StepRun& step) {
    return step.ticks >= 1 && step.ticks <= kMostTicks ? nullptr : "a number of ticks is at least 1";
}
const char* rule(const SetSpeed& speed) {
    if (speed.kind > SetSpeed::Kind::kWorld) return "its kind of speed is unknown";
    return speed.kind != SetSpeed::Kind::kFactor || (speed.factor >= kSlowest && speed.factor <= kFastest)
               ? nullptr
               : "a speed is from 0.001 to 1000000";
}
const char* rule(const SetWindow& window) {
    return window.ticks >= 0 && window.ticks <= kLongestWindow ? nullptr : "a window has 1 to 1000000 ticks";
}
const char* rule(const SaveRun& save) {
    return save.file.empty() ? "it names no file" : nullptr;
}
const char* rule(const RewindRun& rewind) {
    if (rewind.branch < 0) return "a branch is at least 1";
    return rewind.time_s >= 0 && rewind.time_s < kLatest_s ? nullptr : "a time is at least 0 s";
}
const char* rule(const PreviewRun& preview) {
    if (preview.patience_ms > kLongestPatience_ms) return "a preview waits for at most 10000 ms";
    return rule(RewindRun{preview.branch, preview.time_s});
}
const char* rule(const AddBookmark& bookmark) {
    if (bookmark.name.empty() || bookmark.name.size() > kLongestName)
        return "a bookmark's name has 1 to 200 bytes";
    if (bookmark.branch < 0) return "a branch is at least 1";
    return bookmark.time_s < kLatest_s ? nullptr : "a time is at least 0 s";
}
const char* rule(const RemoveBookmark& bookmark) {
    return bookmark.id >= 1 ? nullptr : "the number of a bookmark is at least 1";
}
const char* rule(const ChangeAccuracy& change) {
    if (change.setting.empty() && change.numbers.empty()) return "it names no setting and no number";
    const auto finite = [](const ChangeAccuracy::Number& n) { return std::isfinite(n.value); };
    return std::ranges::all_of(change.numbers, finite) ? nullptr : "a number is not finite";
}
const char* rule(const Pose& X) {
    const Vec3& p = X.p;
    const Quat& q = X.q;
    for (const double x : {p.x, p.y, p.z})
        if (!(std::fabs(x) <= kOrderLimits.position)) return "a pose is beyond 1e9 m";
    const double norm_squared = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    return std::fabs(norm_squared - 1) < 1e-6 ? nullptr : "a pose's quaternion has not length 1";
}
const char* rule(const AddModels& add) {
    for (const CopyPlace& copy : add.copies)
        if (const char* broken = rule(copy.X_WA)) return broken;
    return rule(add.X_WA);
}
const char* rule(const RemoveRobots& remove) {
    return remove.names.empty() ? "it names no robot" : nullptr;
}
const char* rule(const CopyRobots& copy) {
    if (copy.copies.empty()) return "it names no robot";
    for (const CopyRobots::Copy& one : copy.copies) {
        if (one.name.empty()) return "a copy needs a name";
        if (const char* broken = rule(one.X_WR)) return broken;
    }
    return nullptr;
}
const char* rule(const RestoreRobots& restore) {
    return restore.names.empty() ? "it names no robot" : nullptr;
}

}  // namespace

const char* control_verb(const ControlAction& action) {
    static constexpr std::array kVerbs{"status",
                                       "groups",
                                       "bounds",
                                       "pause",
                                       "resume",
                                       "step",
                                       "speed",
                                       "window",
                                       "simulators add",
                                       "simulators remove",
                                       "simulators kill",
                                       "save",
                                       "quit",
                                       "rewind",
                                       "accuracy",
                                       "add",
                                       "remove",
                                       "reset",
                                       "timeline",
                                       "preview",
                                       "bookmark",
                                       "bookmark remove",
                                       "copy",
                                       "restore",
                                       "profile"};
    static_assert(kVerbs.size() == std::variant_size_v<ControlAction>);
    return kVerbs[action.index()];
}

bool only_asks(const ControlAction& action) {
    return std::holds_alternative<GetStatus>(action) || std::holds_alternative<GetGroups>(action) ||
           std::holds_alternative<GetBounds>(action) || std::holds_alternative<GetTimeline>(action) ||
           std::holds_alternative<PreviewRun>(action) || std::holds_alternative<GetProfile>(action);
}

const char* broken_rule(const ControlAction& action) {
    return std::visit([](const auto& a) { return rule(a); }, action);
}

}  // namespace roboss
