// The thermal camera (SDF: thermal_camera): temperatures of Gazebo's Thermal plugin.
#pragma once

#include <vector>

#include "core/types.h"
#include "sensor_kinds/camera_optics.h"
#include "sensor_kinds/image.h"

namespace roboss {

/// What a thermal camera sees.
struct ThermalCameraReading {
    Image<float> temperature;        ///< K
    std::vector<double> intrinsics,  ///< fx fy cx cy, pixels
        distortion;                  ///< k1 k2 p1 p2 k3
    Tick tick = 0;                   ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"temperature", "K"}, r.temperature);
        visit({"intrinsics", "pixels"}, r.intrinsics);
        visit({"distortion"}, r.distortion);
    }
};

/// A visual has the temperature that Gazebo's Thermal plugin gives it, everything else that of the air. It is
/// clamped to the range, then rounded to the resolution, then noise is added.
struct ThermalCameraSpec {
    using Reading = ThermalCameraReading;  ///< what it measures

    CameraOptics optics;      ///< size, lens, clip planes
    double ambient = 288.15,  ///< K, of what has no temperature, and of the sky
        min = 0,              ///< K, ThermalSensor plugin
        max = 655.35,         ///< K, ThermalSensor plugin
        resolution = 0.01;    ///< K, ThermalSensor plugin
    NoiseSpec noise;          ///< K

    /// What this kind states about itself.
    static constexpr SensorKind kKind =
        CameraOptics::kind(49, "thermal camera", "a thermal camera", "thermal|thermal_camera");

    /// Calls visit(Parameter, value) for each parameter, always in the same order. The importer reads those
    /// of the ThermalSensor plugin, which stands beside the block.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        CameraOptics::parameters(visit, s.optics);
        visit({"ambient", "", "K"}, s.ambient);
        visit({"min_temp", "", "K"}, s.min);
        visit({"max_temp", "", "K"}, s.max);
        visit({"resolution", "", "K"}, s.resolution);
        visit({"noise", "noise", "K"}, s.noise);
    }
    /// Compares all members.
    friend bool operator==(const ThermalCameraSpec&, const ThermalCameraSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        optics.check(problems);
        if (!(max > min))
            problems.push_back({"has temperatures from " + std::to_string(min) + " to " +
                                    std::to_string(max) + " K: it sees nothing",
                                "Write <min_temp> below <max_temp>."});
    }
};

}  // namespace roboss
