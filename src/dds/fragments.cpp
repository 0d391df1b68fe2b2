// A piece: serial of the message, its own number, how many there are (4 bytes each, little-endian), bytes.
#include "dds/fragments.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace roboss {
namespace {

using Head = std::array<std::uint32_t, 3>;

}  // namespace

std::vector<std::vector<std::uint8_t>> cut_in_pieces(std::uint32_t serial,
                                                     std::span<const std::uint8_t> message) {
    const std::size_t count =
        std::max<std::size_t>((message.size() + kPieceBytesMax - 1) / kPieceBytesMax, 1);
    std::vector<std::vector<std::uint8_t>> pieces;
    if (count > kPiecesMax) return pieces;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::size_t first = i * kPieceBytesMax;
        const auto part = message.subspan(first, std::min(kPieceBytesMax, message.size() - first));
        const Head head{serial, i, static_cast<std::uint32_t>(count)};
        std::vector<std::uint8_t>& piece = pieces.emplace_back(sizeof(head) + part.size());
        std::memcpy(piece.data(), head.data(), sizeof(head));
        if (!part.empty()) std::memcpy(piece.data() + sizeof(head), part.data(), part.size());
    }
    return pieces;
}

std::optional<std::vector<std::uint8_t>> Assembly::take(std::span<const std::uint8_t> sample) {
    Head head{};
    if (sample.size() < sizeof(head)) return std::nullopt;
    std::memcpy(head.data(), sample.data(), sizeof(head));
    const auto [serial, number, count] = head;
    if (count == 0 || count > kPiecesMax || number >= count) return std::nullopt;
    if (number == 0) {
        serial_ = serial, next_ = 0, count_ = count;
        bytes_.clear();
    }
    // A piece that does not follow: the beginning was missed, and whoever needs the message asks again.
    if (serial != serial_ || number != next_ || count != count_) return std::nullopt;
    const auto part = sample.subspan(sizeof(head));
    bytes_.insert(bytes_.end(), part.begin(), part.end());
    if (++next_ < count_) return std::nullopt;
    next_ = count_ = 0;
    return std::exchange(bytes_, {});
}

}  // namespace roboss
