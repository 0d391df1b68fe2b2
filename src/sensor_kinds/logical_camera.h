// The logical camera (SDF: logical_camera): which models are in its field of view, and where.
#pragma once

#include <string>
#include <vector>

#include "core/fixed_math.h"
#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What a logical camera sees: robots in the order of their RobotIds, then scenery in the order of the file.
struct LogicalCameraReading {
    std::vector<std::string> names;  ///< of the models
    std::vector<double> models;      ///< RobotId of each; -1: scenery
    std::vector<double> positions,   ///< m, x y z of each model's frame in the sensor's, one behind the other
        orientations;                ///< w x y z of each, one behind the other
    Tick tick = 0;                   ///< of the measurement

    /// Number of models.
    std::size_t count() const { return models.size(); }

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"names"}, r.names);
        visit({"models"}, r.models);
        visit({"positions", "m"}, r.positions);
        visit({"orientations"}, r.orientations);
    }
};

/// A model is seen where the origin of its frame is in the frustum: along the sensor's x axis from near to
/// far, within half the horizontal angle to both sides, and within the height that follows from the aspect
/// ratio. Nothing hides it. The importer adds the models that have no state of their own.
struct LogicalCameraSpec {
    using Reading = LogicalCameraReading;  ///< what it measures

    double horizontal_fov = 1.05,       ///< rad
        near = 0,                       ///< m, along x
        far = 1,                        ///< m, along x
        aspect_ratio = 1;               ///< width over height of the frustum
    std::vector<std::string> scenery;   ///< names of static models
    std::vector<double> scenery_poses;  ///< x y z (m), w x y z of each in the world, one behind the other

    /// Numbers of one pose in scenery_poses.
    static constexpr std::size_t kPoseSize = 7;

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 38,
                                      .name = "logical camera",
                                      .phrase = "a logical camera",
                                      .sdf_types = "logical_camera",
                                      .block = "logical_camera",
                                      .block_required = true,
                                      .needs_all_states = true};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"horizontal_fov", "horizontal_fov", "rad"}, s.horizontal_fov);
        visit({"near", "near", "m"}, s.near);
        visit({"far", "far", "m"}, s.far);
        visit({"aspect_ratio", "aspect_ratio"}, s.aspect_ratio);
        visit({"scenery", ""}, s.scenery);
        visit({"scenery_poses", ""}, s.scenery_poses);
    }
    /// Compares all members.
    friend bool operator==(const LogicalCameraSpec&, const LogicalCameraSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        if (!(near >= 0 && far > near))
            problems.push_back(
                {"sees from " + std::to_string(near) + " to " + std::to_string(far) + " m: it sees nothing",
                 "Write 0 <= <near> < <far>."});
        if (!(horizontal_fov > 0 && horizontal_fov < kPi))
            problems.push_back({"has a <horizontal_fov> of " + std::to_string(horizontal_fov) + " rad",
                                "Write an angle between 0 and pi."});
        if (!(aspect_ratio > 0))
            problems.push_back({"has an <aspect_ratio> of 0 or less", "Write width over height."});
    }
};

}  // namespace roboss
