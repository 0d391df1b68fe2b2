// The held samples and their bytes.
#include "client/held_samples.h"

#include <cmath>

#include "core/archive.h"
#include "core/check.h"

namespace roboss {
namespace {

using wire::field;
using wire::Of;
using wire::Reader;
using wire::Writer;

constexpr std::uint32_t kFormat = 2;

/// Writes or reads the values of a reading.
template <class A>
struct FieldArchive {
    A& a;

    void put(Of<A, double>& value) const { field(a, value); }
    void put(Of<A, int>& value) const { field(a, value); }
    void put(Of<A, bool>& value) const { field(a, value); }
    void put(Of<A, Vec3>& p) const { field(a, p.x), field(a, p.y), field(a, p.z); }
    void put(Of<A, Quat>& q) const { field(a, q.w), field(a, q.x), field(a, q.y), field(a, q.z); }
    void put(Of<A, std::vector<double>>& values) const {
        if constexpr (A::kReading)
            values.resize(a.count(sizeof(double)));
        else
            a.count(values.size());
        for (auto& x : values) field(a, x);
    }
    void put(Of<A, std::vector<std::string>>& texts) const {
        if constexpr (A::kReading)
            texts.resize(a.count(sizeof(std::uint32_t)));
        else
            a.count(texts.size());
        for (auto& text : texts) field(a, text);
    }
    /// Images are measured again (SensorKind::is_image).
    template <class T>
    void put(const Image<T>&) const {
        ROBOSS_CHECK(false, "an image is never held");
    }
    template <class Value>
    void operator()(const ReadingField&, Value& value) const {
        put(value);
    }
};

void write_sample(Writer& a, const Sample& sample) {
    visit_fields(sample, FieldArchive<Writer>{a});
    const Tick tick = taken_at(sample);
    field(a, tick);
}

Sample read_sample(Reader& a, std::uint32_t kind) {
    Sample sample;
    const bool known = make_sample(kind, sample);
    const bool held =
        known &&
        std::visit([]<class Reading>(const Reading&) { return kind_of_reading<Reading>().is_held(); },
                   sample);
    if (!held) {
        a.fail(known ? "a sample is of a kind that is never held" : "a sample is of no known kind");
        return sample;
    }
    visit_fields(sample, FieldArchive<Reader>{a});
    std::visit([&a](auto& reading) { field(a, reading.tick); }, sample);
    return sample;
}

}  // namespace

std::int64_t samples_begun(double rate_hz, double dt_s, Tick tick) {
    constexpr double kRounding = 1e-6;  // of a sample: 20 Hz at 1 ms is every fiftieth tick
    const double a_tick = rate_hz * dt_s;
    if (a_tick >= 1) return tick;
    return static_cast<std::int64_t>(std::floor(a_tick * static_cast<double>(tick) + kRounding));
}

bool sample_is_due(double rate_hz, double dt_s, Tick taken, Tick now) {
    return samples_begun(rate_hz, dt_s, now) != samples_begun(rate_hz, dt_s, taken);
}

bool has_its_beams(const SensorSpec& sensor, const Sample& sample) {
    const auto* laser = sensor.as<LaserSpec>();
    const auto* reading = std::get_if<LaserReading>(&sample);
    if (laser == nullptr || reading == nullptr) return true;
    const auto beams =
        static_cast<std::size_t>(laser->samples) * static_cast<std::size_t>(laser->vertical_samples);
    return reading->ranges.size() == beams &&
           (reading->intensities.empty() || reading->intensities.size() == beams);
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
        const std::uint32_t kind = number_of(*sample);
        field(writer, key.first), field(writer, key.second), field(writer, kind);
        write_sample(writer, *sample);
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
        held[key] = {read_sample(reader, kind), {}};
    }
    if (reader.failed())
        return Error{"the sensors' samples in a saved run cannot be read: " + reader.failure(),
                     "save the run again with this version"};
    held_ = std::move(held);
    return Ok{};
}

}  // namespace roboss
