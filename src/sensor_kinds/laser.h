// The laser range finder: a fan or grid of beams (SDF: ray, lidar and their gpu_ names).
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What a laser measures.
struct LaserReading {
    int samples = 0,           ///< beams of a row
        vertical_samples = 0;  ///< rows
    /// m, row by row (vertical angle ascending), within a row by ascending horizontal angle. +infinity:
    /// nothing within range_max; -infinity: something nearer than range_min.
    std::vector<double> ranges;
    /// By beam: `<laser_retro>` of what it meets, 0 where it meets nothing within range. Empty where nothing
    /// in the world has one.
    std::vector<double> intensities;
    Tick tick = 0;  ///< of the measurement, as in all readings

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"samples"}, r.samples);
        visit({"vertical_samples"}, r.vertical_samples);
        visit({"ranges", "m"}, r.ranges);
        visit({"intensities"}, r.intensities);
    }
};

/// Beam (row, column) points along (cos e cos a, cos e sin a, sin e) of the sensor frame, with a in
/// [min_angle, max_angle] and e in the vertical range, both ends included; a single sample points along the
/// smaller end. Where `angles` or `vertical_angles` are given, these are a or e instead. Surfaces are seen
/// from both sides. Noise is added first, then the range is rounded to range_resolution, then clamped to
/// [range_min, range_max]. Whether a beam is out of range is judged without noise.
struct LaserSpec {
    using Reading = LaserReading;  ///< what it measures

    int samples = 1,                ///< beams of a row
        vertical_samples = 1;       ///< rows
    double min_angle = 0,           ///< rad, about the sensor's z
        max_angle = 0;              ///< rad, about the sensor's z
    double vertical_min_angle = 0,  ///< rad, above the sensor's xy plane
        vertical_max_angle = 0;     ///< rad, above the sensor's xy plane
    std::vector<double> angles,     ///< rad, about the sensor's z; empty: `samples` of them, evenly spaced
        vertical_angles;            ///< rad; empty: `vertical_samples` of them, evenly spaced
    double range_min = 0,           ///< m
        range_max = 0,              ///< m
        range_resolution = 0;       ///< m; 0: any
    NoiseSpec noise;                ///< m

    /// Its elements of SDF that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"scan/horizontal/resolution", "1", "every one of the <samples> is a beam of its own"},
        {"scan/vertical/resolution", "1", "every one of the <samples> is a beam of its own"},
        {"visibility_mask", "4294967295", "beams meet collision shapes, which have no <visibility_flags>"},
    };
    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 0,
                                      .name = "laser",
                                      .phrase = "a laser",
                                      .sdf_types = "ray|lidar|gpu_ray|gpu_lidar",
                                      .block = "lidar|ray",
                                      .block_required = true,
                                      .needs_all_states = true,
                                      .by_rays = true,
                                      .ignored = kIgnored};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"samples", "scan/horizontal/samples"}, s.samples);
        visit({"min_angle", "scan/horizontal/min_angle", "rad"}, s.min_angle);
        visit({"max_angle", "scan/horizontal/max_angle", "rad"}, s.max_angle);
        visit({"vertical_samples", "scan/vertical/samples"}, s.vertical_samples);
        visit({"vertical_min_angle", "scan/vertical/min_angle", "rad"}, s.vertical_min_angle);
        visit({"vertical_max_angle", "scan/vertical/max_angle", "rad"}, s.vertical_max_angle);
        visit({"range_min", "range/min", "m"}, s.range_min);
        visit({"range_max", "range/max", "m", true}, s.range_max);
        visit({"range_resolution", "range/resolution", "m"}, s.range_resolution);
        visit({"noise", "noise", "m"}, s.noise);
        visit({.name = "angles", .element = "scan/horizontal/roboss:angles", .unit = "rad", .later = true},
              s.angles);
        visit({.name = "vertical_angles",
               .element = "scan/vertical/roboss:angles",
               .unit = "rad",
               .later = true},
              s.vertical_angles);
    }

    /// Beams of a row.
    int columns() const { return angles.empty() ? samples : static_cast<int>(angles.size()); }
    /// Rows of beams.
    int rows() const {
        return vertical_angles.empty() ? vertical_samples : static_cast<int>(vertical_angles.size());
    }
    /// a of each column, rad.
    std::vector<double> column_angles() const {
        return angles.empty() ? evenly(samples, min_angle, max_angle) : angles;
    }
    /// e of each row, rad.
    std::vector<double> row_angles() const {
        return vertical_angles.empty() ? evenly(vertical_samples, vertical_min_angle, vertical_max_angle)
                                       : vertical_angles;
    }

    /// Compares all members.
    friend bool operator==(const LaserSpec&, const LaserSpec&) = default;

    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        constexpr std::int64_t kBeamsMax = 1 << 24;
        if (columns() < 1 || rows() < 1)
            problems.push_back({"has " + std::to_string(columns()) + " x " + std::to_string(rows()) +
                                    " <samples>; a laser needs at least 1 x 1",
                                "Write the number of beams."});
        else if (columns() > kBeamsMax || rows() > kBeamsMax / columns())
            problems.push_back(
                {"has more than " + std::to_string(kBeamsMax) + " beams", "Write fewer <samples>."});
        if (!(range_min >= 0 && range_max > range_min))
            problems.push_back({"has a range from " + std::to_string(range_min) + " to " +
                                    std::to_string(range_max) + " m: it sees nothing",
                                "Write <range> with 0 <= <min> < <max>."});
        if (!std::ranges::is_sorted(angles) || !std::ranges::is_sorted(vertical_angles))
            problems.push_back({"has <roboss:angles> that do not ascend", "Write them in ascending order."});
    }

  private:
    /// `count` angles from min to max, both included; a single one is min.
    static std::vector<double> evenly(int count, double min, double max) {
        std::vector<double> all;
        all.reserve(static_cast<std::size_t>(count));
        const double step = count > 1 ? (max - min) / (count - 1) : 0.0;
        for (int i = 0; i < count; ++i) all.push_back(min + step * i);
        return all;
    }
};

}  // namespace roboss
