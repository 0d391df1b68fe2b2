// Texts of the network options.
#include "app/processes/network_options.h"

#include "app/commands/numbers.h"

namespace roboss {
namespace {

constexpr const char* kGroup = "Network (each can also be set by its environment variable)";

void add(CLI::Option* option, const char* variable) {
    option->envname(variable)->group(kGroup)->capture_default_str();
}

void add_common(CLI::App& command, NetOptions& o, const char* keys) {
    add(command.add_option("--simulation", o.simulation, "name of the run"), "ROBOSS_SIMULATION");
    add(command.add_option("--keys", o.keys, keys), "ROBOSS_KEYS");
    add(command.add_flag(
            "--insecure", o.insecure,
            "neither encryption nor keys: everybody who reaches the port can read and change the run"),
        "ROBOSS_INSECURE");
    add(command
            .add_option("--liveliness-ms", o.liveliness_ms,
                        "silence after which a connection counts as lost; use the same value for all members")
            ->check(whole_number(100, 60'000)),
        "ROBOSS_LIVELINESS_MS");
}

}  // namespace

void add_listen_options(CLI::App& command, NetOptions& o) {
    add_common(
        command, o,
        "folder with the Controller's key (`roboss keys`); default: keys of this run, which members of "
        "this computer and user find");
    add(command.add_option(
            "--interface", o.interface,
            "network interface at which members join, by name or IPv4 address; 0.0.0.0: all; the "
            "default reaches processes of this computer only"),
        "ROBOSS_INTERFACE");
    add(command.add_option("--port", o.port, "TCP port there (default: any on loopback, else 7117)"),
        "ROBOSS_PORT");
}

void add_join_options(CLI::App& command, NetOptions& o) {
    add_common(command, o, "folder with the key of this process (`roboss keys`)");
    add(command.add_option("--controller", o.controller,
                           "HOST or HOST:PORT of the Controller (default: that of --simulation on this "
                           "computer)"),
        "ROBOSS_CONTROLLER");
}

}  // namespace roboss
