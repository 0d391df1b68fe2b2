// Cameras that measure distances (SDF: depth_camera, rgbd_camera).
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "sensor_kinds/camera_optics.h"
#include "sensor_kinds/image.h"

namespace roboss {

/// What a depth camera sees.
struct DepthCameraReading {
    Image<float> depth;              ///< m along the camera's axis; +infinity: nothing before the far plane
                                     ///< -infinity: something before the near plane
    std::vector<double> intrinsics,  ///< fx fy cx cy, pixels
        distortion;                  ///< k1 k2 p1 p2 k3
    Tick tick = 0;                   ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"depth", "m"}, r.depth);
        visit({"intrinsics", "pixels"}, r.intrinsics);
        visit({"distortion"}, r.distortion);
    }
};

/// Measured from the camera's origin along its x axis, not along the ray. Noise is added to finite depths.
struct DepthCameraSpec {
    using Reading = DepthCameraReading;  ///< what it measures

    CameraOptics optics;  ///< size, lens, clip planes
    NoiseSpec noise;      ///< m

    /// What this kind states about itself.
    static constexpr SensorKind kKind =
        CameraOptics::kind(45, "depth camera", "a depth camera", "depth|depth_camera");

    /// Calls visit(Parameter, value) for each parameter, always in the same order. A `<clip>` of
    /// `<depth_camera>` comes before that of the camera.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        CameraOptics::parameters(visit, s.optics);
        visit({"near_of_depth", "depth_camera/clip/near", "m"}, s.optics.near);
        visit({"far_of_depth", "depth_camera/clip/far", "m", true}, s.optics.far);
        visit({"noise", "noise", "m"}, s.noise);
    }
    /// Compares all members.
    friend bool operator==(const DepthCameraSpec&, const DepthCameraSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const { optics.check(problems); }
};

/// What an RGB-D camera sees: of each pixel colour and depth.
struct RgbdCameraReading {
    Image<std::uint8_t> color;       ///< as CameraReading::color
    Image<float> depth;              ///< as DepthCameraReading::depth
    std::vector<double> intrinsics,  ///< fx fy cx cy, pixels
        distortion;                  ///< k1 k2 p1 p2 k3
    Tick tick = 0;                   ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"color"}, r.color);
        visit({"depth", "m"}, r.depth);
        visit({"intrinsics", "pixels"}, r.intrinsics);
        visit({"distortion"}, r.distortion);
    }
};

/// The clip planes of `<depth_camera>` hold for depth, those of `<camera>` for both. Noise is added to depth,
/// as in Gazebo.
struct RgbdCameraSpec {
    using Reading = RgbdCameraReading;  ///< what it measures

    CameraOptics optics;            ///< size, lens, clip planes
    double depth_near = 0,          ///< m; 0: that of the optics
        depth_far = 0;              ///< m; 0: that of the optics
    std::string format = "R8G8B8";  ///< SDF `<image><format>`: R8G8B8, B8G8R8 or L8
    NoiseSpec noise;                ///< m, of depth

    /// What this kind states about itself.
    static constexpr SensorKind kKind =
        CameraOptics::kind(46, "rgbd camera", "an RGB-D camera", "rgbd|rgbd_camera");

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        CameraOptics::parameters(visit, s.optics);
        visit({"depth_near", "depth_camera/clip/near", "m"}, s.depth_near);
        visit({"depth_far", "depth_camera/clip/far", "m", true}, s.depth_far);
        visit({"format", "image/format"}, s.format);
        visit({"noise", "noise", "m"}, s.noise);
    }
    /// Compares all members.
    friend bool operator==(const RgbdCameraSpec&, const RgbdCameraSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const { optics.check(problems); }
};

}  // namespace roboss
