// A square block of numbers in registers: rows become columns. Local to the translation unit that includes
// it, as lane_six.h.
#pragma once

#include <cstddef>

namespace roboss {
namespace {

/// `r`: kLanes registers of kLanes numbers each; 2, 4 or 8.
template <std::size_t kLanes, class Register>
[[gnu::always_inline]] inline void transpose(Register* r) {
    if constexpr (kLanes == 8) {
        Register p[8], q[8];
        for (std::size_t i = 0; i < 8; i += 2) {
            p[i] = __builtin_shufflevector(r[i], r[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
            p[i + 1] = __builtin_shufflevector(r[i], r[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
        }
        for (std::size_t i = 0; i < 8; i += 4)
            for (std::size_t k = 0; k < 2; ++k) {
                q[i + 2 * k] = __builtin_shufflevector(p[i + k], p[i + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
                q[i + 2 * k + 1] =
                    __builtin_shufflevector(p[i + k], p[i + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
            }
        for (std::size_t k = 0; k < 4; ++k) {
            r[k] = __builtin_shufflevector(q[k], q[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
            r[k + 4] = __builtin_shufflevector(q[k], q[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
        }
    } else if constexpr (kLanes == 4) {
        Register p[4];
        for (std::size_t i = 0; i < 4; i += 2) {
            p[i] = __builtin_shufflevector(r[i], r[i + 1], 0, 4, 1, 5);
            p[i + 1] = __builtin_shufflevector(r[i], r[i + 1], 2, 6, 3, 7);
        }
        for (std::size_t k = 0; k < 2; ++k) {
            r[2 * k] = __builtin_shufflevector(p[k], p[k + 2], 0, 1, 4, 5);
            r[2 * k + 1] = __builtin_shufflevector(p[k], p[k + 2], 2, 3, 6, 7);
        }
    } else {
        const Register first = __builtin_shufflevector(r[0], r[1], 0, 2);
        r[1] = __builtin_shufflevector(r[0], r[1], 1, 3);
        r[0] = first;
    }
}

}  // namespace
}  // namespace roboss
