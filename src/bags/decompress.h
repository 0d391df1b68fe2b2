// Unpacks what Zstandard or LZ4 (frames) packed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bags/bag.h"

namespace roboss::bags {

/// The first bytes of what Zstandard packed.
inline constexpr std::string_view kZstdMagic = "\x28\xB5\x2F\xFD";

/// The `size` bytes that "zstd" or "lz4" packed. It never makes more of them, and takes memory only as they
/// come: a packed bomb is an Error, "bad-compression". Other names: "unknown-compression".
Result<std::vector<std::uint8_t>> decompressed(const std::string& compression, Bytes packed,
                                               std::size_t size);

}  // namespace roboss::bags
