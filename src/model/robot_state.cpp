// Start, hash and bytes of a robot's state.
#include "model/robot_state.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace roboss {

RobotState initial_state(const Model& model, RobotId robot) {
    const RobotType& type = model.type_of(robot);
    RobotState state;
    state.q.resize(7);
    const Pose X_RB{type.X_RB.p, to_quat(type.X_RB.R)};
    Pose X_WB = type.free_base ? model.robots[robot.index()].X_WR * X_RB : model.robots[robot.index()].X_WR;
    X_WB.q = normalized(X_WB.q);
    set_base_pose(state, X_WB);
    state.q.insert(state.q.end(), type.initial_q.begin(), type.initial_q.end());
    state.v.assign(static_cast<std::size_t>(type.nv), 0.0);
    state.motors.resize(type.motor_count());
    return state;
}

Pose base_pose(const RobotState& s) {
    return {{s.q[0], s.q[1], s.q[2]}, {s.q[3], s.q[4], s.q[5], s.q[6]}};
}

void set_base_pose(RobotState& s, const Pose& X) {
    const double numbers[] = {X.p.x, X.p.y, X.p.z, X.q.w, X.q.x, X.q.y, X.q.z};
    for (std::size_t i = 0; i < 7; ++i) s.q[i] = numbers[i];
}

std::uint64_t state_hash(RobotId robot, Tick tick, const RobotState& state) {
    Hash hash;
    hash.add(static_cast<std::uint64_t>(robot.value));
    hash.add(static_cast<std::uint64_t>(tick));
    hash.add(std::span<const double>(state.q));
    hash.add(std::span<const double>(state.v));
    for (const MotorSetpoint& m : state.motors) {
        hash.add(static_cast<std::uint64_t>(m.mode));
        for (double x : {m.target, m.max_effort, m.impulse, m.load}) hash.add(x);
    }
    for (const TimedWrench& w : state.wrenches) {
        hash.add(static_cast<std::uint64_t>(w.link.value));
        for (double x : {w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z}) hash.add(x);
        hash.add(static_cast<std::uint64_t>(w.until));
    }
    for (const ContactMemory& c : state.contacts) {
        hash.add(static_cast<std::uint64_t>(c.other_robot) << 32 | c.shape);
        hash.add(static_cast<std::uint64_t>(c.other_shape) << 32 | c.feature);
        for (double x : {c.impulse, c.load, c.friction.x, c.friction.y, c.friction.z}) hash.add(x);
    }
    hash.add(static_cast<std::uint64_t>(state.rest.still_ticks) << 1 | (state.rest.asleep ? 1 : 0));
    for (const std::uint32_t id : state.rest.neighbours) hash.add(static_cast<std::uint64_t>(id));
    if (state.rest.asleep)
        for (const Vec3& p : {state.rest.bound.min, state.rest.bound.max})
            hash.add(p.x), hash.add(p.y), hash.add(p.z);
    return hash.value();
}

std::uint64_t world_hash(std::uint64_t model_hash, std::span<const std::uint64_t> robot_hashes) {
    Hash hash;
    hash.add(model_hash);
    for (std::uint64_t h : robot_hashes) hash.add(h);
    return hash.value();
}

namespace {

class Writer {
  public:
    explicit Writer(std::vector<std::uint8_t>& out) : out_(out) {}
    void word(std::uint64_t w) {
        for (int i = 0; i < 8; ++i) out_.push_back(static_cast<std::uint8_t>(w >> (8 * i)));
    }
    void number(double x) { word(std::bit_cast<std::uint64_t>(x)); }
    void vector(const Vec3& v) { number(v.x), number(v.y), number(v.z); }
    void rest(const Rest& r) {
        pair(r.still_ticks, r.asleep ? 1 : 0);
        word(r.neighbours.size());
        for (const std::uint32_t id : r.neighbours) word(id);
        if (r.asleep) vector(r.bound.min), vector(r.bound.max);
    }
    void pair(std::uint32_t a, std::uint32_t b) { word(static_cast<std::uint64_t>(a) << 32 | b); }

  private:
    std::vector<std::uint8_t>& out_;
};

class Reader {
  public:
    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    std::uint64_t word() {
        if (left() < 1) {
            short_ = true;
            return 0;
        }
        std::uint64_t w = 0;
        for (std::size_t i = 0; i < 8; ++i) w |= static_cast<std::uint64_t>(bytes_[at_ + i]) << (8 * i);
        at_ += 8;
        return w;
    }
    double number() { return std::bit_cast<double>(word()); }
    Vec3 vector() {
        const double x = number(), y = number(), z = number();
        return {x, y, z};
    }
    Rest rest() {
        Rest r;
        const std::uint64_t first = word();
        r.still_ticks = static_cast<std::uint32_t>(first >> 32);
        r.asleep = (first & 1) != 0;
        const std::uint64_t edges = word();
        if ((first & 0xFFFFFFFEu) != 0 || edges > left()) short_ = true;
        if (short_) return r;
        r.neighbours.resize(edges);
        for (std::uint32_t& id : r.neighbours) {
            const std::uint64_t wide = word();
            id = static_cast<std::uint32_t>(wide);
            if (id != wide) short_ = true;
        }
        if (r.asleep) r.bound.min = vector(), r.bound.max = vector();
        return r;
    }
    std::size_t left() const { return (bytes_.size() - at_) / 8; }  // whole words
    bool complete() const { return !short_ && at_ == bytes_.size(); }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    bool short_ = false;
};

/// What is wrong with a state of which every field was read; nullptr: nothing.
const char* inconsistency_of(const RobotState& state, std::size_t robots) {
    const auto finite = [](double x) { return std::isfinite(x); };
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

constexpr std::size_t kWrenchWords = 8;
constexpr std::size_t kContactWords = 7;

}  // namespace

void encode(const RobotState& state, std::vector<std::uint8_t>& out) {
    Writer w(out);
    for (std::size_t n :
         {state.q.size(), state.v.size(), state.motors.size(), state.wrenches.size(), state.contacts.size()})
        w.word(n);
    for (double x : state.q) w.number(x);
    for (double x : state.v) w.number(x);
    for (const MotorSetpoint& m : state.motors)
        w.word(static_cast<std::uint64_t>(m.mode)), w.number(m.target), w.number(m.max_effort),
            w.number(m.impulse), w.number(m.load);
    for (const TimedWrench& t : state.wrenches)
        w.word(t.link.value), w.vector(t.force), w.vector(t.torque),
            w.word(static_cast<std::uint64_t>(t.until));
    for (const ContactMemory& c : state.contacts)
        w.pair(c.other_robot, c.shape), w.pair(c.other_shape, c.feature), w.number(c.impulse),
            w.number(c.load), w.vector(c.friction);
    w.rest(state.rest);
}

Result<RobotState> decode_state(std::span<const std::uint8_t> bytes, const RobotType& type,
                                std::size_t robots) {
    Reader r(bytes);
    const std::uint64_t nq = r.word(), nv = r.word(), motors = r.word(), wrenches = r.word(),
                        contacts = r.word();
    if (nq != static_cast<std::uint64_t>(type.nq) || nv != static_cast<std::uint64_t>(type.nv) ||
        motors != type.motor_count())
        return Error{"the bytes of a state do not fit robot type '" + type.name + "'",
                     "they belong to another world or version"};
    if (wrenches > r.left() / kWrenchWords || contacts > r.left() / kContactWords)
        return Error{"the bytes of a state of type '" + type.name + "' are truncated",
                     "fetch or save the state again"};
    RobotState state;
    state.q.resize(nq), state.v.resize(nv), state.motors.resize(motors);
    state.wrenches.resize(wrenches), state.contacts.resize(contacts);
    for (double& x : state.q) x = r.number();
    for (double& x : state.v) x = r.number();
    for (MotorSetpoint& m : state.motors) {
        const std::uint64_t mode = r.word();
        m.mode = static_cast<MotorMode>(mode);
        if (mode > static_cast<std::uint64_t>(MotorMode::kEffort))
            return Error{"a state names a motor mode that does not exist", "the bytes are damaged"};
        m.target = r.number(), m.max_effort = r.number();
        m.impulse = r.number(), m.load = r.number();
    }
    for (TimedWrench& t : state.wrenches) {
        const std::uint64_t link = r.word();
        t.link = LinkId(static_cast<std::uint32_t>(link));
        if (link >= type.links.size())
            return Error{"a state names a link that does not exist", "the bytes are damaged"};
        t.force = r.vector(), t.torque = r.vector(), t.until = static_cast<Tick>(r.word());
    }
    for (ContactMemory& c : state.contacts) {
        const std::uint64_t a = r.word(), b = r.word();
        c.other_robot = static_cast<std::uint32_t>(a >> 32), c.shape = static_cast<std::uint32_t>(a);
        c.other_shape = static_cast<std::uint32_t>(b >> 32), c.feature = static_cast<std::uint32_t>(b);
        c.impulse = r.number(), c.load = r.number(), c.friction = r.vector();
    }
    state.rest = r.rest();
    if (!r.complete())
        return Error{"the bytes of a state of type '" + type.name + "' have the wrong length",
                     "fetch or save it again"};
    if (const char* wrong = inconsistency_of(state, robots); wrong != nullptr)
        return Error{"a state of type '" + type.name + "' " + wrong,
                     "the bytes are damaged or of another world"};
    return state;
}

}  // namespace roboss
