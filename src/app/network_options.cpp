// Texts of the network options.
#include "app/network_options.h"

#include <fmt/format.h>

namespace roboss {

void add_network_options(CLI::App& command, DdsOptions& o) {
    const std::string group = "Network (each also from the environment)";
    const auto add = [&](CLI::Option* option, const char* variable) {
        option->envname(variable)->group(group)->capture_default_str();
    };
    add(command.add_option("--simulation", o.simulation,
                           "name of the run; runs of different names never mix, however many there are"),
        "ROBOSS_SIMULATION");
    add(command.add_option("--interface", o.interface,
                           "network interface to speak on, by name or IPv4 address; the default reaches "
                           "processes of this computer only"),
        "ROBOSS_INTERFACE");
    add(command.add_option("--domain", o.domain, "DDS domain")->check(CLI::Range(0, 232)), "ROBOSS_DOMAIN");
    add(command
            .add_option("--peer", o.peers,
                        "HOST or HOST:PORT where other members may be, for networks without multicast (may "
                        "be given again)")
            ->delimiter(','),
        "ROBOSS_PEERS");
    add(command.add_option("--port", o.port,
                           "UDP port at which others find this one as HOST:PORT (default: by the domain)"),
        "ROBOSS_PORT");
    add(command
            .add_option("--peer-range", o.peer_range,
                        "how many members may run on one peer named without a port")
            ->check(CLI::Range(1, 120)),
        "ROBOSS_PEER_RANGE");
    add(command.add_option("--discovery-server", o.discovery_server,
                           "HOST:PORT of a Fast DDS discovery server (fastdds discovery -i 0), instead of "
                           "multicast and peers"),
        "ROBOSS_DISCOVERY_SERVER");
    add(command
            .add_option("--liveliness-ms", o.liveliness_ms,
                        "a process silent for so long counts as lost; the same for all members")
            ->check(CLI::Range(20, 60'000)),
        "ROBOSS_LIVELINESS_MS");
    add(command.add_flag("--through-controller", o.through_controller,
                         "the Controller passes on what is for other members: for members that find only it"),
        "ROBOSS_THROUGH_CONTROLLER");
    command.add_flag("!--no-multicast", o.multicast, "find members by --peer only")->group(group);
}

std::string describe(const DdsOptions& options) {
    return fmt::format("simulation '{}' (interface {}, domain {})", options.simulation, options.interface,
                       options.domain);
}

}  // namespace roboss
