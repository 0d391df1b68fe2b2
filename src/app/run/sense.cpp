// See sense.h.
#include "app/run/sense.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "app/commands/numbers.h"
#include "app/output/reading_file.h"
#include "app/output/say.h"
#include "app/run/run.h"
#include "app/run/sensed_states.h"
#include "core/similar.h"

namespace roboss {
namespace {

const char* const kSenseFooter =
    R"(Runs the world to the given time and reads one sensor there, with its noise. <update_rate> has no effect.

The ending of the file says how it is written: .png (images: colours; depth in mm; labels; temperatures in 0.01 K), .npy
(NumPy: images, ranges), .pcd (points of a depth camera or laser), .csv (all numbers of other sensors).

Examples:
  roboss sense world.sdf --robot rover --sensor eye --at 2 -o eye.png
  roboss sense world.sdf --robot rover --sensor depth -o cloud.pcd
  roboss sense worlds/city.sdf --robot car_7 --sensor laser --at 5 -o laser.csv

Exit codes: those of `roboss run`; 3 also if the sensor cannot measure or the file cannot be written.)";

/// Names of sensors may contain a slash (cameras of a multicamera): if no robot has the name, what stands
/// behind a slash in it belongs to the sensor's.
SenseOptions parted(SenseOptions o, const Model& model) {
    SenseOptions tried = o;
    while (!model.find_robot(tried.robot)) {
        const std::size_t slash = tried.robot.rfind('/');
        if (slash == std::string::npos) return o;
        tried.sensor = tried.robot.substr(slash + 1) + "/" + tried.sensor;
        tried.robot.resize(slash);
    }
    return tried;
}

Result<std::pair<RobotId, std::size_t>> find_sensor(const SenseOptions& asked, const Model& model) {
    const SenseOptions o = parted(asked, model);
    const std::optional<RobotId> robot = model.find_robot(o.robot);
    if (!robot) {
        std::vector<std::string> names;
        for (const Robot& one : model.robots) names.push_back(one.name);
        return Error{"the world has no robot '" + o.robot + "'",
                     did_you_mean(o.robot, names, "see `roboss check` for their names"), "no-robot"};
    }
    std::vector<std::string> names;
    const std::vector<SensorInfo>& sensors = model.type_of(*robot).sensors;
    for (std::size_t s = 0; s < sensors.size(); ++s) {
        names.push_back(sensors[s].spec.name);
        if (names.back() == o.sensor) return std::pair(*robot, s);
    }
    return Error{"robot '" + o.robot + "' has no sensor '" + o.sensor + "'",
                 did_you_mean(o.sensor, names, "see `roboss check` for its sensors"), "no-sensor"};
}

}  // namespace

Result<> check_sense(const SenseOptions& options, const Model& model) {
    if (!options.wanted()) return Ok{};
    if (const auto found = find_sensor(options, model); !found) return found.error();
    return Ok{};
}

Result<> take_reading(const SenseOptions& options, const SensedRun& run) {
    const auto found = find_sensor(options, *run.model);
    if (!found) return found.error();
    const RobotId robot = found.value().first;
    SensedStates sources(run.model, run.visuals, run.threads);
    sources.update(run.states, run.tick);
    Result<Sample> sample = sources.read(robot, found.value().second, run.seed);
    if (!sample) return sample.error();
    for (const std::string& problem : sources.problems())
        say(stderr, "note: a picture is not shown: {}\n", problem);
    const SensorSpec& spec = run.model->type_of(robot).sensors[found.value().second].spec;
    const Result<> written = write_reading(options.file, std::move(sample).value(), spec);
    if (written) say(stderr, "wrote {}\n", options.file);
    return written;
}

void add_sense_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("sense", "write one reading of a sensor at a given time");
    auto options = std::make_shared<RunOptions>();
    add_run_options(*command, *options);
    const std::string group = "Reading";
    command->add_option("--robot", options->sense.robot, "name of the robot")->required()->group(group);
    command->add_option("--sensor", options->sense.sensor, "name of its sensor")->required()->group(group);
    command->add_option("-o,--output", options->sense.file, "PNG, NPY, PCD or CSV file")
        ->required()
        ->group(group);
    command->add_option("--at", options->until_s, "world time of the reading, s (default: the start)")
        ->check(non_negative_number())
        ->group(group);
    command->footer(kSenseFooter);
    command->callback([options, &exit_code] {
        if (!options->until_s && !options->duration_s) options->until_s = 0.0;
        options->viewer.headless = true;
        options->quiet_but_progress = !options->quiet;
        options->quiet = true;
        exit_code = run(*options);
    });
}

}  // namespace roboss
