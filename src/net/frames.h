// How messages are cut into frames of a stream: a length (four bytes, little-endian), a kind (one byte), and
// the content. A long message is sent in pieces, so that a short one need not wait for it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "wire/message.h"

namespace roboss {

enum class FrameKind : std::uint8_t {
    kHello = 1,   ///< who calls; the first frame of the caller
    kAccept = 2,  ///< the answer to it
    kRefuse = 3,  ///< the same: a Refusal; the connection ends
    kPing = 4,    ///< nothing, so that the other end hears something
    kWhole = 5,   ///< an Envelope
    kPiece = 6,   ///< some of a long one; more follows
    kLast = 7,    ///< the end of it
    kOwn = 8,     ///< an address of the caller, so that it is reached before it has sent anything
    kOver = 9,    ///< a farewell: the process ends, and with the Controller's the run
};

/// Content of a frame, at most.
inline constexpr std::size_t kFrameMost = 64 * 1024;
/// Bytes of a message, at most: a state or a result of a million robots fits.
inline constexpr std::size_t kMessageMost = std::size_t{1} << 29;
inline constexpr std::size_t kFrameHead = 5;

/// Appends a frame with this content.
void append_frame(std::vector<std::uint8_t>& to, FrameKind kind, std::span<const std::uint8_t> content);

struct Frame {
    FrameKind kind{};
    std::span<const std::uint8_t> content;  // until the next call of next()
};

/// Frames out of the bytes of a stream, however they arrive.
class FrameReader {
  public:
    /// Where the stream's next bytes are to be appended.
    std::vector<std::uint8_t>& buffer() { return bytes_; }
    /// The next whole frame. False: there is none yet, or the stream is broken().
    bool next(Frame& frame);
    /// The fault of the stream; empty: it has none.
    const std::string& broken() const { return broken_; }

  private:
    std::vector<std::uint8_t> bytes_;
    std::size_t at_ = 0;
    std::string broken_;
};

/// A caller's words about itself.
struct Caller {
    std::uint16_t version = 0;  // of the wire
    std::string simulation;
    std::string role;  // "simulator", "client"
    std::string name;  // where it runs, for reports
};
std::vector<std::uint8_t> encode_hello(const Caller& hello);
Result<Caller> decode_hello(std::span<const std::uint8_t> bytes);

std::vector<std::uint8_t> encode_address(const Address& address);
Result<Address> decode_address(std::span<const std::uint8_t> bytes);

/// Why a connection is not accepted, or is cut off.
struct Refusal {
    std::string code, reason;
};
std::vector<std::uint8_t> encode_refusal(const Refusal& refusal);
Refusal decode_refusal(std::span<const std::uint8_t> bytes);

/// A process ends, and with the Controller's the run.
std::vector<std::uint8_t> encode_farewell(const RunOver& farewell);
RunOver decode_farewell(std::span<const std::uint8_t> bytes);

}  // namespace roboss
