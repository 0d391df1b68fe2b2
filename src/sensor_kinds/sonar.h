// The sonar (SDF: sonar): how near the nearest surface in a cone is.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What a sonar measures.
struct SonarReading {
    /// m, from the sensor's origin. +infinity: nothing within range_max; -infinity: something nearer than
    /// range_min.
    double range = 0;
    Tick tick = 0;  ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"range", "m"}, r.range);
    }
};

/// As in Gazebo Classic, the cone opens from the sensor's origin along its *negative z axis*. "sphere": all
/// directions.
struct SonarSpec {
    using Reading = SonarReading;  ///< what it measures

    std::string geometry = "cone";  ///< "cone" or "sphere"
    double range_min = 0,           ///< m
        range_max = 1,              ///< m
        radius = 0.5;               ///< m, of the cone at range_max

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 43,
                                      .name = "sonar",
                                      .phrase = "a sonar",
                                      .sdf_types = "sonar",
                                      .block = "sonar",
                                      .block_required = true,
                                      .needs_all_states = true,
                                      .by_rays = true};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"geometry", "geometry"}, s.geometry);
        visit({"range_min", "min", "m"}, s.range_min);
        visit({"range_max", "max", "m"}, s.range_max);
        visit({"radius", "radius", "m"}, s.radius);
    }
    /// Compares all members.
    friend bool operator==(const SonarSpec&, const SonarSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        if (geometry != "cone" && geometry != "sphere")
            problems.push_back({"has the <geometry> '" + geometry + "'", "Write cone or sphere."});
        if (!(range_min >= 0 && range_max > range_min))
            problems.push_back({"has a range from " + std::to_string(range_min) + " to " +
                                    std::to_string(range_max) + " m: it hears nothing",
                                "Write 0 <= <min> < <max>."});
        if (!(radius >= 0))
            problems.push_back({"has a <radius> of " + std::to_string(radius) + " m",
                                "Write the radius of the cone at <max>."});
    }
};

}  // namespace roboss
