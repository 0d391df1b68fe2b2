// See controller_parameters.h.
#include "ros2/controller_parameters.h"

#include <cmath>
#include <utility>

namespace roboss::ros2 {

namespace {

constexpr std::size_t kParametersMost = 1'000;  // an alias makes many of one
constexpr std::size_t kWheelsMost = 100;        // of one list
constexpr std::size_t kTextMost = 200;          // characters
constexpr int kGroupsMost = 4;                  // within each other

bool is_short(const YAML::Node& node) {
    return node.IsScalar() && node.Scalar().size() <= kTextMost;
}

}  // namespace

ControllerParameters::ControllerParameters(std::string file, std::string name, const YAML::Node& values)
    : file_(std::move(file)), name_(std::move(name)), line_(values.Mark().line + 1) {
    for (const char* of_the_manager : {"type", "use_sim_time", "update_rate"})
        asked_for_.insert(of_the_manager);
    if (values.IsMap()) add(values, "", 0);
}

void ControllerParameters::add(const YAML::Node& map, const std::string& prefix, int depth) {
    for (const auto& pair : map) {
        if (++looked_at_ > kParametersMost) {
            if (!error_)
                error_ = Error{at_line(file_, line_) + "'" + name_ + "' has more than " +
                                   std::to_string(kParametersMost) + " parameters",
                               "leave out what it does not need", "bad-controllers"};
            return;
        }
        if (!is_short(pair.first)) continue;
        const std::string key = prefix + pair.first.Scalar();
        if (pair.second.IsMap() && depth < kGroupsMost) {
            add(pair.second, key + ".", depth + 1);
        } else {
            values_.erase(key);  // to assign to a Node would change the document
            values_.emplace(key, pair.second);
        }
    }
}

const YAML::Node* ControllerParameters::find(const std::string& key) {
    asked_for_.insert(key);
    const auto at = values_.find(key);
    return at == values_.end() ? nullptr : &at->second;
}

int ControllerParameters::line(const std::string& key) const {
    const auto at = values_.find(key);
    return at == values_.end() ? line_ : at->second.Mark().line + 1;
}

double ControllerParameters::number(const std::string& key, double usual) {
    const YAML::Node* given = find(key);
    double value = usual;
    if (given == nullptr || (YAML::convert<double>::decode(*given, value) && std::isfinite(value)))
        return value;
    fail(key, "is no finite number", "write a number");
    return usual;
}

double ControllerParameters::at_least_zero(const std::string& key, double usual) {
    const double value = number(key, usual);
    if (value < 0) fail(key, "is below 0", "write a number from 0 on");
    return value;
}

double ControllerParameters::above_zero(const std::string& key, double usual) {
    const double value = number(key, usual);
    if (!(value > 0)) fail(key, "is not above 0", "write a number above 0");
    return value;
}

double ControllerParameters::length(const std::string& key) {
    if (has(key)) return above_zero(key, 1);
    fail(key, "is missing", "add '" + key + ": METRES'");
    return 1;
}

std::optional<double> ControllerParameters::limit(const std::string& key, int sign) {
    const YAML::Node* given = find(key);
    if (given == nullptr) return {};
    double value = 0;
    if (!YAML::convert<double>::decode(*given, value)) {
        fail(key, "is no number", "write a number, or .nan for none");
        return {};
    }
    if (!std::isfinite(value)) return {};
    if (value * sign < 0) fail(key, sign > 0 ? "is below 0" : "is above 0", "change its sign");
    return value;
}

bool ControllerParameters::flag(const std::string& key, bool usual) {
    const YAML::Node* given = find(key);
    bool value = usual;
    if (given == nullptr || YAML::convert<bool>::decode(*given, value)) return value;
    fail(key, "is neither true nor false", "write one of them");
    return usual;
}

std::string ControllerParameters::text(const std::string& key, const std::string& usual) {
    const YAML::Node* given = find(key);
    if (given == nullptr || is_short(*given)) return given == nullptr ? usual : given->Scalar();
    fail(key, "is no text of at most " + std::to_string(kTextMost) + " characters", "write a name");
    return usual;
}

std::vector<std::string> ControllerParameters::names(const std::string& key) {
    const YAML::Node* given = find(key);
    std::vector<std::string> names;
    const bool is_list = given != nullptr && given->IsSequence() && given->size() <= kWheelsMost;
    if (is_list)
        for (const YAML::Node& name : *given)
            if (is_short(name)) names.push_back(name.Scalar());
    if (!is_list || names.empty() || names.size() != given->size())
        fail(key, given == nullptr ? "is missing" : "is no list of at most 100 names",
             "write '" + key + ": [JOINT, ...]'");
    return names;
}

std::string ControllerParameters::joint(const std::string& key) {
    const std::string name = text(key, "");
    if (name.empty()) fail(key, "is missing", "add '" + key + ": JOINT'");
    return name;
}

CovarianceDiagonal ControllerParameters::diagonal(const std::string& key) {
    const YAML::Node* given = find(key);
    CovarianceDiagonal diagonal{};
    if (given == nullptr) return diagonal;
    bool fits = given->IsSequence() && (given->size() == diagonal.size() || given->size() == 0);
    if (fits) {
        std::size_t i = 0;
        for (const YAML::Node& each : *given) {
            double& value = diagonal[i++];
            fits = fits && YAML::convert<double>::decode(each, value) && std::isfinite(value) && value >= 0;
        }
    }
    if (!fits) fail(key, "is no list of six numbers from 0 on", "write '" + key + ": [x, y, z, rx, ry, rz]'");
    return diagonal;
}

void ControllerParameters::fail(const std::string& key, const std::string& what, const std::string& remedy) {
    if (!error_)
        error_ = Error{where(key) + "the " + key + " of '" + name_ + "' " + what, remedy, "bad-controllers"};
}

void ControllerParameters::has_no_effect(const std::string& key, const std::string& why) {
    if (find(key) != nullptr) notice(key, "has no effect: " + why);
}

void ControllerParameters::notice(const std::string& key, const std::string& what) {
    notices_.push_back(where(key) + key.substr(0, kTextMost) + " of '" + name_ + "' " + what +
                       " [controller-parameter]");
}

void ControllerParameters::refuse(const std::string& key, const std::string& why) {
    if (refusal_.empty())
        refusal_ = where(key) + "the controller '" + name_ + "' has no effect: " + why + " [controller-type]";
}

std::vector<std::string> ControllerParameters::take_notices() {
    for (const auto& [key, value] : values_)
        if (!asked_for_.contains(key)) has_no_effect(key, "it is not known here");
    return std::exchange(notices_, {});
}

}  // namespace roboss::ros2
