// Who may use the gateway: hosts, origins, tokens, and how often one may speak. Pure, so that it can be
// tested without a network.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"
#include "gateway/roles.h"

namespace roboss {

/// "PORT", "ADDRESS:PORT" or "[ADDRESS]:PORT".
struct ListenAddress {
    std::string address = "127.0.0.1";
    std::uint16_t port = 8090;
};
Result<ListenAddress> parse_listen_address(const std::string& text);

/// `host`: "localhost" or an IP address in its usual form (dotted decimal, or IPv6 without brackets and
/// zone).
bool is_loopback(std::string_view host);

/// Everything that decides about a request, read from its headers.
struct Visitor {
    std::string_view host, origin, target, cookie;
    bool wants_socket = false;
    std::size_t hosts = 1, origins = 1;  // how many of these headers the request has
};

class Access {
  public:
    /// The token of each role; empty: no token gives this role.
    using Tokens = std::array<std::string, 3>;

    /// The gateway listens on loopback and needs no token: all get this role.
    explicit Access(PageRole all) : all_(all) {}
    explicit Access(Tokens tokens) : tokens_(std::move(tokens)), by_token_(true) {}

    /// Why the visitor is refused; empty: it may come in.
    std::string refusal(const Visitor& visitor) const;
    /// What the visitor may do, by its token; nothing: it may not come in.
    std::optional<PageRole> role_of(const Visitor& visitor) const;
    /// The token that the visitor named in its address, if it is right: it may keep it.
    std::string_view named_token(const Visitor& visitor) const;
    const std::string& token(PageRole role) const { return tokens_[static_cast<std::size_t>(role)]; }

  private:
    std::optional<PageRole> role_by(std::string_view token) const;

    Tokens tokens_;
    bool by_token_ = false;
    PageRole all_ = PageRole::kAdminister;
};

/// 128 random bits as hex.
std::string random_token();

/// At most so many in a second, counted in a bucket that fills steadily.
class RateLimit {
  public:
    explicit RateLimit(double per_second) : per_second_(per_second), left_(per_second) {}
    /// False: too many.
    bool take(std::int64_t now_ms);

  private:
    double per_second_, left_;
    std::int64_t then_ms_ = 0;
};

}  // namespace roboss
