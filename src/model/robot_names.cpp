// See robot_names.h.
#include "model/robot_names.h"

#include <algorithm>

#include "core/similar.h"
#include "model/topics.h"

namespace roboss {
namespace {

constexpr std::string_view kWildcards = "*?[";

/// The place of the bracket that ends the set that begins at `p`; npos: it is no set.
std::size_t end_of_set(std::string_view pattern, std::size_t p) {
    const std::size_t first = p + 1 < pattern.size() && pattern[p + 1] == '!' ? p + 2 : p + 1;
    return pattern.find(']', first + 1);  // a bracket at the beginning is one of the set
}

/// True if the character is one of "abx-z".
bool is_in_set(char c, std::string_view set) {
    for (std::size_t i = 0; i < set.size(); ++i) {
        if (i + 2 >= set.size() || set[i + 1] != '-') {
            if (set[i] == c) return true;
            continue;
        }
        if (set[i] <= c && c <= set[i + 2]) return true;
        i += 2;
    }
    return false;
}

/// The number of characters of the pattern, from p on, that stand for the character c; 0: they do not.
std::size_t fits_one(char c, std::string_view pattern, std::size_t p) {
    if (p >= pattern.size()) return 0;
    if (pattern[p] == '?') return 1;
    const std::size_t end = pattern[p] == '[' ? end_of_set(pattern, p) : std::string_view::npos;
    if (end == std::string_view::npos) return pattern[p] == c ? 1 : 0;
    const bool inverted = pattern[p + 1] == '!';
    const std::size_t first = inverted ? p + 2 : p + 1;
    return is_in_set(c, pattern.substr(first, end - first)) != inverted ? end + 1 - p : 0;
}

}  // namespace

bool fits_pattern(std::string_view text, std::string_view pattern) {
    std::size_t t = 0, p = 0, star = pattern.size(),
                resume = 0;  // behind the last `*`: try again one character later
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++, resume = t;
        } else if (const std::size_t fits = fits_one(text[t], pattern, p); fits > 0) {
            p += fits, ++t;
        } else if (star < pattern.size()) {
            p = star + 1, t = ++resume;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::vector<RobotId> find_robots(const Model& model, const std::string& wanted) {
    if (const auto robot = model.find_robot(wanted)) return {*robot};
    std::vector<RobotId> found;
    if (wanted.find_first_of(kWildcards) == std::string::npos) return found;
    for (std::size_t i = 0; i < model.robots.size(); ++i)
        if (fits_pattern(model.robots[i].name, wanted) && board_of(model.type_of(RobotId(i))) == nullptr)
            found.emplace_back(i);
    return found;
}

Error no_such_robot(const Model& model, const std::string& wanted) {
    constexpr std::size_t kShown = 3;
    std::vector<std::string> names;
    for (const Robot& robot : model.robots) names.push_back(robot.name);
    std::string some = names.empty() ? "it has none" : "it has ";
    for (std::size_t i = 0; i < std::min(kShown, names.size()); ++i)
        some += (i > 0 ? ", '" : "'") + names[i] + "'";
    if (names.size() > kShown) some += " and " + std::to_string(names.size() - kShown) + " more";
    std::string word = wanted;
    std::erase_if(word, [](char c) { return kWildcards.find(c) != std::string_view::npos; });
    const bool is_pattern = word.size() < wanted.size();
    return {is_pattern ? "no robot of the world has a name that fits '" + wanted + "'"
                       : "the world has no robot '" + wanted + "'",
            did_you_mean(word, names, some), "no-robot"};
}

}  // namespace roboss
