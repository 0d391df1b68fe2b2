// Fields of a page's message, which anybody may have written: read by name, each checked for its kind.
#pragma once

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/types.h"
#include "math/vec3.h"

namespace roboss {

/// The fields of one object, which outlives this; the first that is wrong is remembered.
class PageFields {
  public:
    explicit PageFields(const nlohmann::json& object) : object_(object) {}

    const nlohmann::json* find(const char* name) const {
        const auto found = object_.find(name);
        return found == object_.end() ? nullptr : &*found;
    }
    std::string text(const char* name) {
        const nlohmann::json* value = find(name);
        if (value != nullptr && value->is_string()) return value->get<std::string>();
        return fail(name, "a string"), std::string();
    }
    double number(const char* name, std::optional<double> otherwise = {}) {
        const nlohmann::json* value = find(name);
        if (value == nullptr && otherwise) return *otherwise;
        if (value != nullptr && value->is_number() && std::isfinite(value->get<double>()))
            return value->get<double>();
        return fail(name, "a finite number"), 0;
    }
    std::uint32_t index(const char* name, std::optional<std::uint32_t> otherwise = {}) {
        const nlohmann::json* value = find(name);
        if (value == nullptr && otherwise) return *otherwise;
        return value == nullptr ? (fail(name, "a number from 0 on"), 0) : index_of(*value, name);
    }
    std::vector<double> numbers(const char* name, std::size_t count) {
        std::vector<double> values;
        const nlohmann::json* list = find(name);
        if (list != nullptr && list->is_array() && list->size() == count)
            for (const nlohmann::json& value : *list)
                if (value.is_number() && std::isfinite(value.get<double>())) values.push_back(value);
        if (values.size() != count) fail(name, "a list of " + std::to_string(count) + " finite numbers");
        values.resize(count);
        return values;
    }
    std::vector<double> numbers(const char* name) {
        const nlohmann::json* list = find(name);
        if (list != nullptr && list->is_array()) return numbers(name, list->size());
        return fail(name, "a list of finite numbers"), std::vector<double>();
    }
    Vec3 vec3(const char* name) {
        const std::vector<double> v = numbers(name, 3);
        return {v[0], v[1], v[2]};
    }
    std::uint32_t index_of(const nlohmann::json& value, const char* name) {
        if (value.is_number_unsigned() && value.get<std::uint64_t>() < RobotId::kNone)
            return value.get<std::uint32_t>();
        return fail(name, "a number from 0 on"), 0;
    }
    void fail(const std::string& name, const std::string& wanted) {
        if (wrong_.empty()) wrong_ = "\"" + name + "\" is not " + wanted;
    }
    const std::string& wrong() const { return wrong_; }

  private:
    const nlohmann::json& object_;
    std::string wrong_;
};

}  // namespace roboss
