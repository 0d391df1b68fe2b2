// What sensors with an <update_rate> measured last. A Client holds a sample until the next is due; what it
// holds is part of what a saved run remembers of its program, so that a run that continues reads the same.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/result.h"
#include "sensor_kinds/sensor_spec.h"

namespace roboss {

/// How many samples a sensor of this rate has begun by a tick. Sample k (from 0) is due at the first tick not
/// before k / rate, whether or not the rate divides the ticks of a second; so in the long run the rate is
/// exact. Above one sample a tick there is a new one in every tick.
std::int64_t samples_begun(double rate_hz, double dt_s, Tick tick);
/// Whether it has begun another by `now` than the one taken at `taken`.
bool sample_is_due(double rate_hz, double dt_s, Tick taken, Tick now);

/// False of a laser's sample that lacks ranges or has too many: programs take one for each beam for granted.
/// For samples that come from files and devices.
bool has_its_beams(const SensorSpec& sensor, const Sample& sample);

class HeldSamples {
  public:
    using Key = std::pair<std::uint32_t, std::uint32_t>;  // RobotId, number of the sensor
    struct Held {
        Sample sample;
        std::optional<Sample> before;  // the one that it replaced; none: it was the first
    };

    const Sample* find(const Key& key) const;
    const Sample& put(const Key& key, Sample sample);
    std::map<Key, Held>& all() { return held_; }
    /// Those that were held before the observation at `tick`, as bytes; empty: none. Goes back by one
    /// observation at most.
    std::string bytes_before(Tick tick) const;
    /// Replaces all; an Error changes nothing.
    Result<> restore(const std::string& bytes);

  private:
    std::map<Key, Held> held_;
};

}  // namespace roboss
