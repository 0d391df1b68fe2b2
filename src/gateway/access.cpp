// A page of another site can reach a gateway on loopback through the user's browser: by its own scripts (then
// the browser names that site as Origin), or after the site's name was made to resolve to this computer (DNS
// rebinding; then Host is that name). Both headers are checked, by parsed address and exact name.
#include "gateway/access.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <boost/asio/ip/address.hpp>
#include <cctype>
#include <charconv>
#include <optional>
#include <random>

#include "core/check.h"
#include "core/hash.h"
#include "core/hex.h"

namespace roboss {
namespace {

std::optional<std::uint16_t> port_number(std::string_view text) {
    std::uint16_t port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error != std::errc() || end != text.data() + text.size() || port == 0) return std::nullopt;
    return port;
}

/// The host of a Host header ("HOST", "HOST:PORT" or "[IPV6]:PORT"), an IPv6 address without its brackets;
/// empty if the header is anything else.
std::string_view host_of(std::string_view header) {
    const bool bracketed = header.starts_with('[');
    const std::size_t end = bracketed ? header.find(']') : header.find(':');
    const std::string_view host = header.substr(bracketed ? 1 : 0, bracketed ? end - 1 : end);
    if (bracketed && (end == std::string_view::npos || host.find(':') == std::string_view::npos)) return {};
    const std::string_view rest =
        end == std::string_view::npos ? std::string_view() : header.substr(bracketed ? end + 1 : end);
    if (!rest.empty() && (rest[0] != ':' || !port_number(rest.substr(1)))) return {};
    return host;
}

/// Whether the header holds an IPv4 address, "localhost" or, in brackets, an IPv6 address of loopback. Every
/// other name may resolve to this computer at the will of whoever owns it (DNS rebinding).
bool names_loopback(std::string_view header) {
    const std::string_view host = host_of(header);
    const bool ipv6 = host.find(':') != std::string_view::npos;
    return !host.empty() && ipv6 == header.starts_with('[') && is_loopback(host);
}

bool same_name(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// True if `origin` is the page that this server gives at `host`. Behind a proxy that speaks TLS it is https;
/// over TLS it is never http, for anybody on the way could have written such a page.
bool same_origin(std::string_view origin, std::string_view host, bool encrypted) {
    const auto is_page = [&](std::string_view scheme) {
        return !host.empty() && origin.starts_with(scheme) && origin.substr(scheme.size()) == host;
    };
    return is_page("https://") || (!encrypted && is_page("http://"));
}

std::string quoted(std::string_view text) {
    return "'" + std::string(text.substr(0, 80)) + "'";
}

/// The value of NAME=value among parts that `mark` parts.
std::string_view value_of(std::string_view text, std::string_view name, char mark) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(mark), text.size());
        std::string_view part = text.substr(0, end);
        while (part.starts_with(' ')) part.remove_prefix(1);
        if (part.starts_with(name) && part.size() > name.size() && part[name.size()] == '=')
            return part.substr(name.size() + 1);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return {};
}

std::string_view query_of(std::string_view target) {
    const std::size_t mark = target.find('?');
    return mark == std::string_view::npos ? std::string_view() : target.substr(mark + 1);
}

std::string_view token_in_address(const Visitor& visitor) {
    return value_of(query_of(visitor.target), "token", '&');
}

std::string_view token_in_cookie(const Visitor& visitor) {
    return value_of(visitor.cookie, "roboss_token", ';');
}

}  // namespace

bool is_loopback(std::string_view host) {
    if (same_name(host, "localhost")) return true;
    // The parser would take the zone of an IPv6 address, and ends at a zero byte.
    if (host.find_first_not_of("0123456789abcdefABCDEF.:") != std::string_view::npos) return false;
    boost::system::error_code error;
    const auto address = boost::asio::ip::make_address(std::string(host), error);
    return !error && address.is_loopback();
}

Result<ListenAddress> parse_listen_address(const std::string& text) {
    ListenAddress result;
    const std::size_t colon = text.rfind(':');
    const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
    if (colon != std::string::npos) result.address = text.substr(0, colon);
    if (result.address.starts_with('[') && result.address.ends_with(']'))
        result.address = result.address.substr(1, result.address.size() - 2);
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), result.port);
    if (error != std::errc() || end != port.data() + port.size() || result.address.empty())
        return Error{"'" + text + "' is not an address to listen at",
                     "give PORT or ADDRESS:PORT, for example 0.0.0.0:8090", "bad-address"};
    if (result.address == "localhost") result.address = "127.0.0.1";
    return result;
}

/// Digests may be compared at any speed: who can choose one knows the token.
std::optional<PageUser> Access::user_by(std::string_view token) const {
    if (token.empty()) return std::nullopt;
    const auto found = std::ranges::find(users_, token_digest(token), &PageUser::digest);
    return found == users_.end() ? std::nullopt : std::optional(*found);
}

std::string_view Access::named_token(const Visitor& visitor) const {
    const std::string_view token = token_in_address(visitor);
    return user_by(token) ? token : std::string_view();
}

std::optional<PageUser> Access::user_of(const Visitor& visitor) const {
    if (!by_token_) return PageUser{"", all_, ""};
    if (auto named = user_by(token_in_address(visitor))) return named;
    return user_by(token_in_cookie(visitor));
}

bool Access::set_users(std::vector<PageUser> users) {
    if (users == users_) return false;
    for (const PageUser& old : users_) former_[old.digest] = old.name;
    for (const PageUser& user : users) former_.erase(user.digest);
    users_ = std::move(users);
    return true;
}

std::string Access::withdrawal(const PageUser& user) const {
    const auto found = std::ranges::find(users_, user.digest, &PageUser::digest);
    if (!by_token_ || (found != users_.end() && *found == user)) return {};
    if (found == users_.end()) return "the token of " + user.name + " was revoked";
    return "the rights of " + user.name + " were changed";
}

std::string Access::refusal(const Visitor& visitor) const {
    if (visitor.hosts != 1) return std::to_string(visitor.hosts) + " Host headers instead of one";
    if (!by_token_ && !names_loopback(visitor.host))
        return "wrong Host header " + quoted(visitor.host) + " [wrong-host]";
    if (!user_of(visitor)) {
        for (const std::string_view token : {token_in_address(visitor), token_in_cookie(visitor)})
            if (const auto old = former_.find(token_digest(token)); old != former_.end())
                return "the token of " + old->second + " was revoked [revoked-token]";
        return query_of(visitor.target).find("token=") == std::string_view::npos
                   ? "the address lacks a token (?token=...) [no-token]"
                   : "the token is none of this run [wrong-token]";
    }
    if (!visitor.wants_socket) return {};
    if (visitor.origins == 0) return "the Origin header is missing [no-origin]";
    if (visitor.origins > 1 || !same_origin(visitor.origin, visitor.host, visitor.encrypted))
        return "wrong Origin " + quoted(visitor.origin) + " [wrong-origin]";
    return {};
}

std::string random_token() {
    std::random_device device;
    const auto word = [&] { return static_cast<std::uint64_t>(device()) << 32 | device(); };
    const std::uint64_t high = word();
    return to_hex(high) + to_hex(word());
}

std::string token_digest(std::string_view token) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned bytes = 0;
    const int done = EVP_Digest(token.data(), token.size(), digest.data(), &bytes, EVP_sha256(), nullptr);
    ROBOSS_CHECK(done == 1 && bytes == 32, "OpenSSL has SHA-256");
    return hexadecimal(std::span(digest).first(bytes));
}

}  // namespace roboss
