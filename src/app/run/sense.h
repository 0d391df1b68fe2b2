// A single reading of a run: `roboss sense`, and `roboss snapshot --camera ROBOT/SENSOR`.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <span>
#include <string>

#include "core/result.h"
#include "model/model.h"
#include "model/robot_state.h"
#include "render/visuals_of.h"

namespace roboss {

struct SenseOptions {
    std::string robot, sensor;
    std::string file;                                // see output/reading_file.h
    bool wanted() const { return !sensor.empty(); }  // instead of a picture of the viewer
};

/// Whether the world has the robot and the sensor; before the run starts.
Result<> check_sense(const SenseOptions& options, const Model& model);

/// The states of all robots at a tick, by RobotId, and what they look like.
struct SensedRun {
    std::shared_ptr<const Model> model;
    std::span<const RobotState> states;
    Tick tick = 0;
    std::uint64_t seed = 0;
    unsigned threads = 1;
    const render::VisualsOf& visuals;
};

/// Measures and writes the file.
Result<> take_reading(const SenseOptions& options, const SensedRun& run);

/// Adds `roboss sense`; exit_code as in its --help.
void add_sense_command(CLI::App& app, int& exit_code);

}  // namespace roboss
