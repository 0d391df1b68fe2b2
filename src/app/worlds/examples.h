// The worlds that come with RoBOSS, with their control programs: `roboss examples`, `roboss run
// example:city`.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace roboss {

/// A control program of an example.
struct ExampleProgram {
    std::string name;               // "roboss_city_driver"
    std::filesystem::path library;  // empty if it is not there
};

/// One entry of worlds/examples.json.
struct Example {
    std::string name, summary;
    std::filesystem::path world, orders;  // absolute; `orders` is empty if there are none
    std::vector<ExampleProgram> programs;
};

/// True for "example:NAME".
bool names_example(std::string_view world);

/// All examples, in the order of the file. An Error if the installation has none.
Result<std::vector<Example>> examples();

/// The example that `world` names ("example:city"). An Error if there is none of that name, with all names.
Result<Example> find_example(std::string_view world);

/// The path of the world file that `world` names: `world` itself if it is no example.
Result<std::string> world_file(const std::string& world);

}  // namespace roboss
