// On loopback a page of another site could reach the gateway through the user's browser: by its own scripts
// (then the browser names the Origin) or by a name that is made to point here (then Host is that name). Both
// are looked at.
#include "gateway/access.h"

#include <algorithm>
#include <charconv>
#include <random>

#include "core/hash.h"

namespace roboss {
namespace {

/// "host", "host:port" or "[::1]:port" without the port.
std::string_view without_port(std::string_view host) {
    if (host.starts_with('[')) return host.substr(0, std::min(host.find(']') + 1, host.size()));
    return host.substr(0, host.find(':'));
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

bool is_loopback(std::string_view address) {
    return address == "localhost" || address == "::1" || address == "[::1]" || address.starts_with("127.");
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
        return Error{"'" + text + "' is no address for the viewer",
                     "give PORT or ADDRESS:PORT, as 0.0.0.0:8090"};
    if (result.address == "localhost") result.address = "127.0.0.1";
    return result;
}

bool Access::named_token(const Visitor& visitor) const {
    return !token_.empty() && same_secret(value_of(query_of(visitor.target), "token", '&'), token_);
}

std::string Access::refusal(const Visitor& visitor) const {
    if (token_.empty() && !is_loopback(without_port(visitor.host)))
        return "it names another host, '" + std::string(visitor.host.substr(0, 80)) + "'";
    if (!token_.empty() && !named_token(visitor) &&
        !same_secret(value_of(visitor.cookie, "roboss_token", ';'), token_))
        return "it has not the token that was printed at the start";
    if (!visitor.wants_socket || visitor.origin.empty()) return {};
    const std::size_t mark = visitor.origin.find("://");
    const std::string_view origin_host =
        mark == std::string_view::npos ? std::string_view() : visitor.origin.substr(mark + 3);
    if (origin_host.empty() || origin_host != visitor.host)
        return "a page of '" + std::string(visitor.origin.substr(0, 80)) + "' may not use it";
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
