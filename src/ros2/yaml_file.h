// Files in YAML of other programs of ROS 2. Only those that read one include this; no other file knows
// yaml-cpp.
//
// yaml-cpp shares what aliases stand for instead of copying it, and limits the depth of nesting. A file of a
// few bytes may so stand for any number of nodes, or contain itself: readers bound how many they look at.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <utility>

#include "core/result.h"
#include "ros2/file_line.h"

namespace roboss::ros2 {

/// The text of a file of at most 1 MB. `code`, `remedy`: of the Error.
Result<std::string> read_yaml_text(const std::filesystem::path& file, const std::string& code,
                                   const std::string& remedy);

/// What read(root) makes of a text, a Result. An Error names file and line where the text is no YAML.
template <class Read>
auto parse_yaml(const std::string& file, const std::string& text, const std::string& code, Read&& read)
    -> decltype(read(YAML::Node())) {
    try {
        return std::forward<Read>(read)(YAML::Load(text));
    } catch (const YAML::Exception& why) {
        const std::string where = why.mark.is_null() ? file + ": " : at_line(file, why.mark.line + 1);
        return Error{where + "it is no YAML: " + why.msg, "correct the line, or the one before it", code};
    }
}

}  // namespace roboss::ros2
