// A page of another site can reach a gateway on loopback through the user's browser: by its own scripts (then
// the browser names that site as Origin), or after the site's name was made to resolve to this computer (DNS
// rebinding; then Host is that name). Both headers are checked, by parsed address and exact name.
#include "gateway/access.h"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <cctype>
#include <charconv>
#include <optional>
#include <random>

#include "core/hash.h"

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

/// Whether `origin` is the page that this server gives at `host`. Behind a proxy that speaks TLS it is https.
bool same_origin(std::string_view origin, std::string_view host) {
    for (const std::string_view scheme : {"http://", "https://"})
        if (!host.empty() && origin.starts_with(scheme) && origin.substr(scheme.size()) == host) return true;
    return false;
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

/// Takes the same time wherever the two differ.
bool same_secret(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    return difference == 0;
}

std::string_view query_of(std::string_view target) {
    const std::size_t mark = target.find('?');
    return mark == std::string_view::npos ? std::string_view() : target.substr(mark + 1);
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
        return Error{"'" + text + "' is not an address for the viewer",
                     "give PORT or ADDRESS:PORT, for example 0.0.0.0:8090", "bad-address"};
    if (result.address == "localhost") result.address = "127.0.0.1";
    return result;
}

std::optional<PageRole> Access::role_by(std::string_view token) const {
    std::optional<PageRole> found;
    for (std::size_t i = 0; i < tokens_.size(); ++i)
        if (!tokens_[i].empty() && same_secret(token, tokens_[i])) found = static_cast<PageRole>(i);
    return found;
}

std::string_view Access::named_token(const Visitor& visitor) const {
    const std::string_view token = value_of(query_of(visitor.target), "token", '&');
    return role_by(token) ? token : std::string_view();
}

std::optional<PageRole> Access::role_of(const Visitor& visitor) const {
    if (!by_token_) return all_;
    if (const auto named = role_by(value_of(query_of(visitor.target), "token", '&'))) return named;
    return role_by(value_of(visitor.cookie, "roboss_token", ';'));
}

std::string Access::refusal(const Visitor& visitor) const {
    if (visitor.hosts != 1) return std::to_string(visitor.hosts) + " Host headers instead of one";
    if (!by_token_ && !names_loopback(visitor.host))
        return "wrong Host header " + quoted(visitor.host) + " [wrong-host]";
    if (!role_of(visitor))
        return query_of(visitor.target).find("token=") == std::string_view::npos
                   ? "the token that was printed at the start is missing [no-token]"
                   : "the token is not that of this run [wrong-token]";
    if (!visitor.wants_socket) return {};
    if (visitor.origins == 0) return "the Origin header is missing [no-origin]";
    if (visitor.origins > 1 || !same_origin(visitor.origin, visitor.host))
        return "wrong Origin " + quoted(visitor.origin) + " [wrong-origin]";
    return {};
}

std::string random_token() {
    std::random_device device;
    const auto word = [&] { return static_cast<std::uint64_t>(device()) << 32 | device(); };
    const std::uint64_t high = word();
    return to_hex(high) + to_hex(word());
}

bool RateLimit::take(std::int64_t now_ms) {
    if (then_ms_ == 0) then_ms_ = now_ms;
    left_ = std::min(per_second_, left_ + 1e-3 * static_cast<double>(now_ms - then_ms_) * per_second_);
    then_ms_ = now_ms;
    if (left_ < 1) return false;
    left_ -= 1;
    return true;
}

}  // namespace roboss
