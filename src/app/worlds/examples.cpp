// Reads worlds/examples.json of the installation, or of the repository where the program was built.
#include "app/worlds/examples.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/installation.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "example:";

/// The library of a control program: lib/roboss of an installation, lib of a build. Empty if it is not there.
fs::path library_of(const std::string& program, const fs::path& prefix) {
    std::error_code error;
    for (const fs::path& folder : {prefix / "lib" / "roboss", prefix / "lib"})
        if (const fs::path library = folder / (program + ".so"); fs::is_regular_file(library, error))
            return library;
    return {};
}

Example example_of(const nlohmann::json& entry, const fs::path& folder, const fs::path& prefix) {
    Example example;
    example.name = entry.at("name");
    example.summary = entry.at("summary");
    example.world = folder / entry.at("world").get<std::string>();
    if (entry.contains("orders")) example.orders = folder / entry.at("orders").get<std::string>();
    if (!entry.contains("programs")) return example;
    for (const nlohmann::json& program : entry.at("programs")) {
        const std::string name = program.get<std::string>();
        example.programs.push_back({name, library_of(name, prefix)});
    }
    return example;
}

}  // namespace

bool names_example(std::string_view world) {
    return world.starts_with(kPrefix);
}

Result<std::vector<Example>> examples() {
    const fs::path prefix = installation_prefix();
    const fs::path folder = prefix / "share" / "roboss" / "worlds";
    std::ifstream in(folder / "examples.json");
    const nlohmann::json list = nlohmann::json::parse(in, nullptr, false);
    if (list.is_discarded())
        return Error{fmt::format("there are no examples in {}", folder.string()),
                     "install RoBOSS again, or build it: tools/build.sh release", "no-examples"};
    std::vector<Example> found;
    try {
        for (const nlohmann::json& entry : list) found.push_back(example_of(entry, folder, prefix));
    } catch (const nlohmann::json::exception& error) {
        return Error{fmt::format("{}: {}", (folder / "examples.json").string(), error.what()),
                     "install RoBOSS again", "no-examples"};
    }
    if (found.empty()) return Error{"the list of examples is empty", "install RoBOSS again", "no-examples"};
    return found;
}

Result<Example> find_example(std::string_view world) {
    const std::string_view name = world.substr(kPrefix.size());
    Result<std::vector<Example>> all = examples();
    if (!all) return all.error();
    std::string names;
    for (Example& example : all.value()) {
        if (example.name == name) return std::move(example);
        names += (names.empty() ? "" : ", ") + example.name;
    }
    return Error{fmt::format("there is no example '{}'", name),
                 fmt::format("give one of: {}; `roboss examples` describes them", names), "unknown-example"};
}

Result<std::string> world_file(const std::string& world) {
    if (!names_example(world)) return world;
    const Result<Example> example = find_example(world);
    if (!example) return example.error();
    return example.value().world.string();
}

}  // namespace roboss
