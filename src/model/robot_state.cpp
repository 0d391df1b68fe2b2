// Start, hash and bytes of a robot's state.
#include "model/robot_state.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <type_traits>
#include <utility>

namespace roboss {

RobotState initial_state(const Model& model, RobotId robot) {
    const RobotType& type = model.type_of(robot);
    const Robot& start = model.robots[robot.index()];
    RobotState state;
    state.q.resize(7);
    const Pose X_RB{type.X_RB.p, to_quat(type.X_RB.R)};
    Pose X_WB = type.free_base ? start.X_WR * X_RB : start.X_WR;
    X_WB.q = normalized(X_WB.q);
    set_base_pose(state, X_WB);
    const std::vector<double>& joints = start.start_q.empty() ? type.initial_q : start.start_q;
    state.q.insert(state.q.end(), joints.begin(), joints.end());
    state.v = start.start_v;
    state.v.resize(static_cast<std::size_t>(type.nv), 0.0);
    state.motors.resize(type.motor_count());
    state.onboard.resize(static_cast<std::size_t>(type.onboard_size));
    state.lists.resize(static_cast<std::size_t>(type.list_count));
    state.radios.resize(type.radios.size());
    for (const ChannelInfo& c : type.channels) state.onboard[static_cast<std::size_t>(c.index)] = -1;
    for (const OnboardInfo& info : type.onboard)
        std::copy(info.memory.begin(), info.memory.end(), state.onboard.begin() + info.memory_index);
    return state;
}

Pose base_pose(const RobotState& s) {
    return {{s.q[0], s.q[1], s.q[2]}, {s.q[3], s.q[4], s.q[5], s.q[6]}};
}

void set_base_pose(RobotState& s, const Pose& X) {
    const double numbers[] = {X.p.x, X.p.y, X.p.z, X.q.w, X.q.x, X.q.y, X.q.z};
    for (std::size_t i = 0; i < 7; ++i) s.q[i] = numbers[i];
}

namespace {

/// A state is a sequence of 64-bit words: those that it is hashed by, and those that travel. Told one by one.
template <class Put>
class Teller {
  public:
    static constexpr bool kReading = false;
    explicit Teller(Put put) : put_(std::move(put)) {}
    void word(std::uint64_t w) { put_(w); }
    void word_of(std::uint64_t w) { word(w); }
    void number(double x) { word(std::bit_cast<std::uint64_t>(x)); }
    void tick(Tick t) { word(static_cast<std::uint64_t>(t)); }
    void id(std::uint32_t i) { word(i); }
    void axis(int number) { word(static_cast<std::uint64_t>(number)); }
    void pair(std::uint32_t a, std::uint32_t b) { word(static_cast<std::uint64_t>(a) << 32 | b); }
    void flagged(std::uint32_t n, std::initializer_list<bool> flags) {
        std::uint32_t bits = 0, bit = 1;
        for (const bool flag : flags) bits |= flag ? bit : 0, bit <<= 1;
        pair(n, bits);
    }
    /// Eight to a word, the last one filled up with zeros.
    void bytes(const std::vector<std::uint8_t>& list) {
        length(list);
        for (std::size_t i = 0; i < list.size(); i += 8) {
            std::uint64_t w = 0;
            for (std::size_t k = i; k < list.size() && k < i + 8; ++k)
                w |= static_cast<std::uint64_t>(list[k]) << (8 * (k - i));
            word(w);
        }
    }
    void flag(bool on) { word(on ? 1 : 0); }
    template <class Enum>
    void mode(Enum m) {
        word(static_cast<std::uint64_t>(m));
    }
    template <class T>
    void length(const std::vector<T>& list) {
        word(list.size());
    }

  private:
    Put put_;
};

class Reader {
  public:
    static constexpr bool kReading = true;
    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    std::uint64_t word() {
        if (left() < 1) return fail(), 0;
        std::uint64_t w = 0;
        for (std::size_t i = 0; i < 8; ++i) w |= static_cast<std::uint64_t>(bytes_[at_ + i]) << (8 * i);
        at_ += 8;
        return w;
    }
    void word_of(std::uint64_t& w) { w = word(); }
    void number(double& x) { x = std::bit_cast<double>(word()); }
    void tick(Tick& t) { t = static_cast<Tick>(word()); }
    void id(std::uint32_t& i) {
        const std::uint64_t wide = word();
        i = static_cast<std::uint32_t>(wide);
        if (i != wide) fail();
    }
    void axis(int& number) {
        std::uint32_t wide = 0;
        id(wide);
        number = static_cast<int>(wide & 0xFF);
        if (wide > 0xFF) fail();
    }
    void pair(std::uint32_t& a, std::uint32_t& b) {
        const std::uint64_t w = word();
        a = static_cast<std::uint32_t>(w >> 32), b = static_cast<std::uint32_t>(w);
    }
    void flagged(std::uint32_t& n, std::initializer_list<std::reference_wrapper<bool>> flags) {
        std::uint32_t bits = 0;
        pair(n, bits);
        for (bool& flag : flags) flag = (bits & 1) != 0, bits >>= 1;
        if (bits != 0) fail();
    }
    void bytes(std::vector<std::uint8_t>& list) {
        const std::uint64_t n = word();
        if (n > 8 * left()) return fail();
        list.resize(n);
        for (std::size_t i = 0; i < list.size(); i += 8) {
            std::uint64_t w = word();
            for (std::size_t k = i; k < list.size() && k < i + 8; ++k, w >>= 8)
                list[k] = static_cast<std::uint8_t>(w);
            if (w != 0) fail();  // what fills it up
        }
    }
    void flag(bool& on) {
        const std::uint64_t w = word();
        if (w > 1) return fail();
        on = w != 0;
    }
    void mode(MotorMode& m) { choose(m, MotorMode::kEffort); }
    void mode(BondPhase& p) { choose(p, BondPhase::kLoosed); }
    void mode(JointParameter& p) { choose(p, static_cast<JointParameter>(kJointParameters - 1)); }
    void mode(LinkParameter& p) { choose(p, static_cast<LinkParameter>(kLinkParameters - 1)); }
    template <class T>
    void length(std::vector<T>& list) {
        const std::uint64_t n = word();
        if (n > left()) return fail();  // an item takes a word at least
        list.resize(n);
    }
    void fail() { failed_ = true; }
    std::size_t left() const { return (bytes_.size() - at_) / 8; }  // whole words
    bool failed() const { return failed_; }
    bool complete() const { return !failed_ && at_ == bytes_.size(); }

  private:
    template <class Enum>
    void choose(Enum& e, Enum last) {
        const std::uint64_t w = word();
        if (w > static_cast<std::uint64_t>(last)) return fail();
        e = static_cast<Enum>(w);
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    bool failed_ = false;
};

/// T as the archive needs it: const where it is told.
template <class A, class T>
using Of = std::conditional_t<A::kReading, T, const T>;

// The one description of a state's fields, for its hash, its bytes and back. Each function names all members
// of its struct: who adds one is stopped here by the compiler.

template <class A>
void fields(A& a, Of<A, Vec3>& v) {
    auto& [x, y, z] = v;
    a.number(x), a.number(y), a.number(z);
}

template <class A>
void fields(A& a, Of<A, MotorSetpoint>& motor) {
    auto& [mode, target, max_effort, impulse, load] = motor;
    a.mode(mode), a.number(target), a.number(max_effort), a.number(impulse), a.number(load);
}

template <class A>
void fields(A& a, Of<A, TimedWrench>& wrench) {
    auto& [link, force, torque, until] = wrench;
    a.id(link.value), fields(a, force), fields(a, torque), a.tick(until);
}

template <class A>
void fields(A& a, Of<A, TimedPull>& pull) {
    auto& [link, p_L, target_W, rate, max_force, until] = pull;
    a.id(link.value), fields(a, p_L), fields(a, target_W);
    a.number(rate), a.number(max_force), a.tick(until);
}

template <class A>
void fields(A& a, Of<A, ContactMemory>& contact) {
    auto& [other_robot, shape, other_shape, feature, impulse, load, friction] = contact;
    a.pair(other_robot, shape), a.pair(other_shape, feature);
    a.number(impulse), a.number(load), fields(a, friction);
}

template <class A>
void fields(A& a, Of<A, SurfaceMotion>& surface) {
    auto& [link, linear_L, angular_L, belt_L, turns, centre_W] = surface;
    a.id(link.value), fields(a, linear_L), fields(a, angular_L), fields(a, belt_L);
    a.flag(turns), fields(a, centre_W);
}

template <class A>
void fields(A& a, Of<A, Bond>& bond) {
    auto& [phase, link, other, other_link, X_LO, p_L, reach, max_force, max_torque, force_impulse,
           torque_impulse] = bond;
    a.mode(phase), a.pair(link.value, other), a.id(other_link.value);
    fields(a, X_LO.p);
    a.number(X_LO.q.w), a.number(X_LO.q.x), a.number(X_LO.q.y), a.number(X_LO.q.z);
    fields(a, p_L), a.number(reach);
    a.number(max_force), a.number(max_torque), fields(a, force_impulse), fields(a, torque_impulse);
}

template <class A>
void fields(A& a, Of<A, Transmission>& transmission) {
    auto& [number, to, size, given, begin_s, end_s, X_WB] = transmission;
    a.word_of(number), a.pair(to, size), a.tick(given), a.number(begin_s), a.number(end_s);
    fields(a, X_WB.p);
    a.number(X_WB.q.w), a.number(X_WB.q.x), a.number(X_WB.q.y), a.number(X_WB.q.z);
}

template <class A>
void fields(A& a, Of<A, RadioState>& radio) {
    auto& [count, dropped, sent, bytes] = radio;
    a.word_of(count), a.word_of(dropped), a.length(sent);
    for (auto& transmission : sent) fields(a, transmission);
    a.bytes(bytes);
}

/// All but the surroundings, which are another part of the state.
template <class A>
void fields(A& a, Of<A, OwnNumbers>& own) {
    auto& [joints, links, around] = own;
    a.length(joints);
    for (auto& [joint, axis, number] : joints) {
        auto& [parameter, value] = number;
        a.id(joint.value), a.axis(axis), a.mode(parameter), a.number(value);
    }
    a.length(links);
    for (auto& [link, number] : links) {
        auto& [parameter, value] = number;
        a.id(link.value), a.mode(parameter), a.number(value);
    }
}

template <class A>
void fields(A& a, Of<A, std::optional<Vec3>>& v) {
    bool given = v.has_value();
    a.flag(given);
    if constexpr (A::kReading)
        if (given) v.emplace();
    if (v) fields(a, *v);
}

template <class A>
void fields(A& a, Of<A, OwnSurroundings>& around) {
    auto& [gravity, wind] = around;
    fields(a, gravity), fields(a, wind);
}

/// These follow behind the rest of a state: memories of on-board controllers, pulls, radios, own numbers of
/// joints and links, own surroundings.
struct Parts {
    bool acts = false, pulled = false, talks = false, differs = false, surrounded = false;
};

/// Who is awake has no bound.
template <class A>
void fields(A& a, Of<A, Rest>& rest, Parts& parts) {
    auto& [still_ticks, asleep, neighbours, bound] = rest;
    a.flagged(still_ticks, {asleep, parts.acts, parts.pulled, parts.talks, parts.differs, parts.surrounded});
    a.length(neighbours);
    for (auto& id : neighbours) a.id(id);
    auto& [min, max] = bound;
    if (asleep) fields(a, min), fields(a, max);
}

template <class A>
void fields(A& a, Of<A, RobotState>& state) {
    auto& [q, v, motors, wrenches, contacts, rest, onboard, lists, surfaces, bonds, pulls, radios, own,
           own_type] = state;
    Parts parts{!onboard.empty() || !lists.empty() || !surfaces.empty() || !bonds.empty(), !pulls.empty(),
                !radios.empty(), !own.joints.empty() || !own.links.empty(), !own.around.empty()};
    a.length(q), a.length(v), a.length(motors), a.length(wrenches), a.length(contacts);
    for (auto& x : q) a.number(x);
    for (auto& x : v) a.number(x);
    for (auto& motor : motors) fields(a, motor);
    for (auto& wrench : wrenches) fields(a, wrench);
    for (auto& contact : contacts) fields(a, contact);
    fields(a, rest, parts);
    if (parts.pulled) a.length(pulls);
    for (auto& pull : pulls) fields(a, pull);
    if (parts.talks) a.length(radios);
    for (auto& radio : radios) fields(a, radio);
    if (parts.differs) fields(a, own);
    if constexpr (A::kReading)
        if ((parts.talks && radios.empty()) || (parts.differs && own.empty())) a.fail();
    if (parts.surrounded) fields(a, own.around);
    if constexpr (A::kReading)
        if (parts.surrounded && own.around.empty()) a.fail();
    if (!parts.acts) return;
    a.length(onboard), a.length(lists), a.length(surfaces), a.length(bonds);
    for (auto& x : onboard) a.number(x);
    for (auto& list : lists) {
        a.length(list);
        for (auto& x : list) a.number(x);
    }
    for (auto& surface : surfaces) fields(a, surface);
    for (auto& bond : bonds) fields(a, bond);
}

/// Whether a radio's state is one that orders may lead to.
bool is_consistent(const RadioState& radio, std::size_t robots) {
    std::uint64_t bytes = 0;
    for (const Transmission& t : radio.sent) {
        bytes += t.size;
        const bool fits = (t.to == RobotId::kNone || t.to < robots) && t.number < radio.count &&
                          std::isfinite(t.begin_s) && std::isfinite(t.end_s) && t.begin_s <= t.end_s &&
                          is_finite(t.X_WB);
        if (!fits) return false;
    }
    return bytes == radio.bytes.size() && radio.sent.size() <= RadioState::kMostKept &&
           bytes <= RadioState::kMostBytes;
}

/// What is wrong with a state of which every field was read; nullptr: nothing.
const char* inconsistency_of(const RobotState& state, const RobotType& type, std::size_t robots) {
    if (state.q.size() != static_cast<std::size_t>(type.nq) ||
        state.v.size() != static_cast<std::size_t>(type.nv) || state.motors.size() != type.motor_count())
        return "has not as many coordinates, velocities or motors as that";
    const auto has_link = [&](const TimedWrench& w) { return w.link.index() < type.links.size(); };
    if (!std::all_of(state.wrenches.begin(), state.wrenches.end(), has_link))
        return "names a link that does not exist";
    const auto finite = [](double x) { return std::isfinite(x); };
    const auto pull_fits = [&](const TimedPull& p) {
        return p.link.index() < type.links.size() && is_finite(p.p_L) && is_finite(p.target_W) &&
               std::isfinite(p.rate) && std::isfinite(p.max_force);
    };
    if (!std::all_of(state.pulls.begin(), state.pulls.end(), pull_fits))
        return "is pulled by a link that does not exist, or is not finite";
    if (state.onboard.size() != static_cast<std::size_t>(type.onboard_size) ||
        state.lists.size() != static_cast<std::size_t>(type.list_count))
        return "has not as many commands or as much memory of on-board controllers as that";
    if (state.radios.size() != type.radios.size()) return "has not as many radios as that";
    if (!may_own(type, state.own.joints) || !may_own(type, state.own.links) || !may_own(state.own.around))
        return "has numbers of joints or links, gravity or wind that no order gives";
    const auto radio_fits = [&](const RadioState& r) { return is_consistent(r, robots); };
    if (!std::all_of(state.radios.begin(), state.radios.end(), radio_fits))
        return "has a radio whose transmissions do not fit each other";
    const auto surface_fits = [&](const SurfaceMotion& s) { return s.link.index() < type.links.size(); };
    if (!std::all_of(state.surfaces.begin(), state.surfaces.end(), surface_fits))
        return "moves the surface of a link that does not exist";
    const auto stays_finite = [](const SurfaceMotion& s) {
        return is_finite(s.linear_L) && is_finite(s.angular_L) && is_finite(s.belt_L) &&
               is_finite(s.centre_W);
    };
    if (!std::all_of(state.surfaces.begin(), state.surfaces.end(), stays_finite)) return "is not finite";
    const auto bond_fits = [&](const Bond& b) {
        return b.link.index() < type.links.size() && (b.other == RobotId::kNone || b.other < robots) &&
               is_finite(b.X_LO) && is_finite(b.p_L);
    };
    if (!std::all_of(state.bonds.begin(), state.bonds.end(), bond_fits))
        return "holds a robot, or by a link, that does not exist";
    if (!std::all_of(state.onboard.begin(), state.onboard.end(), finite)) return "is not finite";
    if (!std::all_of(state.q.begin(), state.q.end(), finite) ||
        !std::all_of(state.v.begin(), state.v.end(), finite))
        return "is not finite";
    const auto known = [robots](std::uint32_t id) { return id < robots; };
    const bool knows_contacts = std::all_of(
        state.contacts.begin(), state.contacts.end(),
        [&](const ContactMemory& c) { return c.other_robot == RobotId::kNone || known(c.other_robot); });
    if (!knows_contacts || !std::all_of(state.rest.neighbours.begin(), state.rest.neighbours.end(), known))
        return "names a robot that does not exist";
    return nullptr;
}

}  // namespace

std::uint64_t state_hash(RobotId robot, Tick tick, const RobotState& state) {
    Hash hash;
    Teller words([&hash](std::uint64_t w) { hash.add(w); });
    words.id(robot.value), words.tick(tick);
    fields(words, state);
    return hash.value();
}

std::uint64_t world_hash(std::uint64_t model_hash, std::span<const std::uint64_t> robot_hashes) {
    Hash hash;
    hash.add(model_hash);
    for (std::uint64_t h : robot_hashes) hash.add(h);
    return hash.value();
}

void encode(const RobotState& state, std::vector<std::uint8_t>& out) {
    static_assert(std::endian::native == std::endian::little, "a word is written as it is in memory");
    Teller words([&out](std::uint64_t w) {
        const std::size_t at = out.size();
        out.resize(at + sizeof w);
        std::memcpy(out.data() + at, &w, sizeof w);
    });
    fields(words, state);
}

Result<RobotState> decode_state(std::span<const std::uint8_t> bytes, const RobotType& type,
                                std::size_t robots) {
    Reader words(bytes);
    RobotState state;
    fields(words, state);
    const char* wrong =
        words.complete() ? inconsistency_of(state, type, robots) : "is damaged, or bytes of it are missing";
    if (wrong == nullptr) {
        state.own_type = OwnType(type, state.own);
        return state;
    }
    return Error{"a state of type '" + type.name + "' " + wrong,
                 "its bytes are damaged, or belong to another world or version; fetch or save it again"};
}

}  // namespace roboss
