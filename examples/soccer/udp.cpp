#include "udp.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace soccer {
namespace {

sockaddr_in socket_address(const Address& address) {
    sockaddr_in result{};
    result.sin_family = AF_INET;
    result.sin_port = htons(static_cast<std::uint16_t>(address.port));
    if (inet_pton(AF_INET, address.ip.c_str(), &result.sin_addr) != 1)
        throw std::runtime_error("'" + address.ip +
                                 "' is no IPv4 address\n  remedy: give, for example, 127.0.0.1:20011");
    return result;
}

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error(what + ": " + std::strerror(errno) +
                             "\n  remedy: end the program that uses the port, or choose another one");
}

int open_socket() {
    const int result = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (result < 0) fail("cannot open a UDP socket");
    return result;
}

void send_datagram(int from, const std::string& bytes, const Address& to) {
    const sockaddr_in remote = socket_address(to);
    (void)sendto(from, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&remote),
                 sizeof remote);
}

}  // namespace

Address Address::from_environment(const char* variable, const Address& fallback) {
    const char* value = std::getenv(variable);
    if (value == nullptr) return fallback;
    const std::string text = value;
    const std::size_t colon = text.rfind(':');
    const int port = colon == std::string::npos ? 0 : std::atoi(text.c_str() + colon + 1);
    if (port < 1 || port > 65535)
        throw std::runtime_error(std::string(variable) + " is \"" + text +
                                 "\"\n  remedy: give ADDRESS:PORT, for example " + fallback.text());
    return {text.substr(0, colon), port};
}

UdpReceiver::UdpReceiver(const Address& listen) {
    const sockaddr_in local = socket_address(listen);  // throws before there is a socket to close
    socket_ = open_socket();
    if (bind(socket_, reinterpret_cast<const sockaddr*>(&local), sizeof local) == 0) return;
    const int reason = errno;
    close(socket_);
    errno = reason;
    fail("cannot listen at " + listen.text());
}

UdpReceiver::~UdpReceiver() {
    close(socket_);
}

std::optional<std::string> UdpReceiver::receive() {
    std::array<char, 65536> buffer;
    sockaddr_in from{};
    socklen_t from_size = sizeof from;
    const ssize_t size =
        recvfrom(socket_, buffer.data(), buffer.size(), 0, reinterpret_cast<sockaddr*>(&from), &from_size);
    if (size < 0) return std::nullopt;
    std::array<char, INET_ADDRSTRLEN> ip{};
    inet_ntop(AF_INET, &from.sin_addr, ip.data(), ip.size());
    sender_ = {ip.data(), ntohs(from.sin_port)};
    return std::string(buffer.data(), static_cast<std::size_t>(size));
}

void UdpReceiver::reply(const std::string& bytes) {
    send_datagram(socket_, bytes, sender_);
}

UdpSender::UdpSender(const Address& to, const Address& by) : to_(to) {
    const sockaddr_in local = socket_address(by), remote = socket_address(to);
    socket_ = open_socket();
    if (!IN_MULTICAST(ntohl(remote.sin_addr.s_addr))) return;
    // By the interface that commands come in at, with a copy for programs of this computer.
    const int one = 1;
    if (setsockopt(socket_, IPPROTO_IP, IP_MULTICAST_IF, &local.sin_addr, sizeof local.sin_addr) == 0 &&
        setsockopt(socket_, IPPROTO_IP, IP_MULTICAST_LOOP, &one, sizeof one) == 0)
        return;
    const int reason = errno;
    close(socket_);
    errno = reason;
    fail("cannot send by multicast at " + by.ip);
}

UdpSender::~UdpSender() {
    close(socket_);
}

void UdpSender::send(const std::string& bytes) {
    send_datagram(socket_, bytes, to_);
}

}  // namespace soccer
