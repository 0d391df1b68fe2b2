// Envelopes as bytes and back. The encoding is little-endian, field by field, in the order of message.h. The
// decoder is total: any bytes give an Envelope or an Error that names the message and the fault;
// it allocates no more than a small multiple of the bytes it was given.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/result.h"
#include "model/order.h"
#include "wire/message.h"

namespace roboss {

/// Version of the encoding; a message of another version is refused by name.
inline constexpr std::uint16_t kWireVersion = 21;

std::vector<std::uint8_t> encode(const Envelope& envelope);
Result<Envelope> decode_envelope(std::span<const std::uint8_t> bytes);

/// Sender and receiver of an encoded Envelope, for who passes it on without reading the rest.
struct EnvelopeEnds {
    Address from, to;
    bool of_clients = false;  // it is of a kind that Clients send
};
Result<EnvelopeEnds> decode_ends(std::span<const std::uint8_t> bytes);

/// A list of orders alone, for files.
std::vector<std::uint8_t> encode_orders(const std::vector<Order>& orders);
Result<std::vector<Order>> decode_orders(std::span<const std::uint8_t> bytes);

/// "Assignment", "WindowResult" ... for logs and errors.
const char* message_name(const Message& message);

}  // namespace roboss
