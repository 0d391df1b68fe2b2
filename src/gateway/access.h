// The rules for who may use the gateway: hosts, origins, tokens. Pure, so that it can be tested without a
// network.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
    bool encrypted = false;              // it came over TLS
};

class Access {
  public:
    /// The gateway listens on loopback and needs no token: all get this role.
    explicit Access(PageRole all) : all_(all) {}
    /// These users and no others.
    explicit Access(std::vector<PageUser> users) : users_(std::move(users)), by_token_(true) {}

    /// Why the visitor is refused; empty: it may come in.
    std::string refusal(const Visitor& visitor) const;
    /// The user that the visitor's token names; nothing: the visitor may not come in.
    std::optional<PageUser> user_of(const Visitor& visitor) const;
    /// The token that the visitor named in its address, if it is right: it may keep it.
    std::string_view named_token(const Visitor& visitor) const;
    /// From now on these users. Who is left out is refused by name. False: they are those of before.
    bool set_users(std::vector<PageUser> users);
    /// Why a page of this user, who was admitted, is refused now; empty: it is not.
    std::string withdrawal(const PageUser& user) const;

  private:
    std::optional<PageUser> user_by(std::string_view token) const;

    std::vector<PageUser> users_;
    std::map<std::string, std::string> former_;  // names of former users, by the digests of their tokens
    bool by_token_ = false;
    PageRole all_ = PageRole::kAdminister;
};

/// 128 random bits as hex.
std::string random_token();
/// SHA-256 of a token, as hex. Tokens are random, so a slower function would add nothing.
std::string token_digest(std::string_view token);

}  // namespace roboss
