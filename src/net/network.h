// Names of interfaces and computers to IPv4 addresses.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"

namespace roboss {

/// The IPv4 address of an interface of this computer, named "eth0" or "192.0.2.7"; "0.0.0.0" is that of all.
/// An Error lists what there is.
Result<std::string> interface_address(const std::string& name);

/// Names of this computer: "localhost", its host name, and the addresses of its interfaces (those of
/// IPv6 that need no zone).
std::vector<std::string> own_names();

struct HostPort {
    std::string address;  // IPv4
    std::uint16_t port = 0;
};
/// "HOST" (port 0) or "HOST:PORT". An Error: the port is no number, or no computer has this name now.
Result<HostPort> host_port(const std::string& text);

/// Lets this process have as many connections as the system permits.
void raise_connection_limit();

}  // namespace roboss
