// One description of every message's fields, used by the encoder and by the decoder.
#include "wire/codec.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wire/archive.h"

namespace roboss {

namespace wire {
namespace {

/// Types whose memory is their encoding, so that a vector of them is copied at once.
template <class T>
constexpr bool kPlain =
    std::is_same_v<T, std::uint8_t> || std::is_same_v<T, std::uint32_t> || std::is_same_v<T, RobotId>;
static_assert(sizeof(RobotId) == 4);

/// Of an island in a Frame: what it has to tell besides its cost.
constexpr std::uint8_t kContacts = 1, kStaticContacts = 2, kFailure = 4;
std::uint8_t told_of(const IslandFrame& island) {
    return static_cast<std::uint8_t>((island.contacts > 0 ? kContacts : 0) |
                                     (island.static_contacts > 0 ? kStaticContacts : 0) |
                                     (island.failed.valid() ? kFailure : 0));
}

/// Of an Address' role: it has no number.
constexpr std::uint8_t kAlone = 0x80;

/// What an item takes at least, so that room is made for many of them at once.
template <class T>
constexpr std::size_t kLeastBytes = 1;
template <>
constexpr std::size_t kLeastBytes<Order> = 25;
template <>
constexpr std::size_t kLeastBytes<RobotFrame> = 42;
template <>
constexpr std::size_t kLeastBytes<EarlierBox> = 25;
template <>
constexpr std::size_t kLeastBytes<IslandFrame> = 2;

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

/// What small messages about a plan begin with.
template <class A, class M>
void head(A& a, M& m) {
    compact(a, m.epoch);
    compact(a, m.window);
    compact(a, m.attempt);
}

/// A list that is mostly short.
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
    values.resize(a.plausible(n, kLeastBytes<T>));
    for (std::size_t i = 0; i < values.size() && !a.failed(); ++i) each(values[i]);
}

/// Robots of a list are mostly near each other: how far it is from the last one, in either direction.
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

/// The Controller is alone in its role, so its number, 0, need not be told.
inline void field(Writer& a, const Address& m) {
    const bool alone = m.instance == 0;
    a.scalar(static_cast<std::uint8_t>(static_cast<std::uint8_t>(m.role) | (alone ? kAlone : 0)));
    if (!alone) a.scalar(m.instance);
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

// clang-format off
template <class A> void field(A& a, Of<A, Vec3>& m) { fields(a, m.x, m.y, m.z); }
template <class A> void field(A& a, Of<A, Quat>& m) { fields(a, m.w, m.x, m.y, m.z); }
template <class A> void field(A& a, Of<A, StateBlock>& m) { fields(a, m.tick, m.robots, m.sizes, m.bytes); }
template <class A> void field(A& a, Of<A, Holding>& m) { fields(a, m.source, m.robots); }
template <class A> void field(A& a, Of<A, HandOver>& m) { fields(a, m.to, m.robots); }
template <class A> void field(A& a, Of<A, SetPose>& m) { fields(a, m.X_WR.p, m.X_WR.q); }
template <class A> void field(A& a, Of<A, SetVelocity>& m) { fields(a, m.linear, m.angular); }
template <class A> void field(A& a, Of<A, ApplyWrench>& m) { fields(a, m.link, m.force, m.torque, m.duration); }
template <class A> void field(A& a, Of<A, SetJoint>& m) {
    fields(a, m.joint, m.axis, m.mode, m.target, m.max_effort);
    if constexpr (A::kReading) if (m.mode > MotorMode::kEffort) a.fail("a motor mode is unknown");
}
template <class A> void field(A& a, Of<A, Order>& m) { fields(a, m.apply_at, m.client, m.sequence, m.robot, m.action); }
template <class A> void field(A& a, Of<A, Hello>& m) { fields(a, m.model_hash, m.threads, m.name); }
template <class A> void field(A& a, Of<A, Welcome>& m) { fields(a, m.simulator); }
template <class A> void field(A& a, Of<A, Refused>& m) { fields(a, m.reason); }
template <class A> void field(A& a, Of<A, Expelled>& m) { fields(a, m.simulator); }
template <class A> void field(A& a, Of<A, Alive>& m) { fields(a, m.simulator); }
template <class A> void field(A& a, Of<A, LeaveRequest>& m) { fields(a, m.simulator); }
template <class A> void field(A& a, Of<A, Goodbye>& m) { fields(a, m.simulator); }
template <class A> void field(A& a, Of<A, Plan>& m) {
    fields(a, m.epoch, m.window, m.attempt, m.simulator, m.window_from, m.from, m.until, m.island_offsets, m.robots, m.hand_offs, m.gives, m.orders,
           m.ahead, m.keep, m.release_before, m.due_ns);
}
template <class A> void field(A& a, Of<A, OrdersAhead>& m) { fields(a, m.window, m.simulator, m.orders); }
template <class A> void field(A& a, Of<A, Late>& m) { head(a, m); compact(a, m.needs_ns); }
template <class A> void field(A& a, Of<A, Cut>& m) { head(a, m); field(a, m.simulator); }
template <class A> void field(A& a, Of<A, Box32>& m) { fields(a, m.min, m.max); }
template <class A> void field(A& a, Of<A, IslandFrame>& m) {
    std::uint8_t told = told_of(m);
    field(a, told);
    compact(a, m.cost_ns);
    if ((told & kContacts) != 0) compact(a, m.contacts);
    if ((told & kStaticContacts) != 0) compact(a, m.static_contacts);
    if ((told & kFailure) != 0) fields(a, m.failed, m.failed_at);
    if constexpr (A::kReading) if (told != told_of(m)) a.fail("an island does not have what it tells of");
}
template <class A> void field(A& a, Of<A, Frame>& m) {
    head(a, m);
    compact(a, m.left);
    std::uint32_t last = 0;
    short_list(a, m.robots, [&](auto& r) {
        next_robot(a, r.robot, last);
        fields(a, r.swept, r.place, r.velocity, r.hash);
    });
    short_list(a, m.earlier, [&](auto& e) { next_robot(a, e.robot, last); field(a, e.swept); });
    short_list(a, m.islands, [&](auto& i) { field(a, i); });
}
template <class A> void field(A& a, Of<A, StateRequest>& m) { fields(a, m.tick, m.window, m.robots); }
template <class A> void field(A& a, Of<A, StateReply>& m) { fields(a, m.window, m.states); }
template <class A> void field(A& a, Of<A, ClientHello>& m) {
    fields(a, m.name, m.model_hash, m.period, m.latency, m.synchronous, m.guest, m.expected, m.acknowledged, m.said);
}
template <class A> void field(A& a, Of<A, ClientWelcome>& m) { fields(a, m.client, m.first, m.seed); }
template <class A> void field(A& a, Of<A, Observation>& m) { fields(a, m.tick, m.last_word, m.holders); }
template <class A> void field(A& a, Of<A, ClientOrder>& m) { fields(a, m.sequence, m.robot, m.action); }
template <class A> void field(A& a, Of<A, ClientWord>& m) { fields(a, m.client, m.word, m.observed, m.orders); }
template <class A> void field(A& a, Of<A, RefusedOrder>& m) { fields(a, m.sequence, m.reason); }
template <class A> void field(A& a, Of<A, WordAck>& m) { fields(a, m.client, m.word, m.refused); }
template <class A> void field(A& a, Of<A, ClientBye>& m) { fields(a, m.client, m.word, m.failed, m.reason); }
template <class A> void field(A& a, Of<A, RunOver>& m) { fields(a, m.reason); }
template <class A> void field(A& a, Of<A, ClientUnknown>& m) { fields(a, m.client); }
template <class A> void field(A& a, Of<A, ControlRequest>& m) { fields(a, m.number, m.words); }
template <class A> void field(A& a, Of<A, ControlReply>& m) { fields(a, m.number, m.done, m.text); }
template <class A> void field(A& a, Of<A, ModelChanged>& m) { fields(a, m.model_hash); }
template <class A> void field(A& a, Of<A, ModelRequest>& m) { fields(a, m.what, m.offset); }
template <class A> void field(A& a, Of<A, ModelPart>& m) { fields(a, m.what, m.bytes_hash, m.total, m.offset, m.bytes); }
template <class A> void field(A& a, Of<A, ViewRequest>& m) {
    fields(a, m.model_hash, m.interval_ms, m.exact_interval_ms, m.exact_all, m.exact);
}
template <class A> void field(A& a, Of<A, ViewDue>& m) { fields(a, m.epoch, m.serial, m.tick, m.viewer, m.robots, m.exact); }
template <class A> void field(A& a, Of<A, ViewStates>& m) { fields(a, m.model_hash, m.epoch, m.serial, m.tick, m.entries); }
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
        const std::size_t n = a.count(least);
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

// What the fields' types alone cannot say and every receiver relies on. A rule needs no Model; what does is
// checked by the role that receives the message.

/// So far that sums of two ticks do not overflow. -1: before the first.
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

const char* broken_rule(const Plan& plan) {
    const auto& offsets = plan.island_offsets;
    if (offsets.empty() || offsets.front() != 0 || offsets.back() != plan.robots.size())
        return "its islands do not cover its robots";
    for (std::size_t i = 1; i < offsets.size(); ++i)
        if (offsets[i] <= offsets[i - 1]) return "one of its islands is empty";
    for (const Tick tick : {plan.window_from, plan.from, plan.until, plan.release_before})
        if (!in_range(tick)) return kTickOutOfRange;
    if (plan.window_from < 0 || plan.until < plan.from || plan.from < plan.window_from)
        return "it ends before it starts";
    const bool inside = std::all_of(plan.orders.begin(), plan.orders.end(), [&](const Order& order) {
        return plan.from <= order.apply_at && order.apply_at < plan.until;
    });
    return inside ? nullptr : "one of its orders is for a tick that it does not step";
}

const char* broken_rule(const OrdersAhead& ahead) {
    return broken_rule_of(ahead.orders);
}

const char* broken_rule(const Frame& frame) {
    const bool told = frame.left == 0 || (frame.robots.empty() && frame.earlier.empty());
    if (!told) return "it was cut short and tells of robots";
    const auto numbers = [](const auto& entry) { return is_number(entry.swept); };
    if (!std::all_of(frame.robots.begin(), frame.robots.end(), numbers) ||
        !std::all_of(frame.earlier.begin(), frame.earlier.end(), numbers))
        return "a robot's bound is not a number";
    const bool known = std::all_of(frame.islands.begin(), frame.islands.end(),
                                   [](const IslandFrame& island) { return in_range(island.failed_at); });
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

const char* broken_rule(const ClientWord& word) {
    return in_range(word.observed) ? nullptr : kTickOutOfRange;
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
                   hello.expected < -1 || hello.expected > kLongest || hello.said < hello.acknowledged
               ? "its period or latency is out of range"
               : nullptr;
}

const char* broken_rule(const ModelRequest& request) {
    return request.what > Whole::kScene ? "it asks for something unknown" : nullptr;
}

const char* broken_rule(const ModelPart& part) {
    if (part.what > Whole::kScene) return "it is of something unknown";
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
        "Hello",         "Welcome",     "Refused",       "Expelled",       "Alive",        "LeaveRequest",
        "Goodbye",       "Plan",        "Frame",         "StateRequest",   "StateReply",   "ClientHello",
        "ClientWelcome", "Observation", "ClientWord",    "WordAck",        "ClientBye",    "RunOver",
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

Result<Envelope> decode_envelope(std::span<const std::uint8_t> bytes) {
    wire::Reader a(bytes);
    std::uint16_t version = 0;
    a.scalar(version);
    if (!a.failed() && version != kWireVersion)
        return Error{"a message of wire version " + std::to_string(version) + ", this program speaks " +
                         std::to_string(kWireVersion),
                     "run the same version of RoBOSS everywhere"};
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
                 "check the network, or what else sends on this domain"};
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

bool operator==(const Plan& a, const Plan& b) {
    wire::Writer wa, wb;
    wire::fields(wa, a);
    wire::fields(wb, b);
    return wa.take() == wb.take();
}

}  // namespace roboss
