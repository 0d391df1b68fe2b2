// One JSON file per run, named by its process.
#include "app/local/run_list.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

namespace roboss {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// None: the file is being written, or is not ours.
std::optional<ListedRun> read_entry(const fs::path& file) {
    const Json entry = Json::parse(std::ifstream(file), nullptr, false);
    if (!entry.is_object()) return std::nullopt;
    ListedRun run;
    run.name = entry.value("name", "");
    run.command = entry.value("command", "");
    run.world = entry.value("world", "");
    run.viewer = entry.value("viewer", "");
    run.started = entry.value("started", "");
    run.pid = entry.value("pid", pid_t{0});
    run.socket = entry.value("socket", "");
    return run;
}

std::string names_of(const std::vector<ListedRun>& runs) {
    std::string text;
    for (const ListedRun& run : runs)
        text += fmt::format("{}{} ({}, process {})", text.empty() ? "" : ", ", run.name, run.world, run.pid);
    return text;
}

/// NAME, or NAME-2, NAME-3 ...
std::string free_name(const std::string& wanted, const std::vector<ListedRun>& runs) {
    const auto taken = [&](const std::string& name) {
        return std::any_of(runs.begin(), runs.end(), [&](const ListedRun& r) { return r.name == name; });
    };
    std::string name = wanted;
    for (int i = 2; taken(name); ++i) name = fmt::format("{}-{}", wanted, i);
    return name;
}

}  // namespace

Result<std::vector<ListedRun>> listed_runs() {
    const Result<fs::path> folder = run_folder();
    if (!folder) return folder.error();
    std::vector<ListedRun> runs;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.value(), error)) {
        if (entry.path().extension() != ".json") continue;
        std::optional<ListedRun> run = read_entry(entry.path());
        if (!run) continue;
        if (is_alive(run->pid)) {
            runs.push_back(std::move(*run));
            continue;
        }
        fs::remove(entry.path(), error);
        fs::remove(folder.value() / (entry.path().stem().string() + ".sock"), error);
    }
    std::sort(runs.begin(), runs.end(), [](const ListedRun& a, const ListedRun& b) {
        return std::pair(a.started, a.pid) < std::pair(b.started, b.pid);
    });
    return runs;
}

Result<ListedRun> find_run(const std::string& name) {
    const Result<std::vector<ListedRun>> runs = listed_runs();
    if (!runs) return runs.error();
    if (runs.value().empty())
        return Error{
            "there is no run on this computer",
            "start one with `roboss run WORLD`; to reach one on another computer, add --controller HOST",
            "no-run"};
    std::vector<ListedRun> found;
    for (const ListedRun& run : runs.value())
        if (name.empty() || run.name == name || std::to_string(run.pid) == name) found.push_back(run);
    if (found.size() == 1) return found.front();
    if (found.empty())
        return Error{fmt::format("there is no run '{}' on this computer", name),
                     fmt::format("there is: {}; to reach one on another computer, add --controller HOST",
                                 names_of(runs.value())),
                     "no-run"};
    return Error{name.empty() ? "there are several runs on this computer"
                              : fmt::format("there are several runs named '{}'", name),
                 fmt::format("choose one by --simulation NAME, or by its process: {}", names_of(found)),
                 "several-runs"};
}

Result<RunListing> RunListing::add(ListedRun run, bool exact) {
    const Result<fs::path> folder = run_folder();
    if (!folder) return folder.error();
    const Result<std::vector<ListedRun>> others = listed_runs();
    if (!others) return others.error();
    const std::string name = free_name(run.name, others.value());
    if (exact && name != run.name)
        return Error{
            "a run named '" + run.name + "' is running on this computer",
            "end it with `roboss control --simulation " + run.name + " quit`, or choose another name",
            "run-exists"};
    run.name = name;
    const fs::path file = folder.value() / fmt::format("{}.json", run.pid);
    const fs::path unfinished = folder.value() / fmt::format("{}.new", run.pid);
    const Json entry = {{"name", run.name},
                        {"command", run.command},
                        {"world", run.world},
                        {"viewer", run.viewer},
                        {"started", run.started},
                        {"pid", run.pid},
                        {"socket", run.socket.string()}};
    std::error_code error;
    if (std::ofstream out(unfinished); out << entry.dump(2, ' ', false, Json::error_handler_t::replace))
        out.close(), fs::rename(unfinished, file, error);
    else
        error = std::make_error_code(std::errc::io_error);
    if (error)
        return Error{file.string() + " cannot be written: " + error.message(), "free some space there",
                     "not-writable"};
    return RunListing(std::move(run), file);
}

RunListing::RunListing(RunListing&& other) noexcept
    : run_(std::move(other.run_)), file_(std::exchange(other.file_, {})) {}

RunListing::~RunListing() {
    std::error_code ignored;
    if (!file_.empty()) fs::remove(file_, ignored);
}

}  // namespace roboss
