#include "gait_file.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace spider {
namespace {

constexpr GaitField kFields[] = {
    {"period_s", &Gait::period_s, 0.05, 20},
    {"duty", &Gait::duty, 0.1, 0.95},
    {"stride", &Gait::stride, -0.3, 0.3},
    {"lift", &Gait::lift, 0, 0.2},
    {"ease", &Gait::ease, 0, 1},
    {"height", &Gait::height, 0.03, 0.3},
    {"reach", &Gait::reach, 0.06, 0.36},
    {"splay", &Gait::splay, 0, 1.2},
    {"shift", &Gait::shift, -0.1, 0.1},
    {"lead_s", &Gait::lead_s, 0, 0.2},
};

std::string trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return std::string(text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1));
}

/// The numbers of `1.5` or of `[1, 2, 3]`; empty if it is neither.
std::vector<double> numbers_of(std::string text) {
    if (text.size() >= 2 && text.front() == '[' && text.back() == ']') text = text.substr(1, text.size() - 2);
    std::vector<double> numbers;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');) {
        const std::string number = trimmed(part);
        char* end = nullptr;
        numbers.push_back(std::strtod(number.c_str(), &end));
        if (number.empty() || *end != '\0' || !std::isfinite(numbers.back())) return {};
    }
    return numbers;
}

std::string names() {
    std::string all = "phases";
    for (const GaitField& field : kFields) all += std::string(", ") + field.name;
    return all;
}

/// Sets one parameter; the text says what is wrong, or is empty.
std::string set(Gait& gait, const std::string& name, const std::vector<double>& numbers) {
    if (name == "phases") {
        if (numbers.size() != kLegs) return "phases takes six numbers in brackets, one for each leg";
        for (std::size_t leg = 0; leg < kLegs; ++leg) {
            if (!(numbers[leg] >= 0 && numbers[leg] < 1)) return "phases are from 0 to below 1";
            gait.phases[leg] = numbers[leg];
        }
        return {};
    }
    for (const GaitField& field : kFields) {
        if (name != field.name) continue;
        std::ostringstream range;
        range << name << " takes one number from " << field.low << " to " << field.high;
        if (numbers.size() != 1 || !(numbers[0] >= field.low && numbers[0] <= field.high)) return range.str();
        gait.*field.member = numbers[0];
        return {};
    }
    return "there is no parameter \"" + name + "\"; there are " + names();
}

}  // namespace

std::span<const GaitField> gait_fields() {
    return kFields;
}

Gait gait_of_text(const std::string& text, const std::string& file) {
    Gait gait;
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const std::string content = trimmed(std::string_view(line).substr(0, line.find('#')));
        if (content.empty()) continue;
        const auto equals = content.find('=');
        const std::string problem = equals == std::string::npos
                                        ? "\"" + content + "\" is not `name = number`"
                                        : set(gait, trimmed(content.substr(0, equals)),
                                              numbers_of(trimmed(content.substr(equals + 1))));
        if (!problem.empty())
            throw std::runtime_error(file + ":" + std::to_string(number) + ": " + problem +
                                     "\n  remedy: correct the line, or remove it to keep the default");
    }
    return gait;
}

Gait load_gait(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream)
        throw std::runtime_error(file +
                                 ": cannot be read\n  remedy: set ROBOSS_SPIDER_GAIT to a file of gaits, "
                                 "such as examples/spider/gaits/walk.toml");
    return gait_of_text(text, file);
}

}  // namespace spider
