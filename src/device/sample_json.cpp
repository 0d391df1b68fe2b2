// Visits the fields of a reading and takes each by its name.
#include "device/sample_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "client/held_samples.h"

namespace roboss {
namespace {

using nlohmann::json;

struct FieldReader {
    const json& values;
    std::string& wrong;  // what could not be read
    std::size_t read = 0;

    static double number(const json& value) {
        if (value.is_null()) return std::numeric_limits<double>::infinity();  // JSON has no other word for it
        return value.get<double>();
    }
    void put(const json& value, double& to) { to = number(value); }
    void put(const json& value, int& to) { to = value.get<int>(); }
    void put(const json& value, bool& to) { to = value.get<bool>(); }
    void put(const json& value, Vec3& to) {
        to = {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
    }
    void put(const json& value, Quat& to) {
        to = normalized(Quat{value.at(3).get<double>(), value.at(0).get<double>(), value.at(1).get<double>(),
                             value.at(2).get<double>()});
    }
    void put(const json& value, std::vector<double>& to) {
        to.clear();
        for (const json& each : value) to.push_back(number(each));
    }
    void put(const json& value, std::vector<std::string>& to) { to = value.get<std::vector<std::string>>(); }
    template <class T>
    void put(const json&, Image<T>&) {
        wrong = "an image";
    }
    template <class Value>
    void operator()(const ReadingField& field, Value& value) {
        const std::string name = std::string(field.name) + (std::is_same_v<Value, Quat> ? "_quat_xyzw" : "");
        const auto found = values.find(name);
        if (found == values.end()) return;
        ++read;
        try {
            put(*found, value);
        } catch (const json::exception&) {
            wrong = "\"" + name + "\"";
        }
    }
};

}  // namespace

Result<Sample> sample_of(const SensorSpec& spec, const nlohmann::json& values) {
    Sample sample;
    std::string wrong;
    if (!make_sample(spec.kind().number, sample)) wrong = "a sensor that measures nothing";
    if (!values.is_object()) wrong = "no object";
    if (wrong.empty()) {
        FieldReader reader{values, wrong};
        visit_fields(sample, reader);
        if (reader.read == 0 && wrong.empty())
            wrong = "no value that " + std::string(spec.kind().phrase) + " has";
        if (wrong.empty() && !has_its_beams(spec, sample))
            wrong = "\"ranges\" or \"intensities\", not one for each beam,";
    }
    if (wrong.empty()) return sample;
    return Error{"sensor \"" + spec.name + "\": " + wrong + " cannot be read",
                 "write the values that docs/sensors.md names for " + std::string(spec.kind().phrase),
                 "bad-reading"};
}

}  // namespace roboss
