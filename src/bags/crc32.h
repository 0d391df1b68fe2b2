// The checksum of MCAP files: CRC-32 of IEEE 802.3, as zlib and PNG have it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace roboss::bags {

inline std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
    static constexpr std::array<std::uint32_t, 256> kTable = [] {
        std::array<std::uint32_t, 256> table{};
        for (std::uint32_t byte = 0; byte < 256; ++byte) {
            std::uint32_t sum = byte;
            for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1) != 0 ? 0xEDB88320u : 0u);
            table[byte] = sum;
        }
        return table;
    }();
    std::uint32_t sum = 0xFFFFFFFFu;
    for (const std::uint8_t byte : bytes) sum = (sum >> 8) ^ kTable[(sum ^ byte) & 0xFF];
    return ~sum;
}

}  // namespace roboss::bags
