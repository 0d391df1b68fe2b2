// getifaddrs and getaddrinfo.
#include "net/network.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <memory>
#include <vector>

namespace roboss {
namespace {

std::string text_of(const sockaddr* address) {
    char text[INET6_ADDRSTRLEN] = "";
    const bool v6 = address->sa_family == AF_INET6;
    const void* bytes =
        v6 ? static_cast<const void*>(&reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr)
           : &reinterpret_cast<const sockaddr_in*>(address)->sin_addr;
    inet_ntop(address->sa_family, bytes, text, sizeof(text));
    return text;
}

bool needs_zone(const sockaddr* address) {
    return address->sa_family == AF_INET6 &&
           IN6_IS_ADDR_LINKLOCAL(&reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr);
}

/// An address of an interface that is up.
struct InterfaceAddress {
    std::string name, address;
    bool v6 = false;
};

/// Empty if the interfaces cannot be listed.
std::vector<InterfaceAddress> interface_addresses() {
    ifaddrs* list = nullptr;
    if (getifaddrs(&list) != 0) return {};
    const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, &freeifaddrs);
    std::vector<InterfaceAddress> all;
    for (const ifaddrs* i = list; i != nullptr; i = i->ifa_next) {
        if (i->ifa_addr == nullptr || (i->ifa_flags & IFF_UP) == 0) continue;
        const bool v6 = i->ifa_addr->sa_family == AF_INET6;
        if ((v6 || i->ifa_addr->sa_family == AF_INET) && !needs_zone(i->ifa_addr))
            all.push_back({i->ifa_name, text_of(i->ifa_addr), v6});
    }
    return all;
}

}  // namespace

Result<std::string> interface_address(const std::string& name) {
    if (name == "0.0.0.0") return name;
    std::string known;
    for (const InterfaceAddress& i : interface_addresses()) {
        if (i.v6) continue;
        if (name == i.name || name == i.address) return i.address;
        known += (known.empty() ? "" : ", ") + i.name + " (" + i.address + ")";
    }
    return Error{"this computer has no network interface '" + name + "' with an IPv4 address",
                 "give one of: " + known, "no-interface"};
}

std::vector<std::string> own_names() {
    std::vector<std::string> names{"localhost"};
    char host[HOST_NAME_MAX + 1] = "";
    if (gethostname(host, sizeof(host) - 1) == 0 && host[0] != '\0') names.emplace_back(host);
    for (const InterfaceAddress& i : interface_addresses()) names.push_back(i.address);
    return names;
}

Result<HostPort> host_port(const std::string& text) {
    const auto colon = text.rfind(':');
    HostPort result;
    const std::string host = text.substr(0, colon);
    if (colon != std::string::npos) {
        const std::string digits = text.substr(colon + 1);
        const bool number =
            !digits.empty() && digits.size() <= 5 &&
            std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
        const int port = number ? std::stoi(digits) : 0;
        if (port < 1 || port > 65535)
            return Error{"'" + text + "' has no port from 1 to 65535 behind its colon",
                         "write HOST or HOST:PORT", "bad-port"};
        result.port = static_cast<std::uint16_t>(port);
    }
    addrinfo hints{};
    hints.ai_family = AF_INET;
    addrinfo* found = nullptr;
    if (host.empty() || getaddrinfo(host.c_str(), nullptr, &hints, &found) != 0 || found == nullptr)
        return Error{"there is no computer called '" + host + "'", "give its name or IPv4 address",
                     "no-host"};
    const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(found, &freeaddrinfo);
    result.address = text_of(found->ai_addr);
    return result;
}

void raise_connection_limit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == limit.rlim_max) return;
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace roboss
