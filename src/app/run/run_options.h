// The options of `roboss run`, as given on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/dataset/dataset_options.h"
#include "app/foxglove/foxglove_options.h"
#include "app/ros2/ros2_options.h"
#include "app/run/sense.h"
#include "app/viewer/snapshot.h"
#include "app/viewer/viewer.h"
#include "net/net_options.h"
#include "physics/step.h"
#include "world/bare_model.h"
#include "world/world.h"

namespace roboss {

struct RunOptions {
    std::string world;
    std::vector<std::string> paths;  // --path: where model:// and package:// URIs are looked up
    std::optional<double> duration_s;
    std::optional<double> dt_s;
    std::string profile;     // of <physics>
    std::string keyframe;    // of an MJCF file, that the world starts from
    bool strict = false;     // a model with errors refuses the world; else it is left out
    BareModelOptions bare;   // what is added to the world
    bool on_ground = false;  // robots are stood on the scenery below them
    bool no_sleep = false;
    std::optional<Precision> precision;
    AccuracySpec accuracy;        // --accuracy and each number by itself
    std::string speed;            // "max", "world" or a factor of real time; empty: world if viewed, else max
    bool paused = false;          // at the start
    bool stay = false;            // at the end of the duration, paused
    bool no_stay = false;         // not even while a page is open
    std::string window = "auto";  // "auto" or a number of ticks
    int threads = 0;              // 0: the cores of this computer, shared by `processes`
    std::size_t lanes = kMostLanes;
    int simulators = 1;
    int processes = 0;           // Simulators as separate processes; 0: in this one
    int local = 0;               // Simulators in the process of a Controller
    bool is_controller = false;  // `roboss controller`: Simulators join over the network
    std::vector<std::string> clients_awaited;
    NetOptions network;
    Ros2Options ros2;
    FoxgloveServerOptions foxglove;
    bool merge_islands = false;
    std::vector<std::string> clients;  // control programs, shared libraries
    std::string orders;                // JSON lines
    std::string trace;                 // CSV
    double trace_every_s = 0;
    std::string contacts;  // CSV
    double contacts_every_s = 0;
    double hash_every_s = 0;
    bool profile_steps = false;
    std::string json;
    std::string log;  // a file, or - for standard error
    double log_every_s = 10;
    std::optional<std::uint64_t> seed;  // none: the seed of the saved run, else 0
    std::string save;
    std::string save_folder;  // requests to save write below it; empty: the current one
    std::string from;         // FILE[#BRANCH][@TIME]
    std::string journal;      // the run is recorded here; resumed if it exists
    double journal_every_s = 1;
    /// What of the run its journal keeps; neither: all.
    struct {
        std::optional<double> seconds;  // recorded, simulated time
        std::optional<std::uint64_t> bytes;
    } journal_keep;
    std::optional<double> until_s;
    std::string replay;         // FILE[#BRANCH][@TIME]: stepped again and checked, instead of a world
    std::string paths_picture;  // SVG of where the robots went
    ViewerOptions viewer;
    SnapshotOptions snapshot;
    SenseOptions sense;
    DatasetOptions dataset;
    bool quiet = false;
    bool quiet_but_progress = false;  // of commands that are quiet by themselves

    /// A process beside the run shows it as nodes.
    bool shows_nodes() const { return ros2.wanted || foxglove.wanted(); }
    bool shows_progress() const { return !quiet || quiet_but_progress; }
};

/// Gives the models of a World the drives of the files of ros2_control. `name`: what the only model is called
/// where the World is added to a run; empty: as in the World.
void add_drives(const RunOptions& options, const std::string& name, World& world);

/// Of `roboss run`: all members on this computer.
void add_run_options(CLI::App& command, RunOptions& options);
/// Of `roboss replay`: a journal instead of a world.
void add_replay_options(CLI::App& command, RunOptions& options);
/// Of `roboss controller`: the same, and the network on which members join.
void add_controller_options(CLI::App& command, RunOptions& options);

}  // namespace roboss
