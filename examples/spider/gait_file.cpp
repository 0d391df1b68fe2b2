#include "gait_file.h"

#include <toml++/toml.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
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

/// The numbers of `1.5` or of `[1, 2, 3]`; empty if it is neither.
std::vector<double> numbers_of(const toml::node& node) {
    if (const auto number = node.value<double>()) return {*number};
    std::vector<double> numbers;
    const toml::array* array = node.as_array();
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
        const auto number = (*array)[i].value<double>();
        if (!number) return {};
        numbers.push_back(*number);
    }
    return numbers;
}

[[noreturn]] void refuse(const std::string& file, const toml::source_region& where,
                         const std::string& problem) {
    throw std::runtime_error(file + ":" + std::to_string(where.begin.line) + ": " + problem +
                             "\n  remedy: correct the line, or remove it to keep the default");
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
    try {
        const toml::table table = toml::parse(text, file);
        if (table.empty())
            throw std::runtime_error(file + ": names no parameter of a gait\n  remedy: write lines such as " +
                                     "`stride = 0.1`; there are " + names());
        for (const auto& [key, node] : table) {
            const std::string problem = set(gait, std::string(key.str()), numbers_of(node));
            if (!problem.empty()) refuse(file, node.source(), problem);
        }
    } catch (const toml::parse_error& error) {
        refuse(file, error.source(), std::string(error.description()));
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
