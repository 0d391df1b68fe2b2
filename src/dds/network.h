// Names of interfaces and computers to IPv4 addresses.
#pragma once

#include <cstdint>
#include <string>

#include "core/result.h"

namespace roboss {

/// The IPv4 address of an interface of this computer, named "eth0" or "192.0.2.7". An Error lists what there
/// is.
Result<std::string> interface_address(const std::string& name);

struct HostPort {
    std::string address;  // IPv4
    std::uint16_t port = 0;
};
/// "HOST" (port 0) or "HOST:PORT".
Result<HostPort> host_port(const std::string& text);

/// A UDP port of this IPv4 address that nobody uses at the moment.
Result<std::uint16_t> free_udp_port(const std::string& address);

/// Largest receive buffer a socket may ask for (net.core.rmem_max), bytes; 0: not known.
std::uint32_t socket_buffer_max();

}  // namespace roboss
