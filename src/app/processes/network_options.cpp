// Texts of the network options.
#include "app/processes/network_options.h"

#include <fmt/format.h>

#include "app/commands/numbers.h"

namespace roboss {

void add_network_options(CLI::App& command, DdsOptions& o) {
    const std::string group = "Network (each can also be set by its environment variable)";
    const auto add = [&](CLI::Option* option, const char* variable) {
        option->envname(variable)->group(group)->capture_default_str();
    };
    add(command.add_option("--simulation", o.simulation,
                           "name of the run; runs with different names do not see each other"),
        "ROBOSS_SIMULATION");
    add(command.add_option("--interface", o.interface,
                           "network interface, by name or IPv4 address; the default reaches processes of "
                           "this computer only"),
        "ROBOSS_INTERFACE");
    add(command.add_option("--domain", o.domain, "DDS domain")->check(whole_number(0, 232)), "ROBOSS_DOMAIN");
    add(command
            .add_option(
                "--peer", o.peers,
                "HOST or HOST:PORT of other members, for networks without multicast (may be repeated)")
            ->delimiter(','),
        "ROBOSS_PEERS");
    add(command.add_option(
            "--port", o.port,
            "UDP port of this process, for the --peer of others (default: derived from the domain)"),
        "ROBOSS_PORT");
    add(command
            .add_option("--peer-range", o.peer_range,
                        "largest number of members on a --peer given without a port")
            ->check(whole_number(1, 120)),
        "ROBOSS_PEER_RANGE");
    add(command.add_option("--discovery-server", o.discovery_server,
                           "HOST:PORT of a Fast DDS discovery server (fastdds discovery -i 0), instead of "
                           "multicast and peers"),
        "ROBOSS_DISCOVERY_SERVER");
    add(command
            .add_option("--liveliness-ms", o.liveliness_ms,
                        "silence after which a process counts as lost; use the same value for all members")
            ->check(whole_number(20, 60'000)),
        "ROBOSS_LIVELINESS_MS");
    add(command.add_flag("--through-controller", o.through_controller,
                         "send messages to other members through the Controller, for networks on which "
                         "members reach only it"),
        "ROBOSS_THROUGH_CONTROLLER");
    command.add_flag("!--no-multicast", o.multicast, "discover members by --peer only")->group(group);
}

std::string describe(const DdsOptions& options) {
    return fmt::format("simulation '{}' (interface {}, domain {})", options.simulation, options.interface,
                       options.domain);
}

}  // namespace roboss
