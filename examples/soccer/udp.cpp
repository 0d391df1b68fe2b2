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

Udp::Udp(const Address& listen, const Address& send_to) : to_(send_to) {
    const sockaddr_in local = socket_address(listen), remote = socket_address(send_to);
    in_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    out_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (in_ < 0 || out_ < 0) fail("cannot open UDP sockets");
    if (bind(in_, reinterpret_cast<const sockaddr*>(&local), sizeof local) != 0)
        fail("cannot listen at " + listen.text());
    if (IN_MULTICAST(ntohl(remote.sin_addr.s_addr))) {
        // By the interface that commands come in at, with a copy for programs of this computer.
        const int one = 1;
        if (setsockopt(out_, IPPROTO_IP, IP_MULTICAST_IF, &local.sin_addr, sizeof local.sin_addr) != 0 ||
            setsockopt(out_, IPPROTO_IP, IP_MULTICAST_LOOP, &one, sizeof one) != 0)
            fail("cannot send by multicast at " + listen.ip);
    }
}

Udp::~Udp() {
    if (in_ >= 0) close(in_);
    if (out_ >= 0) close(out_);
}

std::optional<std::string> Udp::receive() {
    std::array<char, 65536> buffer;
    const ssize_t size = recv(in_, buffer.data(), buffer.size(), 0);
    if (size < 0) return std::nullopt;
    return std::string(buffer.data(), static_cast<std::size_t>(size));
}

void Udp::send(const std::string& bytes) {
    const sockaddr_in remote = socket_address(to_);
    (void)sendto(out_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&remote),
                 sizeof remote);
}

}  // namespace soccer
