// See robot_names.h.
#include "model/robot_names.h"

#include <algorithm>

#include "core/similar.h"
#include "model/topics.h"

namespace roboss {

bool fits_pattern(std::string_view text, std::string_view pattern) {
    std::size_t t = 0, p = 0, star = pattern.size(),
                resume = 0;  // behind the last `*`: try again one character later
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++, resume = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p, ++t;
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
    if (wanted.find_first_of("*?") == std::string::npos) return found;
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
    std::erase_if(word, [](char c) { return c == '*' || c == '?'; });
    const bool is_pattern = word.size() < wanted.size();
    return {is_pattern ? "no robot of the world has a name that fits '" + wanted + "'"
                       : "the world has no robot '" + wanted + "'",
            did_you_mean(word, names, some), "no-robot"};
}

}  // namespace roboss
