// The instruction set of aarch64 for Lanes: every such processor has it, so no file needs flags of its own
// and none is asked for it. A register has 16 bytes; more lanes are several registers (Twice, core/wide.h),
// which stay registers, while the compiler would keep one long vector in memory.
#pragma once

#if defined(__aarch64__)

#include <arm_neon.h>

#include "core/lanes.h"
#include "core/wide.h"

namespace roboss {

/// Registers of 16 bytes: 2 doubles or 4 floats.
struct Neon {
    using Bits64 [[gnu::vector_size(16)]] = std::int64_t;
    using Bits32 [[gnu::vector_size(16)]] = std::int32_t;
    static float64x2_t sqrt(float64x2_t x) { return vsqrtq_f64(x); }
    static float32x4_t sqrt(float32x4_t x) { return vsqrtq_f32(x); }
    static float64x2_t floor(float64x2_t x) { return vrndmq_f64(x); }
    static float32x4_t floor(float32x4_t x) { return vrndmq_f32(x); }
    static float64x2_t magnitude(float64x2_t x) { return vabsq_f64(x); }
    static float32x4_t magnitude(float32x4_t x) { return vabsq_f32(x); }
    /// Bit i: lane i. A lane is all ones or all zeros; each keeps its own bit, and all are added.
    static unsigned bits(Bits64 m) {
        constexpr Bits64 kOwn{1, 2};
        const Bits64 own = m & kOwn;
        return static_cast<unsigned>(own[0] | own[1]);
    }
    static unsigned bits(Bits32 m) {
        constexpr Bits32 kOwn{1, 2, 4, 8};
        return static_cast<unsigned>(vaddvq_s32(m & kOwn));
    }
    /// Two registers of doubles as one of floats, and its halves.
    static float32x4_t join(float64x2_t a, float64x2_t b) { return vcvt_high_f32_f64(vcvt_f32_f64(a), b); }
    static float64x2_t low(float32x4_t x) { return vcvt_f64_f32(vget_low_f32(x)); }
    static float64x2_t high(float32x4_t x) { return vcvt_high_f64_f32(x); }
};
using DoublesNeon2 = Lanes<double, 2, Neon>;
using DoublesNeon4 = Twice<DoublesNeon2>;
using DoublesNeon8 = Twice<DoublesNeon4>;
using FloatsNeon4 = Lanes<float, 4, Neon>;
using FloatsNeon8 = Twice<FloatsNeon4>;
using FloatsNeon16 = Twice<FloatsNeon8>;

}  // namespace roboss

#endif
