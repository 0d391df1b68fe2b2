// RobotFrame: what the Controller learns of a robot from a window, 42 bytes on the way. Where it is and how
// it moves is for the forecast only, so it is rounded; the box in which it was decides what is true, and
// holds everything.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/types.h"
#include "math/box32.h"

namespace roboss {

struct RobotFrame {
    RobotId robot;
    Box32 swept;  // all interaction bounds since the window's start, a teleport, or it was taken over after a
                  // Cut
    std::array<std::uint8_t, 3> place{};  // centre of the last bound, in 255ths of the way through `swept`
    std::array<std::uint16_t, 3> velocity{};  // of the base at the end: the upper halves of floats, m/s
    std::uint64_t hash = 0;                   // state_hash at the end of the window
    friend bool operator==(const RobotFrame&, const RobotFrame&) = default;
};

inline constexpr float kPlaceSteps = 255.0f;

/// The place of `centre` in `swept`; in the middle where the box has no size or no end.
inline std::array<std::uint8_t, 3> pack_place(const std::array<double, 3>& centre, const Box32& swept) {
    std::array<std::uint8_t, 3> place{};
    for (std::size_t i = 0; i < 3; ++i) {
        const float share = (static_cast<float>(centre[i]) - swept.min[i]) / (swept.max[i] - swept.min[i]);
        place[i] = static_cast<std::uint8_t>(
            std::isfinite(share) ? std::clamp(share, 0.0f, 1.0f) * kPlaceSteps + 0.5f : kPlaceSteps / 2);
    }
    return place;
}

/// m; zero where the box has no end.
inline std::array<float, 3> unpack_place(const std::array<std::uint8_t, 3>& place, const Box32& swept) {
    std::array<float, 3> centre{};
    for (std::size_t i = 0; i < 3; ++i) {
        const float p =
            swept.min[i] + static_cast<float>(place[i]) / kPlaceSteps * (swept.max[i] - swept.min[i]);
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
