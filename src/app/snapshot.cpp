// Options to words of the page's address, and waiting until it has drawn.
#include "app/snapshot.h"

#include <fmt/format.h>

#include <cctype>
#include <chrono>
#include <fstream>
#include <memory>

#include "app/headless_browser.h"
#include "app/run.h"

namespace roboss {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPatience = std::chrono::seconds(90);
constexpr auto kLook = std::chrono::milliseconds(100);
constexpr auto kSettle = std::chrono::milliseconds(1500);

const char* const kFooter =
    R"(Runs the world to that time and takes the picture, with Chromium without a window.

Examples:
  roboss snapshot world.sdf --at 2.5 -o pile.png
  roboss snapshot worlds/city.sdf --client build/release/lib/roboss_city_driver.so --at 12 --camera follow:car_7 --show rays -o car.png
  roboss snapshot worlds/city.sdf --from run.journal@31.2 --at 31.2 --panel inspector --select car_7 --theme dark -o car.png

Exit codes: as of `roboss run`; 3 also if there is no browser or the page does not come.)";

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
    for (const auto& [key, value] : options.words) {
        result += "&" + key + "=" + encoded(value);
        panels = panels || key == "panel";
    }
    return result + (panels ? "" : "&hide=panels");
}

Result<> write_file(const std::string& file, const std::string& bytes) {
    std::ofstream out(file, std::ios::binary);
    if (out << bytes && out.flush()) return Ok{};
    return Error{file + " cannot be written", "see that the folder is there and has room"};
}

}  // namespace

void add_snapshot_options(CLI::App& command, SnapshotOptions& o) {
    const std::string group = "Picture";
    command.add_option("-o,--output", o.file, "PNG file")->required()->group(group);
    const auto word = [&](const char* key, const char* what) {
        command
            .add_option_function<std::string>(
                std::string("--") + key,
                [&o, key](const std::string& value) { o.words.emplace_back(key, value); }, what)
            ->group(group);
    };
    word("camera",
         "x,y,z,azimuth,elevation,distance (a point to look at, m; degrees; m), top, follow:ROBOT or "
         "chase:ROBOT");
    word("select", "a robot");
    word("colour", "model, simulator, island or speed");
    word("show", "rays,tracks,compass,contacts,bounds,spheres,islands,names,collisions");
    word("theme", "light or dark");
    word("panel", "inspector, cluster or view: with the panels around the picture, this one open");
    command.add_option("--width", o.width, "pixels")
        ->check(CLI::Range(64, 7680))
        ->capture_default_str()
        ->group(group);
    command.add_option("--height", o.height, "pixels")
        ->check(CLI::Range(64, 4320))
        ->capture_default_str()
        ->group(group);
}

Result<> take_snapshot(const SnapshotOptions& options, const std::string& url,
                       const std::function<bool()>& serve) {
    Result<std::unique_ptr<HeadlessBrowser>> browser = HeadlessBrowser::start(options.width, options.height);
    if (!browser) return browser.error();
    if (Result<> opened = browser.value()->open(address(options, url)); !opened) return opened.error();
    const Clock::time_point end = Clock::now() + kPatience;
    for (Clock::time_point look = Clock::now();;) {
        if (!serve()) return Error{"the run has ended before the picture was drawn", "see the lines above"};
        if (Clock::now() > end)
            return Error{"the page has drawn nothing for too long",
                         "open " + url + " in a browser and see what it says"};
        if (Clock::now() < look) continue;
        look = Clock::now() + kLook;
        Result<nlohmann::json> ready =
            browser.value()->evaluate("document.body && document.body.dataset.ready");
        if (!ready) return ready.error();
        if (ready.value() == "true") break;
    }
    // What is looked at closely (rays, contacts, an open inspector) comes a little after the first State.
    const Clock::time_point settled = Clock::now() + (options.words.empty() ? Clock::duration() : kSettle);
    while (Clock::now() < settled)
        if (!serve()) return Error{"the run has ended before the picture was drawn", "see the lines above"};
    Result<std::string> picture = browser.value()->picture();
    if (!picture) return picture.error();
    return write_file(options.file, picture.value());
}

void add_snapshot_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("snapshot", "a picture of a world at some time, as a PNG file");
    auto options = std::make_shared<RunOptions>();
    add_run_options(*command, *options);
    command->add_option("--at", options->until_s, "world time of the picture, s (default: the beginning)")
        ->check(CLI::NonNegativeNumber)
        ->group("Picture");
    add_snapshot_options(*command, options->snapshot);
    command->footer(kFooter);
    command->callback([options, &exit_code] {
        if (!options->until_s && !options->duration_s) options->until_s = 0.0;
        options->viewer.headless = false;
        options->quiet = true;
        exit_code = Run(*options).go();
    });
}

}  // namespace roboss
