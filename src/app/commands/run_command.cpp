// Declares the subcommands that run a world.
#include "app/commands/run_command.h"

#include <memory>

#include "app/run/run.h"

namespace roboss {

void add_run_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("run", "simulate a world on this computer");
    auto options = std::make_shared<RunOptions>();
    add_run_options(*command, *options);
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

void add_replay_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("replay", "step a recorded run again and verify its states");
    auto options = std::make_shared<RunOptions>();
    add_replay_options(*command, *options);
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

void add_controller_command(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("controller", "run a world on Simulators that join over the network");
    auto options = std::make_shared<RunOptions>();
    add_controller_options(*command, *options);
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace roboss
