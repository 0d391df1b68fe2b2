// UDP sockets of a bridge: commands come in and are answered, vision goes out, possibly by multicast.
#pragma once

#include <optional>
#include <string>

namespace soccer {

/// Datagrams that a bridge takes between two ticks of its own, at most: a flood must not stop it.
inline constexpr int kDatagramsAtOnce = 1'000;

/// "127.0.0.1:20011".
struct Address {
    std::string ip;
    int port = 0;
    /// The value of an environment variable, or `fallback`.
    /// @throws std::runtime_error if it is no ADDRESS:PORT.
    static Address from_environment(const char* variable, const Address& fallback);
    std::string text() const { return ip + ":" + std::to_string(port); }
};

/// A socket that datagrams come in at.
class UdpReceiver {
  public:
    /// @throws std::runtime_error where the network refuses.
    explicit UdpReceiver(const Address& listen);
    ~UdpReceiver();
    UdpReceiver(const UdpReceiver&) = delete;
    UdpReceiver& operator=(const UdpReceiver&) = delete;

    std::optional<std::string> receive();  // the next datagram that has arrived; it does not wait
    void reply(const std::string& bytes);  // to the sender of the datagram received last

  private:
    int socket_ = -1;
    Address sender_;
};

/// A socket that datagrams go out from.
class UdpSender {
  public:
    /// `by`: the interface for multicast. @throws std::runtime_error where the network refuses.
    UdpSender(const Address& to, const Address& by);
    ~UdpSender();
    UdpSender(const UdpSender&) = delete;
    UdpSender& operator=(const UdpSender&) = delete;

    void send(const std::string& bytes);  // as UDP does: it may be lost

  private:
    int socket_ = -1;
    Address to_;
};

}  // namespace soccer
