// The colour camera (SDF: camera, wideanglecamera).
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "sensor_kinds/camera_optics.h"
#include "sensor_kinds/image.h"

namespace roboss {

/// What a camera sees.
struct CameraReading {
    Image<std::uint8_t> color;       ///< red, green, blue (or grey) of each pixel, as screens show them
    std::vector<double> intrinsics,  ///< fx fy cx cy, pixels; of a wide angle camera: as if it were pinhole
        distortion;                  ///< k1 k2 p1 p2 k3
    Tick tick = 0;                   ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"color"}, r.color);
        visit({"intrinsics", "pixels"}, r.intrinsics);
        visit({"distortion"}, r.distortion);
    }
};

/// It sees the visuals of the world in the light of the world. Noise is added to each channel, in 0..1.
struct ColorCameraSpec {
    using Reading = CameraReading;  ///< what it measures

    CameraOptics optics;            ///< size, lens, clip planes
    std::string format = "R8G8B8";  ///< SDF `<image><format>`: R8G8B8, B8G8R8 or L8
    NoiseSpec noise;                ///< of each channel, 0..1

    /// What this kind states about itself.
    static constexpr SensorKind kKind =
        CameraOptics::kind(44, "camera", "a camera", "camera|wideanglecamera|wide_angle_camera");

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        CameraOptics::parameters(visit, s.optics);
        visit({"format", "image/format"}, s.format);
        visit({"noise", "noise"}, s.noise);
    }
    /// Compares all members.
    friend bool operator==(const ColorCameraSpec&, const ColorCameraSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const { optics.check(problems); }
};

}  // namespace roboss
