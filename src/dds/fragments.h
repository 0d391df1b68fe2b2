// Messages in pieces of at most one UDP datagram. Samples of more than 64 KiB would have to be cut by the
// DDS layer, which loses nearly all of them where the socket buffer is the usual 208 KiB; so long messages
// are cut here, sent reliably and in order, and put together again.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace roboss {

inline constexpr std::size_t kPieceBytesMax = 60'000;
inline constexpr std::uint32_t kPiecesMax = 1u << 14;  // a message has at most 980 MB

/// Samples for one message; `serial` grows by one from message to message of a writer. Empty: it is too long.
std::vector<std::vector<std::uint8_t>> cut_in_pieces(std::uint32_t serial,
                                                     std::span<const std::uint8_t> message);

/// Puts one writer's pieces together. Total: whatever comes, it gives whole messages or nothing, and holds no
/// more than it was given.
class Assembly {
  public:
    /// A message that this sample completes.
    std::optional<std::vector<std::uint8_t>> take(std::span<const std::uint8_t> sample);

  private:
    std::uint32_t serial_ = 0, next_ = 0, count_ = 0;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace roboss
