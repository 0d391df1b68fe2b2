// The checksum of MCAP files: CRC-32 of IEEE 802.3, as zlib and PNG have it.
#pragma once

#include <boost/crc.hpp>
#include <cstdint>
#include <span>

namespace roboss::bags {

inline std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
    boost::crc_32_type sum;
    sum.process_bytes(bytes.data(), bytes.size());
    return sum.checksum();
}

}  // namespace roboss::bags
