#include "fastdds/calls.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace roboss::fastdds {
namespace {

constexpr std::size_t kEncapsulation = 4;  // bytes of CDR before the fields
constexpr std::size_t kHalf = 8;           // the client, then the number
constexpr std::size_t kHeader = 2 * kHalf;
constexpr std::size_t kMaxOpen = 10'000;  // calls; the oldest are those that the program never answers
constexpr std::size_t kPrefix = 12;       // bytes of a participant in a Guid

// Cyclone DDS, by what discovery says or by the vendor in its Guid; or a client of another vendor that speaks
// its dialect, and puts a half of its Guid there.
bool has_header(const Arrival& arrival) {
    if (arrival.bytes.size() < kEncapsulation + kHeader) return false;
    if (arrival.is_cyclone || (arrival.writer[0] == 1 && arrival.writer[1] == 0x10)) return true;
    const char* const client = arrival.bytes.data() + kEncapsulation;
    return std::memcmp(client, arrival.writer.data(), kHalf) == 0 ||
           std::memcmp(client, arrival.writer.data() + kHalf, kHalf) == 0;
}

// A number of 8 bytes, in the order that the encapsulation says.
std::int64_t number_in(std::string_view cdr, std::size_t at) {
    std::array<char, kHalf> bytes;
    std::copy_n(cdr.data() + at, kHalf, bytes.begin());
    if (cdr[1] == 0) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<std::int64_t>(bytes);
}

std::string bytes_of(std::int64_t number) {
    const auto bytes = std::bit_cast<std::array<char, kHalf>>(number);
    return {bytes.data(), bytes.size()};
}

Guid participant_of(Guid guid) {
    std::fill(guid.begin() + kPrefix, guid.end(), std::uint8_t{0});
    return guid;
}

}  // namespace

std::optional<ros2::Incoming> Calls::open(Arrival arrival) {
    if (arrival.bytes.size() < kEncapsulation || arrival.bytes[0] != 0 || (arrival.bytes[1] & ~1) != 0)
        return std::nullopt;
    ros2::Incoming request;
    if (arrival.reader != Guid{}) {
        request.call = {arrival.reader, arrival.number, static_cast<std::uint8_t>(Dialect::kNamesReader)};
    } else if (has_header(arrival)) {
        request.call = {arrival.writer, number_in(arrival.bytes, kEncapsulation + kHalf),
                        static_cast<std::uint8_t>(Dialect::kHeader)};
        std::string client = arrival.bytes.substr(kEncapsulation, kHalf);
        if (arrival.bytes[1] == 0) std::reverse(client.begin(), client.end());
        arrival.bytes.erase(kEncapsulation, kHeader);
        const std::lock_guard lock(mutex_);
        if (headers_.size() >= kMaxOpen) headers_.pop_front();
        headers_.push_back({request.call, std::move(client)});
    } else {
        request.call = {arrival.writer, arrival.number, static_cast<std::uint8_t>(Dialect::kPlain)};
    }
    request.bytes = std::move(arrival.bytes);
    return request;
}

std::optional<Reply> Calls::close(const ros2::CallId& call, std::string_view cdr) {
    Reply reply{call.client, call.number, std::string(cdr), call.client};
    if (call.dialect == static_cast<std::uint8_t>(Dialect::kNamesReader)) return reply;
    reply.reader = participant_of(call.client);
    if (call.dialect != static_cast<std::uint8_t>(Dialect::kHeader)) return reply;
    const std::lock_guard lock(mutex_);
    const auto at = std::find_if(headers_.begin(), headers_.end(),
                                 [&](const Header& header) { return header.call == call; });
    if (at == headers_.end() || cdr.size() < kEncapsulation) return std::nullopt;
    reply.bytes.insert(kEncapsulation, at->client + bytes_of(call.number));
    headers_.erase(at);
    return reply;
}

bool has_reader(const std::set<Guid>& readers, const Reply& reply) {
    // The readers of a participant stand together in the set.
    const auto at = readers.lower_bound(reply.reader);
    if (at == readers.end()) return false;
    return *at == reply.reader ||
           (participant_of(reply.reader) == reply.reader && participant_of(*at) == reply.reader);
}

}  // namespace roboss::fastdds
