// The settings by which a participant finds others and is found, as nodes of ROS 2 do
// (rmw_fastrtps, participant.cpp). UDP alone: shared memory would need a folder that both sides
// see. There is no list of allowed interfaces: with one, nodes of Jazzy and Kilted do not see this process
// where the host has a network.
#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>

#include <charconv>
#include <memory>
#include <string>
#include <string_view>

#include "fastdds/participant.h"

namespace roboss::fastdds {
namespace {

using ros2::TransportOptions;

constexpr std::uint32_t kPeersOfHost = 32;  // participants that are tried at a host, as rmw_fastrtps does
constexpr std::uint32_t kSocketBytes = 4 << 20;  // of a socket's buffer, as far as the system allows
const Duration kAnnouncements{1, 0};             // nodes that listen to multicast alone are found by these
constexpr std::uint16_t kServerPort = 11811;     // of discovery servers, unless a port is named

rtps::Locator_t locator_of(const std::string& address, std::uint16_t port = 0) {
    rtps::Locator_t locator(LOCATOR_KIND_UDPv4, port);
    rtps::IPLocator::setIPv4(locator, address);
    return locator;
}

Result<std::string> address_of(const std::string& host) {
    addrinfo wanted{};
    wanted.ai_family = AF_INET;
    wanted.ai_socktype = SOCK_DGRAM;
    addrinfo* found = nullptr;
    const int code = getaddrinfo(host.c_str(), nullptr, &wanted, &found);
    if (code != 0)
        return Error{"the host '" + host + "' has no IPv4 address: " + gai_strerror(code),
                     "write its address as 192.168.1.2, or a name that this computer knows", "no-host"};
    char text[INET_ADDRSTRLEN] = "";
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(found->ai_addr)->sin_addr, text, sizeof text);
    freeaddrinfo(found);
    return std::string(text);
}

// "HOST:PORT", "HOST" or ":PORT".
Result<rtps::Locator_t> server_of(std::string_view text) {
    const std::size_t colon = text.rfind(':');
    std::uint16_t port = kServerPort;
    if (colon != std::string_view::npos) {
        const char* const end = text.data() + text.size();
        const auto [behind, error] = std::from_chars(text.data() + colon + 1, end, port);
        if (error != std::errc() || behind != end || port == 0)
            return Error{"'" + std::string(text) + "' is no discovery server: its port is not 1 to 65535",
                         "write HOST:PORT, several with ; between them", "no-host"};
    }
    const std::string host(text.substr(0, colon));
    const Result<std::string> address = address_of(host.empty() ? "127.0.0.1" : host);
    if (!address) return address.error();
    return locator_of(address.value() == "0.0.0.0" ? "127.0.0.1" : address.value(), port);
}

// The place of a server in the list is its number, also behind empty entries.
Result<> add_servers(const std::string& list, dds::DomainParticipantQos& qos) {
    std::string_view rest = list;
    for (int number = 0; !rest.empty(); ++number) {
        const std::string_view entry = rest.substr(0, rest.find(';'));
        rest.remove_prefix(std::min(rest.size(), entry.size() + 1));
        if (entry.empty()) continue;
        const Result<rtps::Locator_t> server = server_of(entry);
        if (!server) return server.error();
        add_discovery_server(qos, number, server.value());
    }
    return Ok{};
}

Result<> add_peers(const TransportOptions& options, dds::DomainParticipantQos& qos) {
    auto& peers = qos.wire_protocol().builtin.initialPeersList;
    for (const std::string& host : options.peers) {
        const Result<std::string> address = address_of(host);
        if (!address) return address.error();
        peers.push_back(locator_of(address.value()));
    }
    // Nodes whose range is this host listen to no multicast: their ports are tried one by one.
    peers.push_back(locator_of("127.0.0.1"));
    return Ok{};
}

// Without multicast. Others elsewhere reach this process by all its addresses, those of this host by
// 127.0.0.1.
void listen_without_multicast(bool is_reached_from_elsewhere, dds::DomainParticipantQos& qos) {
    const rtps::Locator_t place = is_reached_from_elsewhere ? rtps::Locator_t() : locator_of("127.0.0.1");
    qos.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(place);
    qos.wire_protocol().default_unicast_locator_list.push_back(place);
}

void use_udp(dds::DomainParticipantQos& qos) {
    const auto udp = std::make_shared<UdpTransport>();
    udp->maxInitialPeersRange = kPeersOfHost;
    udp->sendBufferSize = udp->receiveBufferSize = kSocketBytes;
    udp->non_blocking_send = true;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
}

}  // namespace

Result<dds::DomainParticipantQos> participant_qos(const TransportOptions& options) {
    dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
    qos.name("/");
    const std::string_view enclave = "enclave=/;";
    qos.user_data().data_vec({enclave.begin(), enclave.end()});
    qos.wire_protocol().builtin.discovery_config.leaseDuration_announcementperiod = kAnnouncements;
    use_udp(qos);
    if (!options.discovery_server.empty()) {
        const Result<> added = add_servers(options.discovery_server, qos);
        if (!added) return added.error();
        return qos;
    }
    if (options.reach == TransportOptions::Reach::kOff) {
        qos.allocation().participants = {1, 1, 0};
        listen_without_multicast(false, qos);
        qos.wire_protocol().builtin.initialPeersList.push_back(locator_of("127.0.0.1"));
        return qos;
    }
    const Result<> added = add_peers(options, qos);
    if (!added) return added.error();
    if (options.reach == TransportOptions::Reach::kSubnet)
        qos.wire_protocol().builtin.initialPeersList.push_back(locator_of("239.255.0.1"));
    else
        listen_without_multicast(!options.peers.empty(), qos);
    return qos;
}

}  // namespace roboss::fastdds
