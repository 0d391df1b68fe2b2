// WindEffects of Gazebo: the wind of the world changes with time, and pushes what it may carry. The plugin
// belongs to the world; each robot that feels the wind runs one, whose memory holds the wind of the tick.
#pragma once

#include <string>
#include <vector>

#include "math/vec3.h"
#include "onboard_kinds/kind.h"

namespace roboss {

/// A part of space, and how strongly the wind pushes there: a sum of three polynomials, one for each
/// coordinate of the place (m, world axes).
struct WindRegion {
    Vec3 lower{-1e300, -1e300, -1e300},  ///< m, of the box that it is; the faces belong to it
        upper{1e300, 1e300, 1e300};      ///< m
    Vec3 cubic, square, linear;          ///< coefficients of each coordinate's polynomial
    double constant = 0;                 ///< 1/s

    /// Whether the place is in it.
    bool holds(const Vec3& p) const {
        return p.x >= lower.x && p.y >= lower.y && p.z >= lower.z && p.x <= upper.x && p.y <= upper.y &&
               p.z <= upper.z;
    }
    /// 1/s; at least 0, since a negative factor would feed motion against the wind.
    double factor(const Vec3& p) const {
        double sum = constant;
        for (std::size_t k = 0; k < 3; ++k) sum += ((cubic[k] * p[k] + square[k]) * p[k] + linear[k]) * p[k];
        return sum > 0 ? sum : 0.0;
    }
    /// Compares all members.
    friend bool operator==(const WindRegion&, const WindRegion&) = default;
};

/// The wind's horizontal magnitude and direction and its vertical part approach the world's wind, each with a
/// lag, and get a sine and Gaussian noise on top.
struct WindEffectsSpec {
    double scale = 1;  ///< 1/s: force = mass * scale * (wind - velocity)
    /// In place of `scale`, if there are any: the first that holds a place counts there, elsewhere the wind
    /// does not push. Part of the Model, not of the controllers.
    std::vector<WindRegion> regions;
    double magnitude_rise = 1,          ///< s, lag of the magnitude
        magnitude_amplitude = 0,        ///< share of the magnitude
        magnitude_period = 1,           ///< s
        magnitude_noise_mean = 0,       ///< m/s
        magnitude_noise_deviation = 0;  ///< m/s
    double direction_rise = 1,          ///< s, lag of the direction
        direction_amplitude = 0,        ///< degrees
        direction_period = 1,           ///< s
        direction_noise_mean = 0,       ///< degrees
        direction_noise_deviation = 0;  ///< degrees
    double vertical_rise = 1,           ///< s, lag of the vertical part
        vertical_noise_mean = 0,        ///< m/s
        vertical_noise_deviation = 0;   ///< m/s

    /// Places in its memory.
    enum Memory { kStarted, kMagnitude, kDirection, kVertical, kWindX, kWindY, kWindZ, kMemorySize };

    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 68,
                                       .name = "wind-effects",
                                       .phrase = "wind effects",
                                       .classes = "WindEffects",
                                       .files = "wind-effects-system"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"scale", "force_approximation_scaling_factor"}, s.scale);
        visit({"magnitude_rise", "horizontal/magnitude/time_for_rise", "s"}, s.magnitude_rise);
        visit({"magnitude_amplitude", "horizontal/magnitude/sin/amplitude_percent"}, s.magnitude_amplitude);
        visit({"magnitude_period", "horizontal/magnitude/sin/period", "s"}, s.magnitude_period);
        visit({"magnitude_noise_mean", "horizontal/magnitude/noise/mean", "m/s"}, s.magnitude_noise_mean);
        visit({"magnitude_noise_deviation", "horizontal/magnitude/noise/stddev", "m/s"},
              s.magnitude_noise_deviation);
        visit({"direction_rise", "horizontal/direction/time_for_rise", "s"}, s.direction_rise);
        visit({"direction_amplitude", "horizontal/direction/sin/amplitude"}, s.direction_amplitude);
        visit({"direction_period", "horizontal/direction/sin/period", "s"}, s.direction_period);
        visit({"direction_noise_mean", "horizontal/direction/noise/mean"}, s.direction_noise_mean);
        visit({"direction_noise_deviation", "horizontal/direction/noise/stddev"},
              s.direction_noise_deviation);
        visit({"vertical_rise", "vertical/time_for_rise", "s"}, s.vertical_rise);
        visit({"vertical_noise_mean", "vertical/noise/mean", "m/s"}, s.vertical_noise_mean);
        visit({"vertical_noise_deviation", "vertical/noise/stddev", "m/s"}, s.vertical_noise_deviation);
    }
    /// The commands that it takes: the wind that it approaches, and whether it blows.
    std::vector<Channel> channels() const {
        return {Channel{"wind",
                        "/world/{world}/wind",
                        {{"x", "m/s"}, {"y", "m/s"}, {"z", "m/s"}, {"enable_wind", ""}},
                        false}};
    }
    /// Its memory.
    std::vector<double> memory() const { return std::vector<double>(kMemorySize, 0.0); }
    /// The wind does not stand still: what it pushes must not sleep.
    bool rests(std::span<const double>) const { return false; }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const;
    /// Compares all members.
    friend bool operator==(const WindEffectsSpec&, const WindEffectsSpec&) = default;
};

}  // namespace roboss
