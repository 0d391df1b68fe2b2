// Bytes of frames, and of the contents that only this layer knows.
#include "net/frames.h"

#include <cstring>
#include <string_view>

#include "core/archive.h"
#include "core/printable.h"

namespace roboss {
namespace {

constexpr std::size_t kTextMost = 400;  // of a peer's words in logs and errors
constexpr char kSign[] = {'R', 'o', 'B', 'O', 'S', 'S'};

/// A peer's words, not without end.
std::string harmless(const std::string& text) {
    return printable_line(std::string_view(text).substr(0, kTextMost));
}

}  // namespace

void append_frame(std::vector<std::uint8_t>& to, FrameKind kind, std::span<const std::uint8_t> content) {
    const auto length = static_cast<std::uint32_t>(content.size());
    const std::size_t at = to.size();
    to.resize(at + kFrameHead + content.size());
    std::memcpy(to.data() + at, &length, sizeof length);
    to[at + sizeof length] = static_cast<std::uint8_t>(kind);
    if (!content.empty()) std::memcpy(to.data() + at + kFrameHead, content.data(), content.size());
}

bool FrameReader::next(Frame& frame) {
    const auto forget = [&] {
        bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
        at_ = 0;
    };
    const std::size_t left = bytes_.size() - at_;
    if (!broken_.empty()) return false;
    if (left < kFrameHead) return forget(), false;
    std::uint32_t length = 0;
    std::memcpy(&length, bytes_.data() + at_, sizeof length);
    const std::uint8_t kind = bytes_[at_ + sizeof length];
    if (length > kFrameMost || kind < static_cast<std::uint8_t>(FrameKind::kHello) ||
        kind > static_cast<std::uint8_t>(FrameKind::kOver)) {
        broken_ = "it does not speak the protocol of RoBOSS";
        return false;
    }
    if (left < kFrameHead + length) return forget(), false;
    frame = {static_cast<FrameKind>(kind), std::span(bytes_).subspan(at_ + kFrameHead, length)};
    at_ += kFrameHead + length;
    return true;
}

std::vector<std::uint8_t> encode_hello(const Caller& hello) {
    wire::Writer a;
    a.raw(kSign, sizeof kSign);
    a.scalar(hello.version);
    for (const std::string* text : {&hello.simulation, &hello.role, &hello.name}) wire::field(a, *text);
    return a.take();
}

Result<Caller> decode_hello(std::span<const std::uint8_t> bytes) {
    wire::Reader a(bytes);
    char sign[sizeof kSign] = {};
    a.raw(sign, sizeof sign);
    Caller hello;
    a.scalar(hello.version);
    for (std::string* text : {&hello.simulation, &hello.role, &hello.name}) {
        wire::field(a, *text);
        *text = harmless(*text);
    }
    if (a.failed() || a.left() > 0 || std::memcmp(sign, kSign, sizeof sign) != 0)
        return Error{"it does not speak the protocol of RoBOSS", "", "not-roboss"};
    return hello;
}

std::vector<std::uint8_t> encode_address(const Address& address) {
    wire::Writer a;
    a.scalar(address.role);
    a.scalar(address.instance);
    return a.take();
}

Result<Address> decode_address(std::span<const std::uint8_t> bytes) {
    wire::Reader a(bytes);
    Address address;
    a.scalar(address.role);
    a.scalar(address.instance);
    if (!a.failed() && a.left() == 0 && address.role <= Role::kClient) return address;
    return Error{"it names an address that cannot be", "", "not-roboss"};
}

std::vector<std::uint8_t> encode_refusal(const Refusal& refusal) {
    wire::Writer a;
    wire::field(a, refusal.code);
    wire::field(a, refusal.reason);
    return a.take();
}

Refusal decode_refusal(std::span<const std::uint8_t> bytes) {
    wire::Reader a(bytes);
    Refusal refusal;
    wire::field(a, refusal.code);
    wire::field(a, refusal.reason);
    if (a.failed()) return {"refused", "no reason is given"};
    return {harmless(refusal.code), harmless(refusal.reason)};
}

std::vector<std::uint8_t> encode_farewell(const RunOver& farewell) {
    wire::Writer a;
    wire::field(a, farewell.failed);
    wire::field(a, farewell.reason);
    return a.take();
}

RunOver decode_farewell(std::span<const std::uint8_t> bytes) {
    wire::Reader a(bytes);
    RunOver farewell;
    wire::field(a, farewell.failed);
    wire::field(a, farewell.reason);
    if (a.failed()) return {"no reason is given", true};
    farewell.reason = printable(std::string_view(farewell.reason).substr(0, kTextMost));
    return farewell;
}

}  // namespace roboss
