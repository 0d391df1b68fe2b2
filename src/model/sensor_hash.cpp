// What a sensor adds to the Model hash. The first four kinds are hashed as one record of all their
// parameters, where those that a kind does not have count as zero (samples: as one): so Models keep their
// hashes. Parameters of later kinds follow by name and value, in the order of their kind.
#include <array>
#include <string_view>
#include <type_traits>

#include "model/compile_type.h"

namespace roboss {
namespace {

void add_value(Hash& hash, const NoiseSpec& n) {
    for (double x : {n.mean, n.stddev, n.bias_mean, n.bias_stddev, n.precision}) hash.add(x);
    if (n.dynamic_bias_stddev == 0 && n.dynamic_bias_correlation_time == 0) return;
    hash.add(std::string_view("dynamic"));
    for (double x : {n.dynamic_bias_stddev, n.dynamic_bias_correlation_time}) hash.add(x);
}

void add_value(Hash& hash, int value) {
    hash.add(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
}

void add_value(Hash& hash, double value) {
    hash.add(value);
}

void add_value(Hash& hash, bool value) {
    add_value(hash, value ? 1 : 0);
}

void add_value(Hash& hash, const Vec3& v) {
    hash.add(v.x), hash.add(v.y), hash.add(v.z);
}

void add_value(Hash& hash, const std::string& text) {
    hash.add(std::string_view(text));
}

void add_value(Hash& hash, const std::vector<std::string>& texts) {
    hash.add(static_cast<std::uint64_t>(texts.size()));
    for (const std::string& text : texts) add_value(hash, text);
}

void add_value(Hash& hash, const std::vector<double>& values) {
    hash.add(static_cast<std::uint64_t>(values.size()));
    hash.add(std::span<const double>(values));
}

void add_value(Hash& hash, const Pose& X) {
    add_value(hash, X.p);
    for (const double x : {X.q.w, X.q.x, X.q.y, X.q.z}) hash.add(x);
}

/// Hashes of the values of parameters that were added later, in their order.
struct LaterValues {
    std::vector<std::uint64_t> hashes;

    template <class Value>
    void operator()(const Parameter& p, const Value& value) {
        if (!p.later) return;
        Hash hash;
        add_value(hash, value);
        hashes.push_back(hash.value());
    }
};

/// The record; parameters that are not in it go to `rest`.
struct Record {
    std::array<std::pair<std::string_view, double>, 8> numbers{{{"min_angle", 0},
                                                                {"max_angle", 0},
                                                                {"vertical_min_angle", 0},
                                                                {"vertical_max_angle", 0},
                                                                {"range_min", 0},
                                                                {"range_max", 0},
                                                                {"range_resolution", 0},
                                                                {"wheel_radius", 0}}};
    std::array<std::pair<std::string_view, NoiseSpec>, 6> noises{{{"noise", {}},
                                                                  {"gyro_noise", {}},
                                                                  {"position_horizontal_noise", {}},
                                                                  {"position_vertical_noise", {}},
                                                                  {"velocity_horizontal_noise", {}},
                                                                  {"velocity_vertical_noise", {}}}};
    std::array<std::pair<std::string_view, int>, 2> counts{{{"samples", 1}, {"vertical_samples", 1}}};
    JointNames joints;
    Hash rest;
    bool has_rest = false;
    std::vector<std::uint64_t> usual;  // hashes of the defaults of parameters that were added later
    std::size_t later = 0;             // of them, how many were visited

    template <class Value>
    void operator()(const Parameter& p, const Value& value) {
        if (!p.later) return add(p, value);
        Hash hash;
        add_value(hash, value);
        if (hash.value() != usual[later++]) keep(p, value);
    }

  private:
    void add(const Parameter& p, double value) { put(numbers, p, value); }
    void add(const Parameter& p, int value) { put(counts, p, value); }
    void add(const Parameter& p, const NoiseSpec& noise) { put(noises, p, noise); }
    void add(const Parameter&, const JointNames& names) { joints = names; }
    void add(const Parameter& p, bool value) { keep(p, value ? 1 : 0); }
    void add(const Parameter& p, const Vec3& value) { keep(p, value); }
    void add(const Parameter& p, const std::string& value) { keep(p, value); }
    void add(const Parameter& p, const std::vector<std::string>& value) { keep(p, value); }
    void add(const Parameter& p, const std::vector<double>& value) { keep(p, value); }
    void add(const Parameter& p, const Pose& value) { keep(p, value); }

    template <class Slots, class Value>
    void put(Slots& slots, const Parameter& parameter, const Value& value) {
        for (auto& [name, slot] : slots)
            if (name == parameter.name) {
                slot = value;
                return;
            }
        keep(parameter, value);
    }
    template <class Value>
    void keep(const Parameter& parameter, const Value& value) {
        has_rest = true;
        rest.add(std::string_view(parameter.name));
        add_value(rest, value);
    }
};

}  // namespace

void add_to_hash(Hash& hash, const SensorInfo& info) {
    const SensorSpec& s = info.spec;
    Record record;
    std::visit(
        [&]<class Kind>(const Kind& parameters) {
            LaterValues usual;
            const Kind defaults{};
            Kind::parameters(usual, defaults);
            record.usual = std::move(usual.hashes);
            Kind::parameters(record, parameters);
        },
        s.parameters);
    hash.add(std::string_view(s.name)), hash.add(std::string_view(s.sdf_type));
    for (double x : {s.X_LS.p.x, s.X_LS.p.y, s.X_LS.p.z, s.X_LS.q.w, s.X_LS.q.x, s.X_LS.q.y, s.X_LS.q.z,
                     s.update_rate_hz})
        hash.add(x);
    for (const auto& [name, value] : record.numbers) hash.add(value);
    for (const auto& [name, noise] : record.noises) add_value(hash, noise);
    add_value(hash, static_cast<int>(s.kind().number));
    for (const auto& [name, count] : record.counts) add_value(hash, count);
    add_value(hash, static_cast<int>(info.link.value));
    for (const std::string& joint : record.joints) hash.add(std::string_view(joint));
    if (record.has_rest) hash.add(record.rest.value());
}

std::string ros_names(const RobotType& type) {
    std::string names;
    for (const SensorInfo& sensor : type.sensors)
        names += sensor.spec.ros_topic + "\n" + sensor.spec.ros_frame + "\n";
    return names;
}

}  // namespace roboss
