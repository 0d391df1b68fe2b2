// A Model as bytes and back, so that it is compiled once and every Simulator and Client of a run computes
// with the same numbers. The decoder is total: any bytes give a Model whose every index points to something
// and whose hash is the one it claims, or an Error that says what is wrong.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/result.h"
#include "model/model.h"

namespace roboss {

/// The Model as bytes.
std::vector<std::uint8_t> encode_model(const Model& model);
/// The Model of bytes that encode_model() gave, or an Error.
Result<std::shared_ptr<const Model>> decode_model(std::span<const std::uint8_t> bytes);

/// A hash of any bytes, to notice damage.
std::uint64_t hash_of_bytes(std::span<const std::uint8_t> bytes);

}  // namespace roboss
