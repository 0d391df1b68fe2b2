// Cameras that see labels (SDF: segmentation_camera, boundingbox_camera) of Gazebo's Label plugin.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "sensor_kinds/camera_optics.h"
#include "sensor_kinds/image.h"

namespace roboss {

/// What a segmentation camera sees.
struct SegmentationCameraReading {
    Image<std::uint8_t> labels;  ///< label of each pixel; 0: nothing with a label
    Image<std::uint16_t>
        instances;  ///< of instance and panoptic segmentation: which one of its label, from 1
    std::vector<double> intrinsics,  ///< fx fy cx cy, pixels
        distortion;                  ///< k1 k2 p1 p2 k3
    Tick tick = 0;                   ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"labels"}, r.labels);
        visit({"instances"}, r.instances);
        visit({"intrinsics", "pixels"}, r.intrinsics);
        visit({"distortion"}, r.distortion);
    }
};

/// Labels are those of Gazebo's Label plugin, on a model or on a visual.
struct SegmentationCameraSpec {
    using Reading = SegmentationCameraReading;  ///< what it measures

    CameraOptics optics;            ///< size, lens, clip planes
    std::string type = "semantic";  ///< semantic, instance or panoptic (the two are the same)

    /// What this kind states about itself.
    static constexpr SensorKind kKind = CameraOptics::kind(47, "segmentation camera", "a segmentation camera",
                                                           "segmentation|segmentation_camera");

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        CameraOptics::parameters(visit, s.optics);
        visit({"type", "segmentation_type"}, s.type);
    }
    /// Compares all members.
    friend bool operator==(const SegmentationCameraSpec&, const SegmentationCameraSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        optics.check(problems);
        if (type != "semantic" && type != "instance" && type != "panoptic")
            problems.push_back({"has a <segmentation_type> of '" + type + "', which is not known",
                                "Use semantic, instance or panoptic."});
    }
};

/// The labelled things in the image, in the order of the world.
struct BoxCameraReading {
    std::vector<double> boxes,       ///< 2-D: left, top, right, bottom of each, pixels, one behind the other
        positions,                   ///< 3-D: centres in the camera's frame, x y z, m
        orientations,                ///< 3-D: w x y z of each
        sizes,                       ///< 3-D: edges along the axes of each box, m
        labels;                      ///< of each
    std::vector<double> intrinsics,  ///< fx fy cx cy, pixels
        distortion;                  ///< k1 k2 p1 p2 k3
    Tick tick = 0;                   ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"boxes", "pixels"}, r.boxes);
        visit({"positions", "m"}, r.positions);
        visit({"orientations"}, r.orientations);
        visit({"sizes", "m"}, r.sizes);
        visit({"labels"}, r.labels);
        visit({"intrinsics", "pixels"}, r.intrinsics);
        visit({"distortion"}, r.distortion);
    }
};

/// A thing counts if a pixel shows it. The box `visible_2d` bounds its pixels, `full_2d` what would be seen
/// of it if nothing hid it, `3d` its visuals, along the axes of its model.
struct BoxCameraSpec {
    using Reading = BoxCameraReading;  ///< what it measures

    CameraOptics optics;              ///< size, lens, clip planes
    std::string type = "visible_2d";  ///< visible_2d (2d, visible_box_2d), full_2d (full_box_2d) or 3d

    /// Whether boxes bound the pixels that show a thing.
    bool is_visible() const { return type == "2d" || type == "visible_2d" || type == "visible_box_2d"; }
    /// Whether boxes bound all of a thing, in the image.
    bool is_full() const { return type == "full_2d" || type == "full_box_2d"; }

    /// What this kind states about itself.
    static constexpr SensorKind kKind =
        CameraOptics::kind(48, "box camera", "a bounding box camera", "boundingbox|boundingbox_camera");

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        CameraOptics::parameters(visit, s.optics);
        visit({"type", "box_type"}, s.type);
    }
    /// Compares all members.
    friend bool operator==(const BoxCameraSpec&, const BoxCameraSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        optics.check(problems);
        if (!is_visible() && !is_full() && type != "3d")
            problems.push_back(
                {"has a <box_type> of '" + type + "', which is not known", "Use visible_2d, full_2d or 3d."});
    }
};

}  // namespace roboss
