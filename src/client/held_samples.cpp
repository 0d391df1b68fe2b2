// The held samples and their bytes.
#include "client/held_samples.h"

#include <cmath>

#include "wire/archive.h"

namespace roboss {
namespace {

using wire::field;
using wire::Of;
using wire::Reader;
using wire::Writer;

constexpr std::uint32_t kFormat = 1;

template <class A>
void put_vector(A& a, Of<A, Vec3>& p) {
    field(a, p.x), field(a, p.y), field(a, p.z);
}

template <class A>
void put_numbers(A& a, Of<A, std::vector<double>>& values) {
    if constexpr (A::kReading)
        values.resize(a.count(sizeof(double)));
    else
        a.count(values.size());
    for (auto& x : values) field(a, x);
}

template <class A>
void put_reading(A& a, Of<A, LaserReading>& r) {
    field(a, r.samples), field(a, r.vertical_samples), put_numbers(a, r.ranges), field(a, r.tick);
}

template <class A>
void put_reading(A& a, Of<A, GpsReading>& r) {
    put_vector(a, r.p_W), put_vector(a, r.v_W), field(a, r.geodetic);
    field(a, r.latitude_rad), field(a, r.longitude_rad), field(a, r.altitude_m), field(a, r.tick);
}

template <class A>
void put_reading(A& a, Of<A, CompassReading>& r) {
    field(a, r.q_WS.w), field(a, r.q_WS.x), field(a, r.q_WS.y), field(a, r.q_WS.z);
    put_vector(a, r.angular_velocity_S), put_vector(a, r.magnetic_field_S);
    field(a, r.heading_rad), field(a, r.tick);
}

template <class A>
void put_reading(A& a, Of<A, OdometerReading>& r) {
    put_numbers(a, r.joint_positions), put_numbers(a, r.joint_velocities);
    field(a, r.distance), field(a, r.speed), field(a, r.tick);
}

Sample empty_sample(std::uint32_t kind, Reader& reader) {
    switch (kind) {
        case 0:
            return LaserReading{};
        case 1:
            return GpsReading{};
        case 2:
            return CompassReading{};
        case 3:
            return OdometerReading{};
        default:
            reader.fail("a sample is of no known kind");
            return LaserReading{};
    }
}

}  // namespace

Tick taken_at(const Sample& sample) {
    return std::visit([](const auto& reading) { return reading.tick; }, sample);
}

std::int64_t samples_begun(double rate_hz, double dt_s, Tick tick) {
    constexpr double kRounding = 1e-6;  // of a sample: 20 Hz at 1 ms is every fiftieth tick
    const double a_tick = rate_hz * dt_s;
    if (a_tick >= 1) return tick;
    return static_cast<std::int64_t>(std::floor(a_tick * static_cast<double>(tick) + kRounding));
}

bool sample_is_due(double rate_hz, double dt_s, Tick taken, Tick now) {
    return samples_begun(rate_hz, dt_s, now) != samples_begun(rate_hz, dt_s, taken);
}

const Sample* HeldSamples::find(const Key& key) const {
    const auto found = held_.find(key);
    return found == held_.end() ? nullptr : &found->second.sample;
}

const Sample& HeldSamples::put(const Key& key, Sample sample) {
    const auto [held, is_new] = held_.try_emplace(key);
    Held& entry = held->second;
    if (is_new)
        entry.before.reset();
    else
        entry.before = std::move(entry.sample);
    entry.sample = std::move(sample);
    return entry.sample;
}

std::string HeldSamples::bytes_before(Tick tick) const {
    Writer writer;
    field(writer, kFormat);
    bool any = false;
    for (const auto& [key, held] : held_) {
        const Sample* sample = taken_at(held.sample) < tick ? &held.sample
                               : held.before                ? &*held.before
                                                            : nullptr;
        if (sample == nullptr) continue;
        any = true;
        const auto kind = static_cast<std::uint32_t>(sample->index());
        field(writer, key.first), field(writer, key.second), field(writer, kind);
        std::visit([&](const auto& reading) { put_reading(writer, reading); }, *sample);
    }
    if (!any) return {};
    const std::vector<std::uint8_t> bytes = writer.take();
    return {bytes.begin(), bytes.end()};
}

Result<> HeldSamples::restore(const std::string& bytes) {
    std::map<Key, Held> held;
    Reader reader({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    std::uint32_t format = kFormat;
    if (!bytes.empty()) field(reader, format);
    if (format != kFormat) reader.fail("they are of another version");
    while (!reader.failed() && reader.left() > 0) {
        Key key;
        std::uint32_t kind = 0;
        field(reader, key.first), field(reader, key.second), field(reader, kind);
        Sample sample = empty_sample(kind, reader);
        std::visit([&](auto& reading) { put_reading(reader, reading); }, sample);
        held[key] = {std::move(sample), {}};
    }
    if (reader.failed())
        return Error{"the sensors' samples in a saved run cannot be read: " + reader.failure(),
                     "save the run again with this version"};
    held_ = std::move(held);
    return Ok{};
}

}  // namespace roboss
