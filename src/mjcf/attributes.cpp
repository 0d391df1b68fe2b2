// See attributes.h.
#include "mjcf/attributes.h"

#include <algorithm>
#include <cmath>

#include "core/number_text.h"

namespace roboss::mjcf {

Element Attributes::owner(const char* attribute) const {
    for (const Element& element : chain_)
        if (element.node.attribute(attribute)) return element;
    return {};
}

Element Attributes::owner(std::span<const char* const> attributes) const {
    for (const Element& element : chain_)
        for (const char* attribute : attributes)
            if (element.node.attribute(attribute)) return element;
    return {};
}

void Attributes::bad_value(const char* attribute, const std::string& expected) const {
    const Element element = owner(attribute);
    diagnostics_->error(element.where(), "bad-value",
                        std::string(attribute) + " of <" + element.node.name() + "> is '" +
                            element.node.attribute(attribute).value() + "', which is not " + expected,
                        "Write " + expected + ".");
}

std::string Attributes::text(const char* attribute, const std::string& fallback) const {
    const Element element = owner(attribute);
    return element ? std::string(element.node.attribute(attribute).value()) : fallback;
}

std::vector<double> Attributes::parse(const Element& element, const char* attribute) const {
    std::vector<double> values;
    const std::string text = element.node.attribute(attribute).value();
    for (const std::string_view word : words_of(std::string_view(text))) {
        const auto value = parse_number(word);
        if (!value || !std::isfinite(*value)) {
            bad_value(attribute, "finite numbers with spaces between them");
            return {};
        }
        values.push_back(*value);
    }
    return values;
}

std::vector<double> Attributes::list(const char* attribute) const {
    const Element element = owner(attribute);
    return element ? parse(element, attribute) : std::vector<double>{};
}

bool Attributes::numbers(const char* attribute, std::span<double> values) const {
    if (!has(attribute)) return false;
    const std::vector<double> parsed = list(attribute);
    if (parsed.size() == values.size()) {
        std::ranges::copy(parsed, values.begin());
        return true;
    }
    bad_value(attribute,
              values.size() == 1 ? "a finite number" : std::to_string(values.size()) + " finite numbers");
    return false;
}

std::size_t Attributes::overlay(const char* attribute, std::span<double> values) const {
    std::size_t nearest = 0;
    for (auto element = chain_.rbegin(); element != chain_.rend(); ++element) {
        if (!element->node.attribute(attribute)) continue;
        const std::vector<double> parsed = parse(*element, attribute);
        nearest = std::min(parsed.size(), values.size());
        std::copy_n(parsed.begin(), nearest, values.begin());
    }
    return nearest;
}

double Attributes::number(const char* attribute, double fallback) const {
    double value = fallback;
    numbers(attribute, {&value, 1});
    return value;
}

int Attributes::integer(const char* attribute, int fallback) const {
    const double value = number(attribute, fallback);
    if (std::floor(value) == value && std::fabs(value) <= 2147483648.0)
        return static_cast<int>(std::min(value, 2147483647.0));
    bad_value(attribute, "a whole number");
    return fallback;
}

bool Attributes::boolean(const char* attribute, bool fallback) const {
    const std::string value = text(attribute);
    if (!has(attribute) || value == "auto") return fallback;
    if (value == "true" || value == "enable") return true;
    if (value == "false" || value == "disable") return false;
    bad_value(attribute, "true or false");
    return fallback;
}

Vec3 Attributes::vector(const char* attribute, const Vec3& fallback) const {
    double values[3] = {fallback.x, fallback.y, fallback.z};
    numbers(attribute, values);
    return {values[0], values[1], values[2]};
}

bool Attributes::limited(const char* attribute, const char* range, bool autolimits) const {
    return boolean(attribute, autolimits && has(range));
}

}  // namespace roboss::mjcf
