// Joins a run as a Client that serves Foxglove and Lichtblick.
#include "app/foxglove/foxglove_command.h"

#include "app/foxglove/foxglove_options.h"
#include "app/ros2/face_process.h"

namespace roboss {
namespace {

const char* const kFoxgloveFooter =
    R"(Topics and their types are those that ROS 2 nodes see: /car_3/scan, /tf, /car_3/cmd_vel. docs/foxglove.md has a table of
what works. In Foxglove or Lichtblick: Open connection, Foxglove WebSocket, ws://localhost:8765.

Examples:
  roboss run example:city --foxglove               a run and its server at once
  roboss foxglove                                  beside a run on this computer (`roboss controller ...`)
  roboss foxglove --listen 9000
  ssh -L 8765:localhost:8765 HOST                  to look from another computer: nothing is open to others

Exit codes: 0 the run is over or Ctrl-C, 1 an option is wrong, no Controller was found, or the port is taken, 3 the run
has failed.)";

}  // namespace

void add_foxglove_command(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("foxglove", "show a running simulation to Foxglove and Lichtblick");
    command->footer(kFoxgloveFooter);
    const auto options = std::make_shared<FaceProcessOptions>();
    const auto server = std::make_shared<FoxgloveServerOptions>();
    server->listen = kFoxglovePort;
    command
        ->add_option("--listen", server->listen,
                     "where viewers connect; an address beyond this computer needs --insecure, for there is "
                     "no encryption")
        ->type_name("[ADDRESS:]PORT")
        ->capture_default_str();
    add_foxglove_options(*command, *server, "--");
    add_face_process_options(*command, *options, server->face);
    command->callback([options, server, &exit_code] {
        const auto open = [&]() -> Result<std::unique_ptr<ros2::Transport>> {
            const auto where = foxglove_options(*server, options->member.network.insecure);
            if (!where) return where.error();
            auto transport = foxglove::FoxgloveTransport::listen(where.value());
            if (!transport) return transport.error();
            return std::unique_ptr<ros2::Transport>(std::move(transport).value());
        };
        exit_code = show_run("foxglove", *options, server->face, open);
    });
}

}  // namespace roboss
