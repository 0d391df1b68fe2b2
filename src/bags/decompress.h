// Unpacks what Zstandard or LZ4 (frames) packed.
#pragma once

#include <string>
#include <vector>

#include "bags/bag.h"

namespace roboss::bags {

/// The `size` bytes that "zstd" or "lz4" packed. It never makes more of them, and takes memory only as they
/// come: a packed bomb is an Error, "bad-compression". Other names: "unknown-compression".
Result<std::vector<std::uint8_t>> decompressed(const std::string& compression, Bytes packed,
                                               std::size_t size);

}  // namespace roboss::bags
