// One description of every message's fields, used by the encoder and by the decoder.
#include "wire/codec.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/archive.h"

namespace roboss {

namespace wire {
namespace {

/// Types whose memory is their encoding, so that a vector of them is copied at once.
template <class T>
constexpr bool kPlain = std::is_same_v<T, std::uint8_t> || std::is_same_v<T, std::uint32_t> ||
                        std::is_same_v<T, std::int32_t> || std::is_same_v<T, RobotId>;
static_assert(sizeof(RobotId) == 4);

/// Of an island in a WindowResult: which fields it has besides its cost.
constexpr std::uint8_t kContacts = 1, kStaticContacts = 2, kFailure = 4;
std::uint8_t told_of(const IslandResult& island) {
    return static_cast<std::uint8_t>((island.contacts > 0 ? kContacts : 0) |
                                     (island.static_contacts > 0 ? kStaticContacts : 0) |
                                     (island.failed.valid() ? kFailure : 0));
}

/// Of an Address' role: its instance is 0.
constexpr std::uint8_t kAlone = 0x80;

/// The least bytes of an item, to reserve memory for lists.
template <class T>
constexpr std::size_t kLeastBytes = 1;
template <>
constexpr std::size_t kLeastBytes<Order> = 25;
template <>
constexpr std::size_t kLeastBytes<RobotResult> = 42;
template <>
constexpr std::size_t kLeastBytes<EarlierBox> = 25;
template <>
constexpr std::size_t kLeastBytes<IslandResult> = 2;

/// Items of a list, at most: each may be many times as large here as its bytes.
constexpr std::size_t kItemsMost = std::size_t{1} << 22;

/// The same count, or 0 if it is too large.
inline std::size_t of_a_list(Reader& a, std::size_t n) {
    if (n > kItemsMost) a.fail("a list has too many items");
    return a.failed() ? 0 : n;
}

template <class A, class... Fields>
void fields(A& a, Fields&... values);

template <class T>
void field(Writer& a, const std::vector<T>& values);
template <class T>
void field(Reader& a, std::vector<T>& values);
template <class... T>
void field(Writer& a, const std::variant<T...>& value);
template <class... T>
void field(Reader& a, std::variant<T...>& value);

/// The first fields of small messages about an assignment.
template <class A, class Epoch, class Window, class Attempt>
void head(A& a, Epoch& epoch, Window& window, Attempt& attempt) {
    compact(a, epoch);
    compact(a, window);
    compact(a, attempt);
}

/// A list, mostly a short one.
template <class T, class Each>
void short_list(Writer& a, const std::vector<T>& values, const Each& each) {
    compact(a, values.size());
    for (const T& value : values) each(value);
}
template <class T, class Each>
void short_list(Reader& a, std::vector<T>& values, const Each& each) {
    std::uint64_t n = 0;
    compact(a, n);
    values.clear();
    values.resize(of_a_list(a, a.plausible(n, kLeastBytes<T>)));
    for (std::size_t i = 0; i < values.size() && !a.failed(); ++i) each(values[i]);
}

/// What is to be encoded, or what is to be filled.
template <class T>
const T& given(Writer&, const std::optional<T>& value) {
    return *value;
}
template <class T>
T& given(Reader&, std::optional<T>& value) {
    return value.emplace();
}

/// Ids of a list are mostly close to each other: encodes the signed difference to the last one.
inline void next_robot(Writer& a, RobotId robot, std::uint32_t& last) {
    const std::uint32_t gap = robot.value - last;
    compact(a, (gap << 1) ^ (0 - (gap >> 31)));
    last = robot.value;
}
inline void next_robot(Reader& a, RobotId& robot, std::uint32_t& last) {
    std::uint32_t folded = 0;
    compact(a, folded);
    last += (folded >> 1) ^ (0 - (folded & 1));
    robot = RobotId(last);
}

/// The Controller is the only one of its role, so its instance, 0, is not encoded.
inline void field(Writer& a, const Address& m) {
    const auto& [role, instance] = m;
    const bool alone = instance == 0;
    a.scalar(static_cast<std::uint8_t>(static_cast<std::uint8_t>(role) | (alone ? kAlone : 0)));
    if (!alone) a.scalar(instance);
}
inline void field(Reader& a, Address& m) {
    std::uint8_t role = 0;
    a.scalar(role);
    m = {static_cast<Role>(role & ~kAlone), 0};
    if (m.role > Role::kClient) a.fail("it names an unknown role");
    if ((role & kAlone) != 0) return;
    a.scalar(m.instance);
    if (m.instance == 0) a.fail("an address has no number");
}

// Each description first names all members of its struct, in order, and then encodes them: a forgotten new
// member breaks the build here.
// clang-format off
template <class A> void field(A& a, Of<A, Vec3>& m) { auto& [x, y, z] = m; fields(a, x, y, z); }
template <class A> void field(A& a, Of<A, Quat>& m) { auto& [w, x, y, z] = m; fields(a, w, x, y, z); }
template <class A> void field(A& a, Of<A, StateBlock>& m) { auto& [tick, robots, sizes, bytes] = m; fields(a, tick, robots, sizes, bytes); }
template <class A> void field(A& a, Of<A, Holding>& m) { auto& [source, robots] = m; fields(a, source, robots); }
template <class A> void field(A& a, Of<A, HandOver>& m) { auto& [to, robots] = m; fields(a, to, robots); }
template <class A> void field(A& a, Of<A, SetPose>& m) { auto& [X_WR] = m; auto& [p, q] = X_WR; fields(a, p, q); }
template <class A> void field(A& a, Of<A, SetVelocity>& m) { auto& [linear, angular] = m; fields(a, linear, angular); }
template <class A> void field(A& a, Of<A, ApplyWrench>& m) { auto& [link, force, torque, duration, replaces] = m; fields(a, link, force, torque, duration, replaces); }
template <class A> void field(A& a, Of<A, SetJoint>& m) {
    auto& [joint, axis, mode, target, max_effort] = m;
    fields(a, joint, axis, mode, target, max_effort);
    if constexpr (A::kReading) if (mode > MotorMode::kEffort) a.fail("a motor mode is unknown");
}
template <class A> void field(A& a, Of<A, Command>& m) { auto& [channel, values] = m; fields(a, channel, values); }
template <class A> void field(A& a, Of<A, Attach>& m) {
    auto& [link, other, other_link, reach, max_force, max_torque] = m;
    fields(a, link, other, other_link, reach, max_force, max_torque);
}
template <class A> void field(A& a, Of<A, Detach>& m) { auto& [other] = m; fields(a, other); }
template <class A> void field(A& a, Of<A, Pull>& m) {
    auto& [link, p_L, target_W, rate, max_force, duration] = m;
    fields(a, link, p_L, target_W, rate, max_force, duration);
}
template <class A> void field(A& a, Of<A, SetJointState>& m) { auto& [joint, position, velocity] = m; fields(a, joint, position, velocity); }
template <class A> void field(A& a, Of<A, Transmit>& m) { auto& [radio, to, payload] = m; fields(a, radio, to, payload); }
template <class A> void field(A& a, Of<A, JointParameterValue>& m) {
    auto& [parameter, value] = m;
    fields(a, parameter, value);
    if constexpr (A::kReading) if (static_cast<std::size_t>(parameter) >= kJointParameters) a.fail("a parameter of a joint is unknown");
}
template <class A> void field(A& a, Of<A, SetJointParameters>& m) { auto& [joint, axis, reset, values] = m; fields(a, joint, axis, reset, values); }
template <class A> void field(A& a, Of<A, LinkParameterValue>& m) {
    auto& [parameter, value] = m;
    fields(a, parameter, value);
    if constexpr (A::kReading) if (static_cast<std::size_t>(parameter) >= kLinkParameters) a.fail("a parameter of a link is unknown");
}
template <class A> void field(A& a, Of<A, SetLinkParameters>& m) { auto& [link, reset, values] = m; fields(a, link, reset, values); }
template <class A> void field(A& a, Of<A, OwnSurroundings>& m) {
    auto& [gravity, wind] = m;
    for (auto* value : {&gravity, &wind}) {
        bool there = value->has_value();
        field(a, there);
        if (there) field(a, given(a, *value));
    }
}
template <class A> void field(A& a, Of<A, SetSurroundings>& m) { auto& [reset, values] = m; fields(a, reset, values); }
template <class A> void field(A& a, Of<A, Order>& m) { auto& [apply_at, client, sequence, robot, action] = m; fields(a, apply_at, client, sequence, robot, action); }
template <class A> void field(A& a, Of<A, Hello>& m) { auto& [model_hash, threads, name] = m; fields(a, model_hash, threads, name); }
template <class A> void field(A& a, Of<A, Welcome>& m) { auto& [simulator] = m; fields(a, simulator); }
template <class A> void field(A& a, Of<A, Refused>& m) { auto& [reason] = m; fields(a, reason); }
template <class A> void field(A& a, Of<A, Expelled>& m) { auto& [simulator] = m; fields(a, simulator); }
template <class A> void field(A& a, Of<A, Heartbeat>& m) { auto& [simulator] = m; fields(a, simulator); }
template <class A> void field(A& a, Of<A, LeaveRequest>& m) { auto& [simulator] = m; fields(a, simulator); }
template <class A> void field(A& a, Of<A, Goodbye>& m) { auto& [simulator] = m; fields(a, simulator); }
template <class A> void field(A& a, Of<A, Assignment>& m) {
    auto& [epoch, window, attempt, simulator, window_from, from, until, island_offsets, robots, hand_offs, transfers, orders, ahead, keep,
           release_before, due_ns, measured] = m;
    fields(a, epoch, window, attempt, simulator, window_from, from, until, island_offsets, robots, hand_offs, transfers, orders, ahead, keep,
           release_before, due_ns, measured);
}
template <class A> void field(A& a, Of<A, OrdersAhead>& m) { auto& [window, simulator, orders] = m; fields(a, window, simulator, orders); }
template <class A> void field(A& a, Of<A, Late>& m) { auto& [epoch, window, attempt, needs_ns] = m; head(a, epoch, window, attempt); compact(a, needs_ns); }
template <class A> void field(A& a, Of<A, Cut>& m) { auto& [epoch, window, attempt, simulator] = m; head(a, epoch, window, attempt); field(a, simulator); }
template <class A> void field(A& a, Of<A, Box32>& m) { auto& [min, max] = m; fields(a, min, max); }
template <class A> void field(A& a, Of<A, IslandResult>& m) {
    auto& [cost_ns, contacts, static_contacts, failed, failed_at, failed_joint, beyond_numbers] = m;
    std::uint8_t told = told_of(m);
    field(a, told);
    compact(a, cost_ns);
    if ((told & kContacts) != 0) compact(a, contacts);
    if ((told & kStaticContacts) != 0) compact(a, static_contacts);
    if ((told & kFailure) != 0) fields(a, failed, failed_at, failed_joint, beyond_numbers);
    if constexpr (A::kReading) if (told != told_of(m)) a.fail("an island lacks a field that its flags announce");
}
template <class A> void field(A& a, Of<A, SolverProfile>& m) {
    auto& [islands, iterations, iterations_most, largest_island, most_contacts, largest_part, residual, friction_solves, friction_misses,
           friction_error, velocities, displacements] = m;
    fields(a, islands, iterations, iterations_most, largest_island, most_contacts, largest_part, residual, friction_solves, friction_misses,
           friction_error);
    for (auto* counts : {&velocities, &displacements})
        for (auto& count : *counts) compact(a, count);
}
template <class A> void field(A& a, Of<A, StepProfile>& m) {
    auto& [stages, solver] = m;
    for (auto& ns : stages.ns) compact(a, ns);
    field(a, solver);
}
template <class A> void field(A& a, Of<A, WindowResult>& m) {
    auto& [epoch, window, attempt, left, robots, earlier, islands, profile] = m;
    head(a, epoch, window, attempt);
    compact(a, left);
    std::uint32_t last = 0;
    short_list(a, robots, [&](auto& r) {
        auto& [robot, swept, position, velocity, hash] = r;
        next_robot(a, robot, last);
        fields(a, swept, position, velocity, hash);
    });
    short_list(a, earlier, [&](auto& e) { auto& [robot, swept] = e; next_robot(a, robot, last); field(a, swept); });
    short_list(a, islands, [&](auto& i) { field(a, i); });
    bool measured = profile.has_value();
    field(a, measured);
    if (measured) field(a, given(a, profile));
}
template <class A> void field(A& a, Of<A, StateRequest>& m) { auto& [tick, robots, window] = m; fields(a, tick, window, robots); }
template <class A> void field(A& a, Of<A, StateReply>& m) { auto& [states, window] = m; fields(a, window, states); }
template <class A> void field(A& a, Of<A, ClientHello>& m) {
    auto& [name, model_hash, period, latency, synchronous, observer, expected, acknowledged, last_reply] = m;
    fields(a, name, model_hash, period, latency, synchronous, observer, expected, acknowledged, last_reply);
}
template <class A> void field(A& a, Of<A, ClientWelcome>& m) { auto& [client, first, seed] = m; fields(a, client, first, seed); }
template <class A> void field(A& a, Of<A, Observation>& m) { auto& [tick, last_reply, holders] = m; fields(a, tick, last_reply, holders); }
template <class A> void field(A& a, Of<A, ClientOrder>& m) { auto& [sequence, robot, action] = m; fields(a, sequence, robot, action); }
template <class A> void field(A& a, Of<A, ClientReply>& m) { auto& [client, number, observed, orders, acknowledged] = m; fields(a, client, number, observed, orders, acknowledged); }
template <class A> void field(A& a, Of<A, RefusedOrder>& m) { auto& [sequence, reason, code] = m; fields(a, sequence, reason, code); }
template <class A> void field(A& a, Of<A, ReplyAck>& m) { auto& [client, number, refused] = m; fields(a, client, number, refused); }
template <class A> void field(A& a, Of<A, ClientBye>& m) { auto& [client, number, failed, reason] = m; fields(a, client, number, failed, reason); }
template <class A> void field(A& a, Of<A, RunOver>& m) { auto& [reason, failed] = m; fields(a, reason, failed); }
template <class A> void field(A& a, Of<A, ClientUnknown>& m) { auto& [client] = m; fields(a, client); }
template <class A> void field(A&, Of<A, GetGroups>&) { static_assert(std::is_empty_v<GetGroups>); }
template <class A> void field(A&, Of<A, GetBounds>&) { static_assert(std::is_empty_v<GetBounds>); }
template <class A> void field(A&, Of<A, GetProfile>&) { static_assert(std::is_empty_v<GetProfile>); }
template <class A> void field(A&, Of<A, PauseRun>&) { static_assert(std::is_empty_v<PauseRun>); }
template <class A> void field(A&, Of<A, ResumeRun>&) { static_assert(std::is_empty_v<ResumeRun>); }
template <class A> void field(A&, Of<A, AddSimulator>&) { static_assert(std::is_empty_v<AddSimulator>); }
template <class A> void field(A&, Of<A, RemoveSimulator>&) { static_assert(std::is_empty_v<RemoveSimulator>); }
template <class A> void field(A&, Of<A, QuitRun>&) { static_assert(std::is_empty_v<QuitRun>); }
template <class A> void field(A& a, Of<A, ResetRun>& m) {
    auto& [to] = m;
    field(a, to);
    if constexpr (A::kReading) if (to > ResetRun::To::kLastSave) a.fail("the place to reset to is unknown");
}
template <class A> void field(A&, Of<A, GetTimeline>&) { static_assert(std::is_empty_v<GetTimeline>); }
template <class A> void field(A& a, Of<A, PreviewRun>& m) { auto& [branch, time_s, patience_ms] = m; fields(a, branch, time_s, patience_ms); }
template <class A> void field(A& a, Of<A, AddBookmark>& m) { auto& [name, branch, time_s] = m; fields(a, name, branch, time_s); }
template <class A> void field(A& a, Of<A, RemoveBookmark>& m) { auto& [id] = m; fields(a, id); }
template <class A> void field(A& a, Of<A, StageTime>& m) { auto& [name, seconds] = m; fields(a, name, seconds); }
template <class A> void field(A& a, Of<A, RunProfile>& m) {
    auto& [ticks, stages, islands, largest_island, most_contacts, largest_part, iterations, iterations_most, residual, friction_solves,
           friction_misses, friction_error, friction_tolerance] = m;
    fields(a, ticks, stages, islands, largest_island, most_contacts, largest_part, iterations, iterations_most, residual, friction_solves,
           friction_misses, friction_error, friction_tolerance);
}
template <class A> void field(A& a, Of<A, TimelineBranch>& m) { auto& [id, parent, begin_s, first_s, end_s, reason] = m; fields(a, id, parent, begin_s, first_s, end_s, reason); }
template <class A> void field(A& a, Of<A, TimelineBookmark>& m) { auto& [id, branch, time_s, name] = m; fields(a, id, branch, time_s, name); }
template <class A> void field(A& a, Of<A, RunTimeline>& m) { auto& [serial, branch, branches, bookmarks] = m; fields(a, serial, branch, branches, bookmarks); }
template <class A> void field(A& a, Of<A, RunPreview>& m) {
    auto& [model_hash, branch, tick, time_s, exact, gone, absent, entries] = m;
    fields(a, model_hash, branch, tick, time_s, exact, gone, absent, entries);
}
template <class A> void field(A& a, Of<A, GetStatus>& m) { auto& [robots] = m; fields(a, robots); }
template <class A> void field(A& a, Of<A, StepRun>& m) { auto& [ticks] = m; fields(a, ticks); }
template <class A> void field(A& a, Of<A, SetSpeed>& m) { auto& [kind, factor] = m; fields(a, kind, factor); }
template <class A> void field(A& a, Of<A, SetWindow>& m) { auto& [ticks] = m; fields(a, ticks); }
template <class A> void field(A& a, Of<A, KillSimulator>& m) { auto& [id] = m; fields(a, id); }
template <class A> void field(A& a, Of<A, SaveRun>& m) { auto& [file, overwrite] = m; fields(a, file, overwrite); }
template <class A> void field(A& a, Of<A, RewindRun>& m) { auto& [branch, time_s] = m; fields(a, branch, time_s); }
template <class A> void field(A& a, Of<A, ChangeAccuracy::Number>& m) { auto& [name, value] = m; fields(a, name, value); }
template <class A> void field(A& a, Of<A, ChangeAccuracy>& m) { auto& [setting, numbers] = m; fields(a, setting, numbers); }
template <class A> void field(A& a, Of<A, CopyPlace>& m) { auto& [name, X_WA] = m; auto& [p, q] = X_WA; fields(a, name, p, q); }
template <class A> void field(A& a, Of<A, AddModels>& m) { auto& [file, content, X_WA, name, copies, on_ground] = m; auto& [p, q] = X_WA; fields(a, file, content, p, q, name, copies, on_ground); }
template <class A> void field(A& a, Of<A, RemoveRobots>& m) { auto& [names] = m; fields(a, names); }
template <class A> void field(A& a, Of<A, CopyRobots::Copy>& m) { auto& [robot, name, X_WR] = m; auto& [p, q] = X_WR; fields(a, robot, name, p, q); }
template <class A> void field(A& a, Of<A, CopyRobots>& m) { auto& [copies] = m; fields(a, copies); }
template <class A> void field(A& a, Of<A, RestoreRobots>& m) { auto& [names] = m; fields(a, names); }
template <class A> void field(A& a, Of<A, MessageRate>& m) { auto& [messages_in, messages_out, bytes_in, bytes_out] = m; fields(a, messages_in, messages_out, bytes_in, bytes_out); }
template <class A> void field(A& a, Of<A, MemberStatus>& m) {
    auto& [id, name, state, threads, robots, islands, step_us, load, messages, own_process] = m;
    fields(a, id, name, state, threads, robots, islands, step_us, load, messages, own_process);
    if constexpr (A::kReading) if (state > MemberState::kLost) a.fail("the state of a member is unknown");
}
template <class A> void field(A& a, Of<A, RunStatus>& m) {
    auto& [world, tick, time_s, paused, over, speed, islands, window, windows, repeated, efficiency, step_cpu_s, losses, recoveries, migrations, cuts,
           messages, model_hash, state_hash, branch, first_s, timeline, journal_bytes, journal_mb_per_min, replay, members, robots, robot_count] = m;
    fields(a, world, tick, time_s, paused, over, speed, islands, window, windows, repeated, efficiency, step_cpu_s, losses, recoveries, migrations, cuts,
           messages, model_hash, state_hash, branch, first_s, timeline, journal_bytes, journal_mb_per_min, replay, members, robots, robot_count);
}
template <class A> void field(A& a, Of<A, RobotGroups>& m) { auto& [model_hash, simulator, island] = m; fields(a, model_hash, simulator, island); }
template <class A> void field(A& a, Of<A, RobotBounds>& m) { auto& [model_hash, boxes] = m; fields(a, model_hash, boxes); }
template <class A> void field(A& a, Of<A, ControlDone>& m) { auto& [tick, text] = m; fields(a, tick, text); }
template <class A> void field(A& a, Of<A, ControlRefused>& m) { fields(a, m.message, m.remedy, m.code); }
template <class A> void field(A& a, Of<A, ControlRequest>& m) { auto& [number, action] = m; fields(a, number, action); }
template <class A> void field(A& a, Of<A, ControlReply>& m) { auto& [number, outcome] = m; fields(a, number, outcome); }
template <class A> void field(A& a, Of<A, ModelChanged>& m) { auto& [model_hash] = m; fields(a, model_hash); }
template <class A> void field(A& a, Of<A, ModelRequest>& m) { auto& [what, offset] = m; fields(a, what, offset); }
template <class A> void field(A& a, Of<A, ModelPart>& m) { auto& [what, bytes_hash, total, offset, bytes] = m; fields(a, what, bytes_hash, total, offset, bytes); }
template <class A> void field(A& a, Of<A, ViewRequest>& m) {
    auto& [model_hash, interval_ms, exact_interval_ms, exact_all, exact] = m;
    fields(a, model_hash, interval_ms, exact_interval_ms, exact_all, exact);
}
template <class A> void field(A& a, Of<A, ViewDue>& m) { auto& [epoch, serial, tick, viewer, robots, exact] = m; fields(a, epoch, serial, tick, viewer, robots, exact); }
template <class A> void field(A& a, Of<A, ViewSurface>& m) { auto& [robot, link, linear_L, angular_L, belt_L] = m; fields(a, robot, link, linear_L, angular_L, belt_L); }
template <class A> void field(A& a, Of<A, ViewBond>& m) { auto& [holder, link, other, other_link, p_L] = m; fields(a, holder, link, other, other_link, p_L); }
template <class A> void field(A& a, Of<A, ViewExtras>& m) { auto& [surfaces, bonds] = m; fields(a, surfaces, bonds); }
template <class A> void field(A& a, Of<A, ViewStates>& m) { auto& [model_hash, epoch, serial, tick, entries, extras] = m; fields(a, model_hash, epoch, serial, tick, entries, extras); }
// clang-format on

template <class A, class... Fields>
void fields(A& a, Fields&... values) {
    (field(a, values), ...);
}

template <class T>
void field(Writer& a, const std::vector<T>& values) {
    a.count(values.size());
    if constexpr (kPlain<T>) {
        a.raw(values.data(), values.size() * sizeof(T));
    } else {
        for (const T& value : values) field(a, value);
    }
}

template <class T>
void field(Reader& a, std::vector<T>& values) {
    values.clear();
    if constexpr (kPlain<T>) {
        values.resize(a.count(sizeof(T)));
        a.raw(values.data(), values.size() * sizeof(T));
    } else {
        constexpr std::size_t least = kLeastBytes<T>;
        const std::size_t n = of_a_list(a, a.count(least));
        if (least > 1) values.reserve(n);
        for (std::size_t i = 0; i < n && !a.failed(); ++i) field(a, values.emplace_back());
    }
}

template <class... T>
void field(Writer& a, const std::variant<T...>& value) {
    a.scalar(static_cast<std::uint8_t>(value.index()));
    std::visit([&a](const auto& alternative) { field(a, alternative); }, value);
}

template <class Variant, std::size_t I = 0>
void read_alternative(Reader& a, std::size_t index, Variant& value) {
    if constexpr (I < std::variant_size_v<Variant>) {
        if (index == I) return field(a, value.template emplace<I>());
        read_alternative<Variant, I + 1>(a, index, value);
    } else {
        a.fail("it is of an unknown kind");
    }
}

template <class... T>
void field(Reader& a, std::variant<T...>& value) {
    std::uint8_t index = 0;
    a.scalar(index);
    if (!a.failed()) read_alternative(a, index, value);
}

// Rules beyond the fields' types on which every receiver relies. They need no Model; the receiving role
// checks what does.

/// Bounded so that sums of two ticks do not overflow. -1: before the first.
bool in_range(Tick tick) {
    constexpr Tick kFarthest = Tick{1} << 60;
    return tick >= -1 && tick <= kFarthest;
}
constexpr const char* kTickOutOfRange = "a tick is out of range";

template <class Orders>
const char* broken_rule_of(const Orders& orders) {
    const bool fine =
        std::all_of(orders.begin(), orders.end(), [](const auto& o) { return in_range(o.apply_at); });
    return fine ? nullptr : kTickOutOfRange;
}

/// Sorting and comparing boxes relies on numbers.
bool is_number(const Box32& box) {
    const auto number = [](float x) { return !std::isnan(x); };
    return std::all_of(box.min.begin(), box.min.end(), number) &&
           std::all_of(box.max.begin(), box.max.end(), number);
}

const char* broken_rule(const StateBlock& block) {
    std::uint64_t bytes = 0;
    for (const std::uint32_t size : block.sizes) bytes += size;
    if (block.sizes.size() != block.robots.size()) return "it has not one size a robot";
    if (bytes != block.bytes.size()) return "the sizes do not add up to its bytes";
    return in_range(block.tick) ? nullptr : kTickOutOfRange;
}

const char* broken_rule(const Assignment& assignment) {
    const auto& offsets = assignment.island_offsets;
    if (offsets.empty() || offsets.front() != 0 || offsets.back() != assignment.robots.size())
        return "its islands do not cover its robots";
    for (std::size_t i = 1; i < offsets.size(); ++i)
        if (offsets[i] <= offsets[i - 1]) return "one of its islands is empty";
    for (const Tick tick :
         {assignment.window_from, assignment.from, assignment.until, assignment.release_before})
        if (!in_range(tick)) return kTickOutOfRange;
    if (assignment.window_from < 0 || assignment.until < assignment.from ||
        assignment.from < assignment.window_from)
        return "it ends before it starts";
    const bool inside =
        std::all_of(assignment.orders.begin(), assignment.orders.end(), [&](const Order& order) {
            return assignment.from <= order.apply_at && order.apply_at < assignment.until;
        });
    return inside ? nullptr : "one of its orders is for a tick that it does not step";
}

const char* broken_rule(const OrdersAhead& ahead) {
    return broken_rule_of(ahead.orders);
}

const char* broken_rule(const WindowResult& result) {
    const bool told = result.left == 0 || (result.robots.empty() && result.earlier.empty());
    if (!told) return "it was cut short and lists robots";
    const auto numbers = [](const auto& entry) { return is_number(entry.swept); };
    if (!std::all_of(result.robots.begin(), result.robots.end(), numbers) ||
        !std::all_of(result.earlier.begin(), result.earlier.end(), numbers))
        return "a robot's bound is not a number";
    const bool known = std::all_of(result.islands.begin(), result.islands.end(),
                                   [](const IslandResult& island) { return in_range(island.failed_at); });
    return known ? nullptr : kTickOutOfRange;
}

const char* broken_rule(const StateReply& reply) {
    return broken_rule(reply.states);
}

const char* broken_rule(const StateRequest& request) {
    return in_range(request.tick) ? nullptr : kTickOutOfRange;
}

const char* broken_rule(const Observation& observation) {
    return in_range(observation.tick) ? nullptr : kTickOutOfRange;
}

const char* broken_rule(const ClientWelcome& welcome) {
    return in_range(welcome.first) ? nullptr : kTickOutOfRange;
}

const char* broken_rule(const ClientReply& reply) {
    return in_range(reply.observed) ? nullptr : kTickOutOfRange;
}

const char* broken_rule(const ViewDue& due) {
    return in_range(due.tick) ? nullptr : kTickOutOfRange;
}

const char* broken_rule(const ViewStates& views) {
    return in_range(views.tick) ? nullptr : kTickOutOfRange;
}

const char* broken_rule(const Hello& hello) {
    constexpr std::uint32_t kThreadsMost = 1u << 16;
    return hello.threads >= 1 && hello.threads <= kThreadsMost ? nullptr
                                                               : "its number of threads is out of range";
}

const char* broken_rule(const ClientHello& hello) {
    constexpr Tick kLongest = Tick{1} << 50;
    return hello.period < 1 || hello.period > kLongest || hello.latency < 0 || hello.latency > kLongest ||
                   !in_range(hello.expected) || hello.last_reply < hello.acknowledged
               ? "its period or latency is out of range"
               : nullptr;
}

const char* broken_rule(const ControlRequest& request) {
    return roboss::broken_rule(request.action);
}

const char* broken_rule(const ModelRequest& request) {
    return request.what > Whole::kVisuals ? "it asks for something unknown" : nullptr;
}

const char* broken_rule(const ModelPart& part) {
    if (part.what > Whole::kVisuals) return "it is of something unknown";
    const bool inside = part.offset <= part.total && part.bytes.size() <= part.total - part.offset;
    return inside ? nullptr : "it goes beyond the end of the whole";
}

template <class T>
const char* broken_rule(const T&) {
    return nullptr;
}

}  // namespace
}  // namespace wire

const char* message_name(const Message& message) {
    static constexpr const char* kNames[] = {
        "Hello",         "Welcome",     "Refused",       "Expelled",       "Heartbeat",    "LeaveRequest",
        "Goodbye",       "Assignment",  "WindowResult",  "StateRequest",   "StateReply",   "ClientHello",
        "ClientWelcome", "Observation", "ClientReply",   "ReplyAck",       "ClientBye",    "RunOver",
        "ModelRequest",  "ModelPart",   "ClientUnknown", "ControlRequest", "ControlReply", "ModelChanged",
        "ViewRequest",   "ViewDue",     "ViewStates",    "OrdersAhead",    "Late",         "Cut"};
    static_assert(std::size(kNames) == std::variant_size_v<Message>);
    return kNames[message.index()];
}

std::vector<std::uint8_t> encode(const Envelope& envelope) {
    wire::Writer a;
    a.scalar(kWireVersion);
    wire::fields(a, envelope.from, envelope.to, envelope.message);
    return a.take();
}

namespace {

/// Takes the version at the start of a message; an Error: it is another one.
Result<> take_version(wire::Reader& a) {
    std::uint16_t version = 0;
    a.scalar(version);
    if (a.failed() || version == kWireVersion) return Ok{};
    return Error{"a message of wire version " + std::to_string(version) + ", this program speaks " +
                     std::to_string(kWireVersion),
                 "run the same version of RoBOSS everywhere"};
}

template <class Kind, std::size_t I = 0>
constexpr std::size_t index_of() {
    if constexpr (std::is_same_v<Kind, std::variant_alternative_t<I, Message>>)
        return I;
    else
        return index_of<Kind, I + 1>();
}

template <class... Kinds>
constexpr bool is_one_of(std::size_t kind) {
    return ((kind == index_of<Kinds>()) || ...);
}

}  // namespace

Result<EnvelopeEnds> decode_ends(std::span<const std::uint8_t> bytes) {
    wire::Reader a(bytes);
    if (Result<> version = take_version(a); !version) return version.error();
    EnvelopeEnds ends;
    std::uint8_t kind = 0;
    wire::fields(a, ends.from, ends.to, kind);
    ends.of_clients = is_one_of<ClientHello, ClientReply, ClientBye, ControlRequest, ModelRequest,
                                StateRequest, ViewRequest>(kind);
    if (!a.failed()) return ends;
    return Error{"a damaged message: " + a.failure(), "check what else sends to this port"};
}

Result<Envelope> decode_envelope(std::span<const std::uint8_t> bytes) {
    wire::Reader a(bytes);
    if (Result<> version = take_version(a); !version) return version.error();
    Envelope envelope;
    wire::fields(a, envelope.from, envelope.to, envelope.message);
    if (a.left() > 0) a.fail("bytes are left over behind it");
    if (!a.failed()) {
        const char* broken = std::visit([](const auto& m) { return wire::broken_rule(m); }, envelope.message);
        if (broken != nullptr) a.fail(broken);
    }
    if (!a.failed()) return envelope;
    return Error{"a damaged message of " + std::to_string(bytes.size()) + " bytes (" +
                     message_name(envelope.message) + "): " + a.failure(),
                 "check what else sends to this port"};
}

std::vector<std::uint8_t> encode_orders(const std::vector<Order>& orders) {
    wire::Writer a;
    wire::fields(a, orders);
    return a.take();
}

Result<std::vector<Order>> decode_orders(std::span<const std::uint8_t> bytes) {
    wire::Reader a(bytes);
    std::vector<Order> orders;
    wire::fields(a, orders);
    if (a.left() > 0) a.fail("bytes are left over behind them");
    if (a.failed()) return Error{"damaged orders: " + a.failure(), ""};
    return orders;
}

}  // namespace roboss
