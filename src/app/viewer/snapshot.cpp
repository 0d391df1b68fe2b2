// Encodes the options into the page's URL, and waits until the page has drawn.
#include "app/viewer/snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

#include "app/commands/numbers.h"
#include "app/run/run.h"
#include "app/viewer/headless_browser.h"
#include "core/similar.h"
#include "gateway/page_files.h"
#include "wire/viewer_protocol.h"

namespace roboss {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPatience = std::chrono::seconds(180);
/// The thing that the page still waits for before it shows what its address asks for, once it has drawn all
/// that it has.
const char* const kWaits =
    "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => "
    "done(window.roboss ? window.roboss.waits() : 'the page'))))";

const char* const kSnapshotFooter =
    R"(Runs the world to the given time and draws the picture with headless Chromium.

Examples:
  roboss snapshot world.sdf --at 2.5 -o pile.png
  roboss snapshot worlds/city.sdf --client build/release/lib/roboss_city_driver.so --at 12 --camera follow:car_7 --show rays -o car.png
  roboss snapshot worlds/city.sdf --from run.journal@31.2 --at 31.2 --panel inspector --select car_7 --theme dark -o car.png

Exit codes: those of `roboss run`; 1 also if the viewer's page is not installed, 3 if no browser is found or the page
does not load.)";

std::string encoded(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        result += std::isalnum(byte) != 0 || c == '.' || c == '-' || c == '_' ? std::string(1, c)
                                                                              : fmt::format("%{:02X}", byte);
    }
    return result;
}

std::string address(const SnapshotOptions& options, const std::string& url) {
    std::string result = url + (url.find('?') == std::string::npos ? "?" : "&") + "quality=high";
    bool panels = false;
    for (const auto& [key, value] : options.parameters) {
        result += "&" + key + "=" + encoded(value);
        panels = panels || key == "panel";
    }
    return result + (panels ? "" : "&hide=panels");
}

std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    std::stringstream in(text);
    for (std::string word; std::getline(in, word, ',');) words.push_back(word);
    return words;
}

/// "follow:car_7" and the like: where the name of the robot begins; npos: the camera follows none.
std::size_t followed_at(const std::string& camera) {
    for (const std::string mode : {"follow:", "chase:"})
        if (camera.starts_with(mode)) return mode.size();
    return std::string::npos;
}

std::string fault_of_camera(const std::string& camera) {
    for (const char* named : {"top", "front", "side", "isometric", "file"})
        if (camera == named) return {};
    if (followed_at(camera) != std::string::npos || camera.find('/') != std::string::npos) return {};
    std::vector<double> numbers;
    for (const std::string& word : words_of(camera))
        if (const std::optional<double> number = read_number(word)) numbers.push_back(*number);
    if (numbers.size() != 6 || words_of(camera).size() != 6)
        return "'" + camera +
               "' is no camera: give x,y,z,azimuth,elevation,distance, or top, front, side, isometric, file, "
               "follow:ROBOT, chase:ROBOT or ROBOT/SENSOR";
    return numbers[5] > 0 ? std::string() : "the distance of '" + camera + "' is not above 0";
}

/// Every word of a list with commas is one of these.
CLI::Validator list_of(const std::vector<std::string>& known) {
    return CLI::Validator(
        [known](std::string& text) -> std::string {
            for (const std::string& word : words_of(text))
                if (std::ranges::find(known, word) == known.end())
                    return fmt::format("'{}' is not one of {}", word, fmt::join(known, ", "));
            return {};
        },
        "LIST");
}

/// Whether the picture is that of a robot's camera: then `sense` takes it.
bool look_through(SnapshotOptions& snapshot, SenseOptions& sense) {
    for (const auto& [key, value] : snapshot.parameters) {
        const std::size_t slash = value.rfind('/');
        if (key != "camera" || slash == std::string::npos || followed_at(value) != std::string::npos)
            continue;
        sense = {value.substr(0, slash), value.substr(slash + 1), snapshot.file};
        snapshot = {};
        return true;
    }
    return false;
}

/// Empty: the page shows all that was asked for, without a veil of old news over it.
Result<std::string> waits_of(HeadlessBrowser& browser) {
    Result<nlohmann::json> waits = browser.evaluate(kWaits);
    if (!waits) return waits.error();
    return waits.value().is_string() ? waits.value().get<std::string>() : "the page";
}

Result<> write_file(const std::string& file, const std::string& bytes) {
    std::ofstream out(file, std::ios::binary);
    if (out << bytes && out.flush()) return Ok{};
    return Error{file + " cannot be written", "check the folder, its permissions and the free space",
                 "not-writable"};
}

}  // namespace

void add_snapshot_options(CLI::App& command, SnapshotOptions& o) {
    const std::string group = "Picture";
    command.add_option("-o,--output", o.file, "PNG file")->required()->group(group);
    const auto parameter = [&](const char* key, const std::string& what) {
        return command
            .add_option_function<std::string>(
                std::string("--") + key,
                [&o, key](const std::string& value) { o.parameters.emplace_back(key, value); }, what)
            ->group(group);
    };
    parameter(
        "camera",
        "x,y,z,azimuth,elevation,distance (point to look at, m; degrees; m), top, front, side, "
        "isometric, file (the file's camera), follow:ROBOT, chase:ROBOT, or ROBOT/SENSOR (a camera of a "
        "robot, without a browser)")
        ->check(CLI::Validator([](std::string& text) { return fault_of_camera(text); }, "CAMERA"));
    parameter("select", "name of the robot to select");
    parameter("colour", "colour robots by model, simulator, island or speed")
        ->check(list_of({"model", "simulator", "island", "speed"}));
    const std::vector<std::string> overlays(std::begin(viewer_protocol::kPageOverlays),
                                            std::end(viewer_protocol::kPageOverlays));
    parameter("show", fmt::format("layers to draw: {}", fmt::join(overlays, ",")))->check(list_of(overlays));
    parameter("theme", "theme of the page: light or dark")->check(list_of({"light", "dark"}));
    parameter("panel", "show the panels, with this one open: inspector, cameras, cluster or view")
        ->check(list_of({"inspector", "cameras", "cluster", "view"}));
    command.add_option("--width", o.width, "width of the picture, pixels")
        ->check(whole_number(64, 7680))
        ->capture_default_str()
        ->group(group);
    command.add_option("--height", o.height, "height of the picture, pixels")
        ->check(whole_number(64, 4320))
        ->capture_default_str()
        ->group(group);
}

Result<> check_snapshot(const SnapshotOptions& options, const std::string& page_folder, const Model& model) {
    if (options.file.empty()) return Ok{};
    const std::filesystem::path folder = std::filesystem::path(options.file).parent_path();
    std::error_code error;
    if (!folder.empty() && !std::filesystem::is_directory(folder, error))
        return Error{"there is no folder " + folder.string() + " for the picture " + options.file,
                     "create it, or give another file with -o", "not-writable"};
    for (const auto& [key, value] : options.parameters) {
        const std::size_t at = key == "camera" ? followed_at(value) : key == "select" ? 0 : std::string::npos;
        if (at == std::string::npos) continue;
        const std::string robot = value.substr(at);
        if (model.find_robot(robot)) continue;
        std::vector<std::string> names;
        for (const Robot& one : model.robots) names.push_back(one.name);
        return Error{"--" + key + ": the world has no robot '" + robot + "'",
                     did_you_mean(robot, names, "see `roboss check` for their names"), "no-robot"};
    }
    if (PageFiles(find_page_folder(page_folder)).there()) return Ok{};
    return Error{
        "the viewer's page, which draws the picture, is not " +
            (page_folder.empty() ? "installed" : "in the folder " + page_folder),
        "build it with node 18 or later (tools/build.sh release web), install RoBOSS again, or name its "
        "folder with --web FOLDER; --camera ROBOT/SENSOR needs no page",
        "no-page"};
}

Result<> take_snapshot(const SnapshotOptions& options, const std::string& url,
                       const std::function<bool()>& serve) {
    Result<std::unique_ptr<HeadlessBrowser>> browser =
        HeadlessBrowser::start(options.width, options.height, serve);
    if (!browser) return browser.error();
    if (Result<> opened = browser.value()->open(address(options, url)); !opened) return opened.error();
    const Clock::time_point end = Clock::now() + kPatience;
    std::string picture;
    for (;;) {
        Result<std::string> waits = waits_of(*browser.value());
        if (!waits) return waits.error();
        if (waits.value().empty() && !picture.empty()) return write_file(options.file, picture);
        if (Clock::now() > end)
            return Error{fmt::format("the page did not draw in {} s: it waits for {}", kPatience.count(),
                                     waits.value().empty() ? "a quiet moment" : waits.value()),
                         "try again when the machine is less busy, or open " + url +
                             " in a browser and look for errors",
                         "no-picture"};
        picture.clear();
        if (waits.value().empty()) {
            Result<std::string> drawn = browser.value()->picture();
            if (!drawn) return drawn.error();
            picture = std::move(drawn).value();
        } else if (!serve()) {
            return Error{"the run ended before the picture was drawn", "see the messages above",
                         "no-picture"};
        }
    }
}

void add_snapshot_command(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("snapshot", "draw a picture of a world at a given time, as a PNG file");
    auto options = std::make_shared<RunOptions>();
    add_run_options(*command, *options);
    command->add_option("--at", options->until_s, "world time of the picture, s (default: the start)")
        ->check(non_negative_number())
        ->group("Picture");
    add_snapshot_options(*command, options->snapshot);
    command->footer(kSnapshotFooter);
    command->callback([options, &exit_code] {
        if (!options->until_s && !options->duration_s) options->until_s = 0.0;
        options->viewer.headless = look_through(options->snapshot, options->sense);
        options->quiet_but_progress = !options->quiet;
        options->quiet = true;
        exit_code = run(*options);
    });
}

}  // namespace roboss
