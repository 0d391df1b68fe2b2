// The environmental sensor (SDF: custom, gz:type="environmental_sensor/VARIABLE"): a column of a table, by
// place and time.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What an environmental sensor measures.
struct EnvironmentalReading {
    std::vector<double> values;  ///< 1 or 3, in the table's units; empty: the table says nothing here and now
    Tick tick = 0;               ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"values"}, r.values);
    }
};

/// The table is a grid over time and three coordinates; between its points, values are linear in each. The
/// importer reads it from the file of EnvironmentPreload and adds the columns that the sensor names.
struct EnvironmentalSpec {
    using Reading = EnvironmentalReading;  ///< what it measures

    std::string output_format = "scalar",  ///< "scalar" or "vector3"
        transform_type = "GLOBAL",         ///< of a vector: [ADD_VELOCITY_]GLOBAL or [ADD_VELOCITY_]LOCAL
        variable;                          ///< column of a scalar
    std::string variable_x,                ///< column of a vector; "": zero
        variable_y,                        ///< column of a vector; "": zero
        variable_z;                        ///< column of a vector; "": zero
    std::string reference;       ///< of the coordinates: "global", "spherical" or "ecef"; "": no table
    bool in_degrees = false;     ///< latitude and longitude of "spherical"; else rad
    bool is_static = false;      ///< time does not count
    std::vector<double> times,   ///< s, ascending
        xs,                      ///< m, or latitude; ascending
        ys,                      ///< m, or longitude; ascending
        zs;                      ///< m; ascending
    std::vector<double> values;  ///< column by column; in a column, z runs fastest, then y, x, time

    /// Its elements of SDF that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"topic", "", "readings go to Clients, not to topics"},
        {"frame_id", "", "readings go to Clients, not to topics"},
    };
    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 42,
                                      .name = "environmental sensor",
                                      .phrase = "an environmental sensor",
                                      .sdf_types = "environmental_sensor",
                                      .ignored = kIgnored};

    /// Whether it reads three columns.
    bool is_vector() const { return output_format == "vector3"; }
    /// The columns that it reads; "": zero.
    std::vector<std::string> columns() const {
        if (is_vector()) return {variable_x, variable_y, variable_z};
        return {variable};
    }
    /// Points of the grid.
    std::size_t points() const { return times.size() * xs.size() * ys.size() * zs.size(); }

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"output_format", "output_format"}, s.output_format);
        visit({"transform_type", "transform_type"}, s.transform_type);
        visit({"variable", "environment_variable"}, s.variable);
        visit({"variable_x", "environment_variable_x"}, s.variable_x);
        visit({"variable_y", "environment_variable_y"}, s.variable_y);
        visit({"variable_z", "environment_variable_z"}, s.variable_z);
        visit({"reference", ""}, s.reference);
        visit({"in_degrees", ""}, s.in_degrees);
        visit({"is_static", ""}, s.is_static);
        visit({"times", "", "s"}, s.times);
        visit({"xs", ""}, s.xs);
        visit({"ys", ""}, s.ys);
        visit({"zs", ""}, s.zs);
        visit({"values", ""}, s.values);
    }
    /// Compares all members.
    friend bool operator==(const EnvironmentalSpec&, const EnvironmentalSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
