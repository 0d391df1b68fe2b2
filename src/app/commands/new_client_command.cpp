// Fills the files of src/app/templates in and writes them into a new folder.
#include "app/commands/new_client_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/commands/exit_codes.h"
#include "app/output/say.h"
#include "app/run/run.h"
#include "app/templates.h"
#include "core/installation.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

const char* const kNewClientFooter =
    R"(The folder gets a CMakeLists.txt that builds against an installed RoBOSS (`cmake --install BUILD --prefix PREFIX`), a
control program in C++, a robot as URDF, a world that includes it, and a README with the commands to build and run it.

Example:
  roboss new-client my_driver && cd my_driver
  cmake -B build -DCMAKE_PREFIX_PATH=PREFIX && cmake --build build
  roboss run world.sdf --client build/my_driver.so

Exit codes: 0 done, 1 the folder exists or cannot be written, 2 wrong usage.)";

struct NewClientOptions {
    std::string name, folder = ".";
    bool json = false;
};

/// CMake takes it as the name of a target, C++ as that of a file.
std::string name_fault(const std::string& name) {
    const auto good = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
    if (name.empty() || std::isalpha(static_cast<unsigned char>(name[0])) == 0 ||
        !std::all_of(name.begin(), name.end(), good))
        return fmt::format("'{}' is not a name of letters, digits, _ and - that begins with a letter", name);
    return {};
}

std::string filled(std::string text, const std::map<std::string, std::string>& values) {
    for (const auto& [name, value] : values)
        for (std::size_t at; (at = text.find("@" + name + "@")) != std::string::npos;)
            text.replace(at, name.size() + 2, value);
    return text;
}

/// Four walls of a square room of 8 m.
std::string walls() {
    std::string text;
    const char* const poses[] = {"4 0 0.25 0 0 0", "-4 0 0.25 0 0 0", "0 4 0.25 0 0 1.5708",
                                 "0 -4 0.25 0 0 1.5708"};
    const char* const geometry = "<geometry><box><size>0.1 8 0.5</size></box></geometry>";
    for (int i = 0; i < 4; ++i)
        for (const char* kind : {"collision", "visual"})
            text += fmt::format("        <{0} name=\"{0}_{1}\"><pose>{2}</pose>{3}</{0}>\n", kind, i,
                                poses[i], geometry);
    return text;
}

constexpr const char* kUnknownPrefix = "PREFIX";

/// Of an installed program, where find_package() finds its library; else a word to be replaced.
std::string prefix() {
    std::error_code error;
    const fs::path prefix = installation_prefix();
    return fs::exists(prefix / "include" / "roboss", error) &&
                   !fs::is_symlink(prefix / "include" / "roboss", error)
               ? prefix.string()
               : kUnknownPrefix;
}

Result<> write_project(const NewClientOptions& o) {
    const fs::path folder = fs::path(o.folder) / o.name;
    std::error_code error;
    if (fs::exists(folder, error))
        return Error{folder.string() + " exists", "choose another name, or remove it", "file-exists"};
    if (!fs::create_directories(folder, error))
        return Error{folder.string() + " cannot be created: " + error.message(),
                     "give a writable folder with --folder", "not-writable"};
    const std::map<std::string, std::string> values{
        {"NAME", o.name}, {"VERSION", ROBOSS_SHORT_VERSION}, {"PREFIX", prefix()}, {"WALLS", walls()}};
    const std::pair<std::string, const char*> files[] = {
        {"CMakeLists.txt", templates::kCMakeLists}, {o.name + ".cpp", templates::kProgram},
        {"rover.urdf", templates::kRover},          {"world.sdf", templates::kWorld},
        {"README.md", templates::kReadme},          {".gitignore", "build/\n"}};
    for (const auto& [name, text] : files)
        if (!(std::ofstream(folder / name) << filled(text, values)))
            return Error{(folder / name).string() + " cannot be written", "free some space there",
                         "not-writable"};
    if (o.json) {
        nlohmann::ordered_json written{{"folder", folder.string()},
                                       {"files", nlohmann::ordered_json::array()}};
        for (const auto& [name, text] : files) written["files"].push_back(name);
        say("{}\n", written.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
        return Ok{};
    }
    say("{}\n\nNext:\n  cd {}\n  cmake -B build -DCMAKE_PREFIX_PATH={} && cmake --build build\n"
        "  roboss run world.sdf --client build/{}.so\n",
        "wrote " + folder.string() + ": a control program, a robot and a world", folder.string(), prefix(),
        o.name);
    if (prefix() == kUnknownPrefix)
        say("PREFIX is the folder in which RoBOSS is installed: cmake --install BUILD --prefix PREFIX\n");
    return Ok{};
}

}  // namespace

void add_new_client_command(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("new-client", "write a small project for a control program in C++");
    command->footer(kNewClientFooter);
    auto o = std::make_shared<NewClientOptions>();
    command->add_option("name", o->name, "name of the project and of its folder")
        ->required()
        ->check(name_fault, "NAME");
    command->add_option("--folder", o->folder, "folder in which it is created")->capture_default_str();
    command->add_flag("--json", o->json, "print the written files as JSON");
    command->callback([o, &exit_code] {
        const Result<> written = write_project(*o);
        if (!written) print(written.error());
        exit_code = written ? kSuccess : kBadInput;
    });
}

}  // namespace roboss
