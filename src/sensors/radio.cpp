// The radio: which transmissions of the others arrive (docs/radio.md). All of it is a function of the states
// at the tick, which hold the last transmissions, and of the seed.
//
//     strength = tx_power - l0 - 10 fading_exponent log10(distance) - obstacle_loss shapes + sigma g
//     received with the probability (1 - erfc(sqrt(strength / noise)))^bytes
//
// as in RFComms of gz-sim, whose modulation is QPSK. g: a draw from a normal distribution for each message
// and receiver.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/float_env.h"
#include "core/hex.h"
#include "core/noise.h"
#include "physics/dynamics/kinematics.h"
#include "sensors/radio_link.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

constexpr double kLightSpeed = 299'792'458;  // m/s
constexpr double kLeastDistance = 0.01;      // m: nearer antennas lose no less
constexpr double kFarthest = 1e6;            // m: nothing is heard beyond
constexpr double kLongestDelay_s = 0.004;    // of that distance
/// dB below the noise floor: weaker signals are neither received nor interfere, so the obstacles in their way
/// are not counted.
constexpr double kHopeless = 30;

/// A transmission as it comes in at the receiver.
struct Signal {
    RobotId from;
    std::uint32_t radio = 0;          // of the sender
    const RadioSpec* spec = nullptr;  // of the sender
    const Transmission* what = nullptr;
    std::span<const std::uint8_t> payload;
    Vec3 p_WA;                      // m, the sender's antenna
    double distance = 0;            // m
    double begin_s = 0, end_s = 0;  // s, at the receiver
    Tick arrived = 0;
    bool is_own = false;    // the receiver's own: it hears nothing meanwhile
    bool is_known = false;  // strength_dBm is
    double strength_dBm = 0;
};

/// What one radio hears.
class Receiver {
  public:
    Receiver(const SensorQuery& query, const RadioSpec& spec) : q_(query), spec_(spec) {
        p_WA_ = sensor_pose(query).p;
    }

    std::vector<RadioMessage> messages() {
        find_first();
        for_each_radio([&](const Sender& sender) { collect(sender); });
        std::vector<Signal*> arriving;
        for (Signal& s : signals_)
            if (!s.is_own && s.arrived > q_.since && s.arrived <= q_.tick && is_for_us(s))
                arriving.push_back(&s);
        std::ranges::sort(arriving, {}, [](const Signal* s) {
            return std::tuple(s->end_s, s->from, s->radio, s->what->number);
        });
        if (spec_.collisions && !spec_.is_perfect) keep_possible_disturbers(arriving);
        std::vector<RadioMessage> messages;
        for (Signal* s : arriving)
            if (survives(*s)) messages.push_back(message_of(*s));
        return messages;
    }

  private:
    /// A radio on this channel that has sent something.
    struct Sender {
        RobotId robot;
        std::uint32_t radio = 0;
        const SensorInfo& info;
        const RobotState& state;
        const RadioSpec& spec() const { return *info.spec.as<RadioSpec>(); }
        const RadioState& sent() const { return state.radios[radio]; }
    };

    /// Not the other radios of this robot.
    template <class Visit>
    void for_each_radio(Visit&& visit) const {
        for (std::size_t i = 0; i < q_.model.robots.size(); ++i) {
            const RobotId id(i);
            const RobotType& type = q_.model.type_of(id);
            if (type.radios.empty()) continue;
            const RobotState& state = q_.sources.state_of(id);
            for (std::uint32_t k = 0; k < type.radios.size(); ++k) {
                const Sender sender{id, k, type.sensors[type.radios[k]], state};
                const bool is_other_own = id == q_.robot && type.radios[k] != q_.sensor;
                if (is_other_own || !share_a_channel(sender.spec(), spec_)) continue;
                if (!sender.sent().sent.empty()) visit(sender);
            }
        }
    }

    /// When the first transmission begins that may arrive in time; what ended before disturbs none of them.
    void find_first() {
        const double since_s = q_.since < 0 ? -std::numeric_limits<double>::infinity()
                                            : static_cast<double>(q_.since) * q_.model.dt_s;
        for_each_radio([&](const Sender& sender) {
            const std::vector<Transmission>& sent = sender.sent().sent;
            for (auto t = sent.rbegin(); t != sent.rend(); ++t) {
                const bool is_recent =
                    t->end_s + spec_.latency + kLongestDelay_s > since_s || t->given + 1 > q_.since;
                if (!is_recent) break;
                first_s_ = std::min(first_s_, t->begin_s);
            }
        });
    }

    void collect(const Sender& sender) {
        // where the antenna stands in the base's frame, with the joints as they are now
        const Transform X_BA = inverse(to_transform(base_pose(sender.state))) *
                               link_pose(q_.model.type_of(sender.robot), sender.state, sender.info.link) *
                               to_transform(sender.info.spec.X_LS);
        const RadioState& radio = sender.sent();
        std::size_t end = radio.bytes.size();
        for (auto t = radio.sent.rbegin(); t != radio.sent.rend(); ++t) {
            if (t->end_s + kLongestDelay_s < first_s_) break;
            end -= t->size;
            Signal s;
            s.from = sender.robot, s.radio = sender.radio, s.spec = &sender.spec(), s.what = &*t;
            s.is_own = sender.robot == q_.robot;
            s.payload = std::span(radio.bytes).subspan(end, t->size);
            s.p_WA = (to_transform(t->X_WB) * X_BA).p;
            s.distance = s.is_own ? 0 : norm(s.p_WA - p_WA_);
            if (!spec_.is_perfect && s.distance > std::min(spec_.range, kFarthest)) continue;
            const double delay = spec_.is_perfect ? 0 : s.distance / kLightSpeed;
            s.begin_s = t->begin_s + delay, s.end_s = t->end_s + delay;
            // a message is received in the tick after it was sent at the earliest
            s.arrived = std::max(radio_arrival(s.end_s + spec_.latency, q_.model.dt_s), t->given + 1);
            signals_.push_back(s);
        }
    }

    bool is_for_us(const Signal& s) const {
        return s.what->to == RobotId::kNone || RobotId(s.what->to) == q_.robot;
    }

    /// Of `signals_`, those that overlap with one of these, by their beginning.
    void keep_possible_disturbers(const std::vector<Signal*>& arriving) {
        if (arriving.empty()) return;
        double first_s = arriving.front()->begin_s;
        for (const Signal* s : arriving) first_s = std::min(first_s, s->begin_s);
        const double last_s = arriving.back()->end_s;
        for (Signal& s : signals_) {
            if (s.begin_s < last_s && s.end_s > first_s) disturbers_.push_back(&s);
            longest_s_ = std::max(longest_s_, s.end_s - s.begin_s);
        }
        std::ranges::sort(disturbers_, {}, [](const Signal* s) {
            return std::tuple(s->begin_s, s->from, s->radio, s->what->number);
        });
    }

    bool survives(Signal& s) {
        if (spec_.is_perfect) return true;
        const double noise = radio_power(spec_.noise_floor);
        const double arrives = (1 - spec_.loss) * radio_success(radio_power(strength(s)) / noise,
                                                                static_cast<double>(s.what->size));
        if (!(random_uniform(stream(s, 0), index(s)) < arrives)) return false;
        return !spec_.collisions || !is_disturbed(s);
    }

    /// Whether the others that overlap with it are together too strong.
    bool is_disturbed(Signal& s) {
        const double most = std::isinf(spec_.capture) ? 0 : radio_power(s.strength_dBm - spec_.capture);
        double power = 0;  // mW, of the others
        const auto first = std::ranges::lower_bound(disturbers_, s.begin_s - longest_s_, {},
                                                    [](const Signal* other) { return other->begin_s; });
        for (auto it = first; it != disturbers_.end() && (*it)->begin_s < s.end_s; ++it) {
            Signal& other = **it;
            const bool same = other.from == s.from && other.radio == s.radio;
            if (same || other.end_s <= s.begin_s) continue;
            if (other.is_own) return true;
            const double dBm = strength(other);
            if (dBm < spec_.noise_floor) continue;
            power += radio_power(dBm);
            if (power > most) return true;
        }
        return false;
    }

    /// Power of the signal here, dBm; computed once.
    double strength(Signal& s) {
        if (s.is_known) return s.strength_dBm;
        s.is_known = true;
        const double distance = std::max(s.distance, kLeastDistance);
        double dBm = s.spec->tx_power - spec_.l0 - 10 * spec_.fading_exponent * radio_log10(distance);
        if (spec_.sigma > 0) dBm += spec_.sigma * random_gaussian(stream(s, 1), index(s));
        if (spec_.obstacle_loss > 0 && dBm >= spec_.noise_floor - kHopeless)
            dBm -= spec_.obstacle_loss * static_cast<double>(q_.sources.ray_scene().shapes_between(
                                             s.p_WA, p_WA_, s.from, q_.robot));
        return s.strength_dBm = dBm;
    }

    // A draw is for one message and receiver.
    NoiseStream stream(const Signal& s, std::uint32_t draw) const {
        return {q_.seed, q_.robot.value, 2 * static_cast<std::uint32_t>(q_.sensor) + draw + 0x10000,
                s.what->given};
    }
    static std::uint64_t index(const Signal& s) {
        return static_cast<std::uint64_t>(s.from.value) << 32 | (s.radio & 0xFF) << 24 |
               (s.what->number & 0xFFFFFF);
    }

    RadioMessage message_of(const Signal& s) const {
        RadioMessage m;
        m.from = s.from, m.to = RobotId(s.what->to);
        m.sent = s.what->given, m.arrived = s.arrived;
        m.channel = spec_.channel, m.number = s.what->number;
        m.strength_dBm = spec_.is_perfect ? s.spec->tx_power : s.strength_dBm;
        m.payload.assign(s.payload.begin(), s.payload.end());
        return m;
    }

    const SensorQuery& q_;
    const RadioSpec& spec_;
    Vec3 p_WA_;  // m, its antenna
    std::vector<Signal> signals_;
    std::vector<Signal*> disturbers_;
    double longest_s_ = 0;  // of all signals
    double first_s_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Result<std::vector<RadioMessage>> receive(const SensorQuery& query) {
    if (query.robot.index() >= query.model.robots.size() || query.sensor >= query.type().sensors.size() ||
        query.info().spec.as<RadioSpec>() == nullptr)
        return Error{"there is no such radio", "`roboss check` lists the sensors", "no-radio"};
    const ExactFloatScope exact;
    return Receiver(query, *query.info().spec.as<RadioSpec>()).messages();
}

Result<RadioReading> read(const RadioSpec& radio, const SensorQuery& query) {
    SensorQuery recent = query;  // who does not say since when is shown the last second
    if (query.since < 0) recent.since = query.tick - radio_arrival(RadioState::kKept_s, query.model.dt_s);
    RadioReading reading;
    for (const RadioMessage& m : Receiver(recent, radio).messages()) {
        reading.senders.push_back(query.model.robots[m.from.index()].name);
        reading.sent.push_back(static_cast<double>(m.sent) * query.model.dt_s);
        reading.arrived.push_back(static_cast<double>(m.arrived) * query.model.dt_s);
        reading.strengths.push_back(m.strength_dBm);
        reading.payloads.push_back(hexadecimal(m.payload));
    }
    return reading;
}

}  // namespace roboss
