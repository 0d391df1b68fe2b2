// Which network a DdsBus uses and how members find each other. The defaults reach processes of this computer
// only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace roboss {

/// Name of a run that was given none.
inline constexpr const char* kDefaultSimulation = "default";

struct DdsOptions {
    /// Members of one run share this name; runs of different names never see each other's messages.
    std::string simulation = kDefaultSimulation;
    std::uint32_t domain = 0;             // DDS domain, 0 .. 232
    std::string interface = "127.0.0.1";  // address or name of the network interface to use
    /// Finding others: multicast on the interface, computers named here, or a discovery server.
    bool multicast = true;
    std::vector<std::string> peers;  // HOST or HOST:PORT
    std::uint16_t port = 0;  // listens here, for peers that name HOST:PORT; 0: a port by the rules of RTPS
    std::uint32_t peer_range = 32;  // a HOST without a port: so many members may run there
    std::string discovery_server;   // HOST:PORT of a running one; then the two above are not used
    /// The Controller passes on all messages for other members, from the first one on. Members that find the
    /// Controller only (one peer) need it: discovery then grows with their number, not with its square.
    bool through_controller = false;
    /// A process silent for so long is reported as vanished (take_vanished()).
    std::uint32_t liveliness_ms = 250;
};

}  // namespace roboss
