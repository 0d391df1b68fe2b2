// What holds for the parameters and readings of every kind.
#include "sensor_kinds/sensor_spec.h"

#include <cmath>
#include <type_traits>

namespace roboss {
namespace {

struct ProblemFinder {
    std::vector<SensorProblem>& problems;

    void operator()(const Parameter& parameter, double value) const {
        if (std::isnan(value) || (std::isinf(value) && !parameter.infinite))
            problems.push_back({"has a " + std::string(parameter.name) + " that is not a finite number",
                                "Write a finite <" + std::string(parameter.element) + ">."});
    }
    void operator()(const Parameter& parameter, const NoiseSpec& noise) const {
        for (const double value :
             {noise.mean, noise.stddev, noise.bias_mean, noise.bias_stddev, noise.precision,
              noise.dynamic_bias_stddev, noise.dynamic_bias_correlation_time})
            if (!std::isfinite(value)) return (*this)(parameter, value);
        if (noise.dynamic_bias_correlation_time < 0)
            problems.push_back(
                {"has a bias with a negative correlation time (" + std::string(parameter.element) + ")",
                 "Write <dynamic_bias_correlation_time> in s."});
        if (noise.stddev < 0 || noise.bias_stddev < 0 || noise.dynamic_bias_stddev < 0)
            problems.push_back(
                {"has noise with a negative standard deviation (" + std::string(parameter.element) + ")",
                 "Write standard deviations of at least 0."});
    }
    void operator()(const Parameter& parameter, const Vec3& value) const {
        if (!is_finite(value)) (*this)(parameter, std::nan(""));
    }
    void operator()(const Parameter& parameter, const Pose& value) const {
        if (!is_finite(value)) (*this)(parameter, std::nan(""));
    }
    void operator()(const Parameter& parameter, const std::vector<double>& values) const {
        for (const double value : values) (*this)(parameter, value);
    }
    template <class Value>
    requires(!std::is_same_v<Value, double>) void operator()(const Parameter&, const Value&) const {}
};

struct JointFinder {
    std::vector<std::string>& joints;
    void operator()(const Parameter&, const JointNames& names) const {
        joints.insert(joints.end(), names.begin(), names.end());
    }
    template <class Value>
    void operator()(const Parameter&, const Value&) const {}
};

}  // namespace

bool make_sample(std::uint32_t number, Sample& sample) {
    return std::visit(
        [&]<class Kind>(const Kind&) {
            if constexpr (requires { typename Kind::Reading; }) {
                sample = typename Kind::Reading{};
                return true;
            }
            return false;
        },
        parameters_of_kind([&](const SensorKind& kind) { return kind.number == number; }));
}

std::uint32_t number_of(const Sample& sample) {
    return std::visit([]<class Reading>(const Reading&) { return kind_of_reading<Reading>().number; },
                      sample);
}

Tick taken_at(const Sample& sample) {
    return std::visit([](const auto& reading) { return reading.tick; }, sample);
}

std::vector<std::string> joints_read(const SensorSpec& sensor) {
    std::vector<std::string> joints;
    visit_parameters(sensor.parameters, JointFinder{joints});
    return joints;
}

std::vector<SensorProblem> problems_of(const SensorSpec& sensor) {
    std::vector<SensorProblem> problems;
    if (!std::isfinite(sensor.update_rate_hz))
        problems.push_back({"has an update rate that is not a finite number", "Write <update_rate> in Hz."});
    if (!is_finite(sensor.X_LS))
        problems.push_back({"has a pose that is not finite", "Write finite numbers in its <pose>."});
    visit_parameters(sensor.parameters, ProblemFinder{problems});
    std::visit([&](const auto& parameters) { parameters.check(problems); }, sensor.parameters);
    return problems;
}

}  // namespace roboss
