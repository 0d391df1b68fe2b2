// Looks at the program, the computer and the installation.
#include "app/commands/doctor_command.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/utsname.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/commands/exit_codes.h"
#include "app/output/say.h"
#include "app/processes/private_folder.h"
#include "app/processes/threads.h"
#include "app/worlds/examples.h"
#include "gateway/page_files.h"
#include "net/meeting_place.h"
#include "physics/lanes/lane_stepper.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

const char* const kDoctorFooter =
    R"(Put its output into a report of a defect. It reads this computer's settings, writes one temporary file and no other,
and names no user.

Exit codes: 0 nothing is wrong, 1 something is.)";

/// One line of the report.
struct Item {
    std::string name, value;
    std::string problem = {}, remedy = {};  // empty: nothing is wrong
};

/// The value of `key` in a file of lines "key: value" or KEY="value"; empty if there is none.
std::string value_in(const char* file, std::string_view key, char separator) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        const std::size_t at = line.find(separator);
        if (at == std::string::npos || line.substr(0, at).find_last_not_of(" \t") + 1 != key.size() ||
            !line.starts_with(key))
            continue;
        std::string value = line.substr(at + 1);
        value.erase(0, value.find_first_not_of(" \t\""));
        value.erase(value.find_last_not_of(" \t\"") + 1);
        return value;
    }
    return "";
}

Item build() {
#ifdef NDEBUG
    const char* const kind = "release";
#else
    const char* const kind = "debug";
#endif
#ifdef __clang__
    return {"build", fmt::format("{}, clang {}", kind, __clang_version__)};
#else
    return {"build", fmt::format("{}, g++ {}", kind, __VERSION__)};
#endif
}

Item system() {
    const std::string name = value_in("/etc/os-release", "PRETTY_NAME", '=');
    utsname kernel{};
    if (uname(&kernel) != 0) return {"system", name};
    return {"system", fmt::format("{}, {} {}, {}", name.empty() ? "unknown distribution" : name,
                                  kernel.sysname, kernel.release, kernel.machine)};
}

/// A processor of ARM has no name: the board's, the maker's number and its own stand for it.
std::string arm_processor() {
    std::string board;
    std::getline(std::ifstream("/sys/firmware/devicetree/base/model"), board, '\0');
    const std::string part = value_in("/proc/cpuinfo", "CPU part", ':');
    if (part.empty()) return board;
    const std::string numbers =
        fmt::format("ARM implementer {}, part {}", value_in("/proc/cpuinfo", "CPU implementer", ':'), part);
    return board.empty() ? numbers : board + ", " + numbers;
}

Item processor() {
    std::string name = value_in("/proc/cpuinfo", "model name", ':');
    if (name.empty()) name = arm_processor();
    return {"processor", fmt::format("{}, {} for this process", name.empty() ? "unknown" : name, cores())};
}

Item lanes() {
    const auto stepper = make_lane_stepper(Precision::kDouble, kMostLanes);
    if (stepper) return {"lanes", fmt::format("{} doubles", stepper->width())};
    return {"lanes", "1 (neither AVX2 nor AVX-512): slower, with the same results"};
}

Item load() {
    double busy = 0;
    std::ifstream("/proc/loadavg") >> busy;
    Item item{"load", fmt::format("{:.1f}", busy)};
    if (busy > 2.0 * cores()) {
        item.problem = fmt::format("{:.0f} programs compete for {} processors: runs are slow", busy, cores());
        item.remedy = "end what is not needed (see `top`), or wait";
    }
    return item;
}

Item memory() {
    constexpr double kKiB_of_GiB = 1024.0 * 1024.0, kFew_GiB = 0.5;
    const auto read = [](const char* key) {
        return std::atof(value_in("/proc/meminfo", key, ':').c_str()) / kKiB_of_GiB;
    };
    const double total = read("MemTotal"), available = read("MemAvailable");
    if (total == 0) return {"memory", "unknown (/proc/meminfo cannot be read)"};
    Item item{"memory", fmt::format("{:.1f} GiB, {:.1f} available", total, available)};
    if (available < kFew_GiB) {
        item.problem = "little memory is left";
        item.remedy = "end other programs";
    }
    return item;
}

Item open_files() {
    constexpr rlim_t kFew = 512;
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return {"open files", "unknown"};
    Item item{"open files", fmt::format("{}, at most {}", limit.rlim_cur, limit.rlim_max)};
    if (limit.rlim_max < kFew) {
        item.problem = "a Controller needs one for each member and page";
        item.remedy = "raise the limit: `ulimit -Hn 4096`, or LimitNOFILE= of a systemd unit";
    }
    return item;
}

/// A full disk still takes an empty folder, so some bytes must fit into a file.
bool can_write_files() {
    const auto folder = PrivateFolder::make("doctor");
    if (!folder) return false;
    std::ofstream file(folder.value().path() / "tried");
    file << std::string(1 << 16, 'x');
    file.close();
    return file.good();  // closed, so written
}

/// The most that a socket may hold, which limits bursts that the face of ROS 2 gets over a network.
Item receive_buffer() {
    std::string bytes;
    std::ifstream("/proc/sys/net/core/rmem_max") >> bytes;
    return {"rmem_max", bytes.empty() ? "unknown" : bytes + " bytes"};
}

Item temporary_files() {
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error);
    Item item{"temporary files", error ? "no folder" : folder.string()};
    if (!can_write_files()) {
        item.problem = "no file can be written there";
        item.remedy = "free some space, or name another folder with TMPDIR";
    }
    return item;
}

Item runs() {
    const Result<fs::path> folder = run_folder();
    if (folder) return {"list of runs", folder.value().string()};
    return {"list of runs", "none", folder.error().message, folder.error().remedy};
}

Item page() {
    const fs::path folder = find_page_folder("");
    if (!folder.empty()) return {"viewer's page", folder.string()};
    return {"viewer's page", "none", "runs have no page in the browser",
            "build it with node 18 or later (tools/build.sh release web), or install RoBOSS again"};
}

Item example_worlds() {
    const Result<std::vector<Example>> all = examples();
    if (!all) return {"examples", "none", all.error().message, all.error().remedy};
    std::string missing;
    for (const Example& example : all.value())
        for (const ExampleProgram& program : example.programs)
            if (program.library.empty()) missing += " " + program.name;
    Item item{"examples", fmt::format("{}", all.value().size())};
    if (!missing.empty()) {
        item.problem = "control programs of examples are not built:" + missing;
        item.remedy = "tools/build.sh release" + missing;
    }
    return item;
}

/// Names and versions of the shared libraries in this process, as their files tell them.
Item libraries() {
    std::set<std::string> names;
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
        const std::size_t slash = line.rfind('/');
        if (slash != std::string::npos && line.find(".so", slash) != std::string::npos)
            names.insert(line.substr(slash + 1));
    }
    return {"libraries", fmt::format("{}", fmt::join(names, " "))};
}

std::vector<Item> examine() {
    return {{"version", ROBOSS_VERSION},
            {"commit", ROBOSS_COMMIT},
            build(),
            system(),
            processor(),
            lanes(),
            load(),
            memory(),
            open_files(),
            receive_buffer(),
            temporary_files(),
            runs(),
            page(),
            example_worlds(),
            libraries()};
}

void print_text(const std::vector<Item>& items) {
    constexpr int kNameColumn = 17;
    int problems = 0;
    for (const Item& item : items) {
        say("{:{}}{}\n", item.name, kNameColumn, item.value);
        if (item.problem.empty()) continue;
        ++problems;
        say("{:{}}WRONG: {}\n{:{}}remedy: {}\n", "", kNameColumn, item.problem, "", kNameColumn, item.remedy);
    }
    say("\n{}\n", problems == 0   ? "Nothing is wrong."
                  : problems == 1 ? "One thing is wrong, see above."
                                  : fmt::format("{} things are wrong, see above.", problems));
}

void print_json(const std::vector<Item>& items) {
    nlohmann::ordered_json printed = nlohmann::ordered_json::array();
    for (const Item& item : items) {
        nlohmann::ordered_json& entry = printed.emplace_back();
        entry = {{"name", item.name}, {"value", item.value}};
        if (!item.problem.empty()) entry.update({{"problem", item.problem}, {"remedy", item.remedy}});
    }
    say("{}\n", printed.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

void add_doctor_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand(
        "doctor", "print version, computer and limits for a report, and what is wrong with them");
    command->footer(kDoctorFooter);
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "print a JSON array of {name, value, problem, remedy}");
    command->callback([json, &exit_code] {
        const std::vector<Item> items = examine();
        *json ? print_json(items) : print_text(items);
        const auto is_wrong = [](const Item& item) { return !item.problem.empty(); };
        exit_code = std::ranges::any_of(items, is_wrong) ? kBadInput : kSuccess;
    });
}

}  // namespace roboss
