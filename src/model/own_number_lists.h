// Tables, faults and sorted lists of the numbers of joints and of those of links. Internal to the model
// layer.
#pragma once

#include <algorithm>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.h"

namespace roboss {

/// A number that nothing can have: what is wrong with it, as the end of a sentence.
struct NumberFault {
    std::string text;
    const char *remedy, *code;
};

inline std::string number_text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", value);
    return buffer;
}

/// The number of the row with this name; nullopt: there is none.
template <class Parameter, class Row>
std::optional<Parameter> find_row(std::span<const Row> rows, std::string_view name) {
    const auto found =
        std::ranges::find(rows, name, [](const Row& row) { return std::string_view(row.name); });
    if (found == rows.end()) return std::nullopt;
    return static_cast<Parameter>(found - rows.begin());
}

/// "damping, friction, ...".
template <class Row>
std::string names_of_rows(std::span<const Row> rows) {
    std::string names;
    for (const Row& row : rows) names += std::string(names.empty() ? "" : ", ") + row.name;
    return names;
}

/// Refuses the list of an order for `called`, whatever the numbers are. `names`: of all parameters.
template <class Order>
Result<> check_list(const Order& order, const std::string& called, std::size_t parameters,
                    const std::string& names) {
    if (order.values.empty() && !order.reset)
        return Error{"order for the parameters of " + called + " names none",
                     "name some of " + names + ", or reset them", "no-parameter"};
    for (auto one = order.values.begin(); one != order.values.end(); ++one) {
        if (static_cast<std::size_t>(one->parameter) >= parameters)
            return Error{"order for a parameter of " + called + " that does not exist",
                         "name some of " + names, "no-parameter"};
        const auto is_same = [&](const auto& other) { return other.parameter == one->parameter; };
        if (std::any_of(one + 1, order.values.end(), is_same))
            return Error{"order for " + called + " names '" + info_of(one->parameter).name + "' twice",
                         "name it once", "repeated-parameter"};
    }
    return Ok{};
}

/// Puts a number among those of one axis or link, which are sorted by their parameters, in place of the one
/// that is there.
template <class Value>
void put_number(const Value& one, std::vector<Value>& numbers) {
    const auto at = std::ranges::lower_bound(numbers, one.parameter, {}, &Value::parameter);
    if (at != numbers.end() && at->parameter == one.parameter)
        at->value = one.value;
    else
        numbers.insert(at, one);
}

/// Begin and end of the numbers of one axis or link in a list that is sorted by `key_of`. (The subrange of
/// std::ranges::equal_range does not compile with clang 14.)
template <class Number, class Key, class KeyOf>
auto numbers_with(const Key& key, KeyOf key_of, std::vector<Number>& sorted) {
    return std::pair(std::ranges::lower_bound(sorted, key, {}, key_of),
                     std::ranges::upper_bound(sorted, key, {}, key_of));
}

}  // namespace roboss
