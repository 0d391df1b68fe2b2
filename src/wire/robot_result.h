// RobotResult: a robot's part of a WindowResult, 42 encoded bytes. Position and velocity are for the forecast
// only, so they are rounded; validation uses the box, which contains all interaction bounds.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/types.h"
#include "math/box32.h"

namespace roboss {

struct RobotResult {
    RobotId robot;
    Box32 swept;  // all interaction bounds since the window's start, a teleport, or it was taken over after a
                  // Cut
    std::array<std::uint8_t, 3> position{};   // centre of the last bound, in 255ths of the extent of `swept`
    std::array<std::uint16_t, 3> velocity{};  // of the base at the end: the upper halves of floats, m/s
    std::uint64_t hash = 0;                   // state_hash at the end of the window
    friend bool operator==(const RobotResult&, const RobotResult&) = default;
};

inline constexpr float kPositionSteps = 255.0f;

/// The position of `centre` in `swept`; in the middle where the box has no size or no end.
inline std::array<std::uint8_t, 3> pack_position(const std::array<double, 3>& centre, const Box32& swept) {
    std::array<std::uint8_t, 3> position{};
    for (std::size_t i = 0; i < 3; ++i) {
        const float share = (static_cast<float>(centre[i]) - swept.min[i]) / (swept.max[i] - swept.min[i]);
        position[i] = static_cast<std::uint8_t>(std::isfinite(share)
                                                    ? std::clamp(share, 0.0f, 1.0f) * kPositionSteps + 0.5f
                                                    : kPositionSteps / 2);
    }
    return position;
}

/// m; zero where the box has no end.
inline std::array<float, 3> unpack_position(const std::array<std::uint8_t, 3>& position, const Box32& swept) {
    std::array<float, 3> centre{};
    for (std::size_t i = 0; i < 3; ++i) {
        const float p =
            swept.min[i] + static_cast<float>(position[i]) / kPositionSteps * (swept.max[i] - swept.min[i]);
        centre[i] = std::isfinite(p) ? p : 0;
    }
    return centre;
}

inline std::array<std::uint16_t, 3> pack_velocity(const std::array<double, 3>& velocity) {
    std::array<std::uint16_t, 3> packed{};
    for (std::size_t i = 0; i < 3; ++i)
        packed[i] =
            static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(static_cast<float>(velocity[i])) >> 16);
    return packed;
}

inline std::array<float, 3> unpack_velocity(const std::array<std::uint16_t, 3>& packed) {
    std::array<float, 3> velocity{};
    for (std::size_t i = 0; i < 3; ++i)
        velocity[i] = std::bit_cast<float>(static_cast<std::uint32_t>(packed[i]) << 16);
    return velocity;
}

}  // namespace roboss
