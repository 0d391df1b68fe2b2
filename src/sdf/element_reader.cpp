// Reads what elements of a world file hold.
#include "sdf/element_reader.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <span>

namespace roboss::sdf_import {
/// Gazebo takes the number at the start of a word and leaves the rest: a quotation mark, a unit, a second
/// point ("2.286.0"). A comma is no rest: it may stand for a point.
std::optional<double> number_at_start(std::string_view text) {
    while (!text.empty() && !std::isdigit(static_cast<unsigned char>(text.back())) && text.back() != '.')
        text.remove_suffix(1);
    const std::size_t point = text.find('.');
    const std::size_t second = point == text.npos ? point : text.find('.', point + 1);
    return parse_number(text.substr(0, second));
}

std::string with_decimal_point(std::string_view word) {
    std::string text(word);
    const std::size_t comma = text.find(',');
    if (comma == text.npos || comma == 0 || comma + 1 == text.size()) return {};
    text[comma] = '.';
    return parse_number(text) ? text : std::string();
}

namespace {

/// "0x0f": Gazebo takes whole numbers so.
std::optional<double> hexadecimal(std::string_view text) {
    if (!text.starts_with("0x") && !text.starts_with("0X")) return std::nullopt;
    std::uint32_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data() + 2, end, value, 16);
    if (error != std::errc() || rest != end) return std::nullopt;
    return value;
}

}  // namespace

void ElementReader::report_rest(const Element& element, std::string_view word) const {
    diagnostics_.warning(element.where(), "trailing-text",
                         "<" + std::string(element.node.name()) + "> is '" + std::string(word) +
                             "'; what follows the number is ignored",
                         "Write the number alone.");
}

std::optional<double> ElementReader::parsed(const Element& element, std::string_view word) const {
    if (const auto value = parse_number(word)) return value;
    if (const auto value = hexadecimal(word)) return value;
    if (const std::string point = with_decimal_point(word); !point.empty()) {
        diagnostics_.warning(element.where(), "decimal-comma",
                             "<" + std::string(element.node.name()) + "> has '" + std::string(word) +
                                 "'; it is read as " + point,
                             "Write a decimal point.");
        return parse_number(point);
    }
    const auto value = number_at_start(word);
    if (value) report_rest(element, word);
    return value;
}

void ElementReader::bad_value(const Element& element, const std::string& expected) const {
    const std::string name = element.node.name();
    diagnostics_.error(element.where(), "bad-value",
                       "<" + name + "> is '" + element.node.text().get() + "', which is not " + expected,
                       "Write " + expected + " with decimal points, for instance " +
                           (expected.find("3 ") == 0   ? "0 0 1.5."
                            : expected.find("6 ") == 0 ? "0 0 1.5 0 0 0."
                                                       : "1.5."));
}

bool ElementReader::numbers(const Element& element, std::span<double> values, Finite finite) const {
    const auto words = words_of(element.node.text().get());
    const std::string expected =
        values.size() == 1 ? "a finite number" : std::to_string(values.size()) + " finite numbers";
    if (words.empty()) {  // as Gazebo; its conversion of URDF writes such elements
        diagnostics_.warning(element.where(), "empty-value",
                             "<" + std::string(element.node.name()) + "> is empty; its default is used",
                             "Write " + expected + ", or leave it out.");
        return false;
    }
    const bool has_more = values.size() == 1 && words.size() > 1;  // Gazebo takes the first
    if (words.size() != values.size() && !has_more) return bad_value(element, expected), false;
    std::vector<double> parsed;
    for (const auto word : std::span(words).first(values.size())) {
        const auto value = this->parsed(element, word);
        const bool good =
            value && !std::isnan(*value) && (finite == Finite::kInfinityAllowed || std::isfinite(*value));
        if (!good) return bad_value(element, expected), false;
        parsed.push_back(*value);
    }
    if (has_more) report_rest(element, element.node.text().get());
    std::copy(parsed.begin(), parsed.end(), values.begin());
    return true;
}

double ElementReader::number(const Element& parent, const char* child, double fallback, Finite finite) const {
    const Element element = parent.child(child);
    if (!element) return fallback;
    double value = fallback;
    numbers(element, {&value, 1}, finite);
    return value;
}

int ElementReader::integer(const Element& parent, const char* child, int fallback) const {
    const double value = number(parent, child, fallback);
    if (std::floor(value) != value || std::fabs(value) > 2e9) {
        bad_value(parent.child(child), "a whole number");
        return fallback;
    }
    return static_cast<int>(value);
}

bool ElementReader::boolean(const Element& parent, const char* child, bool fallback) const {
    const Element element = parent.child(child);
    if (!element) return fallback;
    const std::string text = element.node.text().get();
    if (text == "1" || text == "true" || text == "True" || text == "TRUE") return true;
    if (text == "0" || text == "false" || text == "False" || text == "FALSE") return false;
    diagnostics_.error(element.where(), "bad-value",
                       "<" + std::string(child) + "> is '" + text + "', which is neither true nor false",
                       "Write true or false.");
    return fallback;
}

Vec3 ElementReader::vector(const Element& parent, const char* child, const Vec3& fallback) const {
    const Element element = parent.child(child);
    if (!element) return fallback;
    double values[3] = {fallback.x, fallback.y, fallback.z};
    numbers(element, values, Finite::kRequired);
    return {values[0], values[1], values[2]};
}

double ElementReader::value(const Element& element, double fallback) const {
    double number[1] = {fallback};
    numbers(element, number, Finite::kRequired);
    return number[0];
}

std::array<double, 6> ElementReader::six(const Element& parent, const char* child) const {
    std::array<double, 6> values{};
    if (const Element element = parent.child(child)) numbers(element, values, Finite::kRequired);
    return values;
}

double ElementReader::angle(const Element& parent, const char* child, double fallback) const {
    const Element element = parent.child(child);
    if (!element) return fallback;
    const double value = number(parent, child, fallback);
    return element.node.attribute("degrees").as_bool() ? value * kPi / 180.0 : value;
}

Pose ElementReader::pose(const Element& pose_element) const {
    if (!pose_element || words_of(pose_element.node.text().get()).empty()) return {};
    if (std::string(pose_element.node.attribute("rotation_format").value()) == "quat_xyzw") {
        double v[7] = {0, 0, 0, 0, 0, 0, 1};
        numbers(pose_element, v, Finite::kRequired);
        const Quat q{v[6], v[3], v[4], v[5]};
        if (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z < 1e-12) {
            bad_value(pose_element, "a position and a quaternion of length 1");
            return {{v[0], v[1], v[2]}, {}};
        }
        return {{v[0], v[1], v[2]}, normalized(q)};
    }
    double v[6] = {};
    numbers(pose_element, v, Finite::kRequired);
    const double unit = pose_element.node.attribute("degrees").as_bool() ? kPi / 180.0 : 1.0;
    return {{v[0], v[1], v[2]}, from_rpy(v[3] * unit, v[4] * unit, v[5] * unit)};
}

std::string relative_to(const Element& pose_element) {
    if (!pose_element) return {};
    const std::string now = pose_element.node.attribute("relative_to").value();
    if (!now.empty() || version_of(*pose_element.source) >= 107) return now;
    return pose_element.node.attribute("frame").value();
}

}  // namespace roboss::sdf_import
