// Two UDP sockets of a bridge: commands come in, vision goes out, possibly by multicast.
#pragma once

#include <optional>
#include <string>

namespace soccer {

/// "127.0.0.1:20011".
struct Address {
    std::string ip;
    int port = 0;
    /// The value of an environment variable, or `fallback`.
    /// @throws std::runtime_error if it is no ADDRESS:PORT.
    static Address from_environment(const char* variable, const Address& fallback);
    std::string text() const { return ip + ":" + std::to_string(port); }
};

class Udp {
  public:
    /// @throws std::runtime_error where the network refuses.
    Udp(const Address& listen, const Address& send_to);
    ~Udp();
    Udp(const Udp&) = delete;
    Udp& operator=(const Udp&) = delete;

    std::optional<std::string> receive();  // the next datagram that has arrived; it does not wait
    void send(const std::string& bytes);   // as UDP does: it may be lost

  private:
    int in_ = -1, out_ = -1;
    Address to_;
};

}  // namespace soccer
