// The roboss command: one subcommand per file.
#include <CLI/CLI.hpp>
#include <csignal>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/commands/check_command.h"
#include "app/commands/client_command.h"
#include "app/commands/cluster_command.h"
#include "app/commands/control_command.h"
#include "app/commands/device_command.h"
#include "app/commands/diff_command.h"
#include "app/commands/doctor_command.h"
#include "app/commands/examples_command.h"
#include "app/commands/help_text.h"
#include "app/commands/journal_command.h"
#include "app/commands/keys_command.h"
#include "app/commands/new_client_command.h"
#include "app/commands/python_command.h"
#include "app/commands/run_command.h"
#include "app/commands/runs_command.h"
#include "app/commands/save_command.h"
#include "app/commands/simulator_command.h"
#include "app/commands/usage.h"
#include "app/commands/view_command.h"
#include "app/dataset/dataset_command.h"
#include "app/foxglove/foxglove_command.h"
#include "app/ros2/ros2_command.h"
#include "app/run/sense.h"
#include "app/viewer/snapshot.h"

namespace {

/// By what they are for, in the order in which a newcomer needs them.
void group_commands(CLI::App& app) {
    const std::pair<const char*, std::vector<const char*>> groups[] = {
        {"Simulate a world",
         {"examples", "run", "check", "snapshot", "sense", "dataset", "new-client", "doctor"}},
        {"Drive real robots", {"device"}},
        {"Control and keep a run", {"control", "runs", "save", "replay", "journal", "diff"}},
        {"Look into a run", {"record", "plot", "analyse", "calibrate"}},
        {"Members of a run on several computers",
         {"controller", "simulator", "client", "view", "ros2", "foxglove", "cluster", "keys"}}};
    for (const auto& [group, commands] : groups)
        for (const char* command : commands) app.get_subcommand(command)->group(group);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "RoBOSS simulates many robots in one physical world, with bit-identical results on any number of "
        "machines.\n"
        "To start:  roboss run example:city   or   roboss check WORLD, then   roboss run WORLD"};
    app.require_subcommand(1);
    app.formatter(std::make_shared<roboss::HelpFormatter>());
    app.set_version_flag("--version", "roboss " ROBOSS_VERSION, "print the version");
    app.set_help_all_flag("--help-all", "print every option, of all subcommands");
    std::signal(SIGXFSZ,
                SIG_IGN);  // a file at its size limit gives its writer an error instead of ending the run
    int exit_code = 0;
    roboss::add_examples_command(app, exit_code);
    roboss::add_run_command(app, exit_code);
    roboss::add_check_command(app, exit_code);
    roboss::add_snapshot_command(app, exit_code);
    roboss::add_sense_command(app, exit_code);
    roboss::add_dataset_command(app, exit_code);
    roboss::add_new_client_command(app, exit_code);
    roboss::add_doctor_command(app, exit_code);
    roboss::add_device_command(app, exit_code);
    roboss::add_control_command(app, exit_code);
    roboss::add_runs_command(app, exit_code);
    roboss::add_save_command(app, exit_code);
    roboss::add_replay_command(app, exit_code);
    roboss::add_journal_command(app, exit_code);
    roboss::add_diff_command(app, exit_code);
    roboss::add_controller_command(app, exit_code);
    roboss::add_simulator_command(app, exit_code);
    roboss::add_client_command(app, exit_code);
    roboss::add_view_command(app, exit_code);
    roboss::add_ros2_command(app, exit_code);
    roboss::add_foxglove_command(app, exit_code);
    roboss::add_cluster_command(app, exit_code);
    roboss::add_keys_command(app, exit_code);
    roboss::add_python_commands(app, exit_code);
    group_commands(app);
    if (const std::optional<int> ended = roboss::read_command_line(app, argc, argv)) return *ended;
    return exit_code;
}
