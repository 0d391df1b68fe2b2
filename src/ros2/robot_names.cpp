// See robot_names.h.
#include "ros2/robot_names.h"

#include <algorithm>
#include <cctype>

namespace roboss::ros2 {

std::string ros_name(const std::string& name) {
    std::string result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const bool is_scope = name.compare(i, 2, "::") == 0;
        if (is_scope) ++i;
        const bool begins = result.empty() || result.back() == '/';
        const char c = is_scope ? '/' : std::isalnum(static_cast<unsigned char>(name[i])) ? name[i] : '_';
        if (c == '/' && begins) continue;
        if (begins && std::isdigit(static_cast<unsigned char>(c))) result += '_';
        result += c;
    }
    while (!result.empty() && result.back() == '/') result.pop_back();
    return result.empty() ? "_" : result;
}

std::string ros_path(const std::string& path) {
    std::string result;
    for (std::size_t begin = 0; begin < path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        if (end > begin) result += (result.empty() ? "" : "/") + ros_name(path.substr(begin, end - begin));
        begin = end + 1;
    }
    return result.empty() ? "_" : result;
}

std::string problem_of_name(const std::string& name) {
    constexpr std::size_t kMost = 247;  // characters, as of rmw
    if (name.size() > kMost) return "has more than " + std::to_string(kMost) + " characters";
    for (std::size_t i = 0; i < name.size(); ++i) {
        const auto c = static_cast<unsigned char>(name[i]);
        const bool begins = i > 0 && name[i - 1] == '/';
        if (c == '/' && (begins || i + 1 == name.size())) return "has a part without characters";
        if (c >= 0x80 || (!std::isalnum(c) && c != '_' && c != '/'))
            return "has other characters than letters, digits, _ and /";
        if (begins && std::isdigit(c)) return "has a part that begins with a digit";
    }
    return {};
}

std::string beside(const std::string& path, const std::string& name) {
    return path.substr(0, path.rfind('/') + 1) + name;
}

std::string unique_name(const std::string& name, std::set<std::string>& taken) {
    std::string result = name;
    for (int number = 2; !taken.insert(result).second; ++number) result = name + "_" + std::to_string(number);
    return result;
}

std::vector<std::string> robot_names(const Model& model, const std::string& root) {
    std::set<std::string> taken{"clock", "fleet", "tf", "tf_static"};  // of the world
    std::vector<std::string> names;
    names.reserve(model.robots.size());
    for (const Robot& robot : model.robots)
        names.push_back(!root.empty() && robot.name == root ? "" : unique_name(ros_name(robot.name), taken));
    return names;
}

std::string below(const std::string& robot, const std::string& name) {
    return (robot.empty() ? "/" : "/" + robot + "/") + name;
}

}  // namespace roboss::ros2
