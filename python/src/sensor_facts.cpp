// Facts about a sensor: where it is, and the parameters of its kind.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <concepts>

#include "bindings.h"
#include "errors.h"
#include "roboss/math/array_rows.h"
#include "roboss/model/model.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

nb::object python_value(const Vec3& v) {
    return nb::make_tuple(v.x, v.y, v.z);
}

nb::object python_value(const Pose& X) {
    std::vector<double> row(7);
    put_row(X, row.data());
    return nb::tuple(nb::cast(row));
}

nb::object python_value(const NoiseSpec& noise) {
    nb::dict all;
    all["mean"] = noise.mean, all["stddev"] = noise.stddev;
    all["bias_mean"] = noise.bias_mean, all["bias_stddev"] = noise.bias_stddev;
    all["precision"] = noise.precision;
    all["dynamic_bias_stddev"] = noise.dynamic_bias_stddev;
    all["dynamic_bias_correlation_time"] = noise.dynamic_bias_correlation_time;
    return all;
}

/// A number, a truth value, a text, or a list of them; what is none of these has no value in Python.
template <class T>
nb::object python_value(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::same_as<T, std::string>)
        return nb::cast(value);
    else if constexpr (std::same_as<T, std::vector<double>>)
        return nb::tuple(nb::cast(value));
    else if constexpr (std::derived_from<T, std::vector<std::string>>)
        return nb::tuple(nb::cast(static_cast<const std::vector<std::string>&>(value)));
    else
        return nb::none();
}

/// (name, unit, value) of each parameter of the kind.
nb::list parameters_of(const SensorSpec& spec) {
    nb::list all;
    visit_parameters(spec.parameters, [&](const Parameter& parameter, const auto& value) {
        all.append(nb::make_tuple(parameter.name, parameter.unit, python_value(value)));
    });
    return all;
}

nb::dict facts_of_sensor(const std::shared_ptr<const Model>& model, std::uint32_t robot, std::size_t sensor) {
    const RobotType& type = model->type_of(RobotId(robot));
    const SensorInfo& info = type.sensors[sensor];
    nb::dict facts;
    facts["kind"] = info.spec.kind().name;
    facts["link"] = type.links[info.link.index()].name;
    facts["pose"] = python_value(info.spec.X_LS);
    facts["update_rate"] = info.spec.update_rate_hz;
    facts["parameters"] = parameters_of(info.spec);
    const auto* laser = info.spec.as<LaserSpec>();
    facts["columns"] = laser != nullptr ? laser->column_angles() : std::vector<double>();
    facts["rows"] = laser != nullptr ? laser->row_angles() : std::vector<double>();
    return facts;
}

}  // namespace

void bind_sensor_facts(nb::module_& module) {
    module.def("facts_of_sensor", &facts_of_sensor, nb::arg("model"), nb::arg("robot"), nb::arg("sensor"));
}

}  // namespace roboss_python
