// Where the Controller of a run listens, and how members reach it. The defaults reach processes of this
// computer and user only.
#pragma once

#include <cstdint>
#include <string>

namespace roboss {

/// Name of a run that was given none.
inline constexpr const char* kDefaultSimulation = "default";

/// The Controller's TCP port on an interface that others can reach. On loopback any free port does.
inline constexpr std::uint16_t kDefaultPort = 7117;

struct NetOptions {
    /// Name of the run. Members of this computer find the Controller by it; a Controller refuses members of
    /// another name.
    std::string simulation = kDefaultSimulation;
    /// Of the Controller: the interface at which it listens, by name or IPv4 address; 0.0.0.0 is all of them.
    std::string interface = "127.0.0.1";
    /// Of the Controller: the TCP port; 0: any free one on loopback, else kDefaultPort.
    std::uint16_t port = 0;
    /// Of a member: HOST or HOST:PORT of the Controller. Empty: the Controller of this name on this computer.
    std::string controller{};
    /// Folder of this process' certificate and key (net/key_folder.h). Empty: the Controller makes keys for
    /// this run, and members of the same computer and user find them.
    std::string keys{};
    /// Neither encryption nor certificates: everybody who reaches the port can take part, read and change.
    bool insecure = false;
    /// Silence after which a connection counts as lost. Every process is heard several times within it.
    std::uint32_t liveliness_ms = 900;
};

}  // namespace roboss
