// The infrared proximity sensor (<roboss:sensor type="infrared">): how near the nearest surface in its cone
// is, and what the robot's converter makes of it.
#pragma once

#include <string>
#include <vector>

#include "core/fixed_math.h"
#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What an infrared sensor measures.
struct InfraredReading {
    double range = 0;  ///< m, from the sensor's origin, without noise; +infinity: nothing within range_max
    double value = 0;  ///< what the robot's program gets, with noise (InfraredSpec::response)
    Tick tick = 0;     ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"value"}, r.value);
        visit({"range", "m"}, r.range);
    }
};

/// The cone opens along the sensor's x axis. Response "distance": the range in m, +infinity where there is
/// none. "khepera": a whole number from 0 (nothing) to 1023, as the proximity sensors of K-Team's Khepera
/// give it: 1100 exp(-(d - 1 cm) / 2.5 cm) at the distance d of a white surface, cut off at 1023.
struct InfraredSpec {
    using Reading = InfraredReading;  ///< what it measures

    double range_max = 0.05;            ///< m; farther nothing is seen
    double opening_angle = 0.35;        ///< rad, from rim to rim; 0: a single ray
    std::string response = "distance";  ///< "distance" or "khepera"
    NoiseSpec noise;                    ///< of the value

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 52,
                                      .name = "infrared",
                                      .phrase = "an infrared sensor",
                                      .sdf_types = "infrared",
                                      .ours = true,
                                      .needs_all_states = true,
                                      .by_rays = true};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"range_max", "max", "m"}, s.range_max);
        visit({"opening_angle", "opening_angle", "rad"}, s.opening_angle);
        visit({"response", "response"}, s.response);
        visit({"noise", "noise"}, s.noise);
    }
    /// Compares all members.
    friend bool operator==(const InfraredSpec&, const InfraredSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        if (!(range_max > 0))
            problems.push_back(
                {"has a range of " + std::to_string(range_max) + " m: it sees nothing", "Write <max> in m."});
        if (!(opening_angle >= 0 && opening_angle <= 2 * kPi))
            problems.push_back({"has an <opening_angle> of " + std::to_string(opening_angle) + " rad",
                                "Write an angle from 0 to 2 pi."});
        if (response != "distance" && response != "khepera")
            problems.push_back({"has the <response> '" + response + "'", "Write distance or khepera."});
    }
};

}  // namespace roboss
