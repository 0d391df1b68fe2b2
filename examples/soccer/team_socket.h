// What tests of bridges share: the socket of a team's program, and bytes from their digits.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <string>

namespace soccer {

inline std::string from_hex(const std::string& hex) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    return bytes;
}

/// A socket of a team's program, at any free port.
class TeamSocket {
  public:
    TeamSocket() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
        sockaddr_in address = at(0);
        EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
        socklen_t size = sizeof address;
        getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
        port_ = ntohs(address.sin_port);
    }
    ~TeamSocket() { ::close(socket_); }
    TeamSocket(const TeamSocket&) = delete;
    TeamSocket& operator=(const TeamSocket&) = delete;

    int port() const { return port_; }
    static bool is_free(int port) {
        const int probe = ::socket(AF_INET, SOCK_DGRAM, 0);
        const sockaddr_in address = at(port);
        const bool free = ::bind(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
        ::close(probe);
        return free;
    }
    void send(const std::string& bytes, int port) const {
        const sockaddr_in address = at(port);
        (void)sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address),
                     sizeof address);
    }
    /// The newest datagram; empty: none.
    std::string newest() const {
        std::string bytes, buffer(65536, '\0');
        for (ssize_t size = 0; (size = recv(socket_, buffer.data(), buffer.size(), 0)) > 0;)
            bytes = buffer.substr(0, static_cast<std::size_t>(size));
        return bytes;
    }

  private:
    static sockaddr_in at(int port) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
        return address;
    }
    int socket_, port_ = 0;
};

}  // namespace soccer
