// Instruction sets for Lanes: what the language has no operator for. Only translation units that are built
// for the instruction set may include this.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "core/lanes.h"

namespace roboss {

#if defined(__AVX2__)
/// Registers of 32 bytes: 4 doubles or 8 floats.
struct Avx2 {
    using Bits64 [[gnu::vector_size(32)]] = std::int64_t;
    using Bits32 [[gnu::vector_size(32)]] = std::int32_t;
    static __m256d sqrt(__m256d x) { return _mm256_sqrt_pd(x); }
    static __m256 sqrt(__m256 x) { return _mm256_sqrt_ps(x); }
    static __m256d floor(__m256d x) { return _mm256_floor_pd(x); }
    static __m256 floor(__m256 x) { return _mm256_floor_ps(x); }
    static __m256d magnitude(__m256d x) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x); }
    static __m256 magnitude(__m256 x) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), x); }
    static unsigned bits(Bits64 m) {
        return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m)));
    }
    static unsigned bits(Bits32 m) {
        return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(m)));
    }
    /// Two registers of doubles as one of floats, and its halves.
    static __m256 join(__m256d a, __m256d b) {
        return _mm256_set_m128(_mm256_cvtpd_ps(b), _mm256_cvtpd_ps(a));
    }
    static __m256d low(__m256 x) { return _mm256_cvtps_pd(_mm256_castps256_ps128(x)); }
    static __m256d high(__m256 x) { return _mm256_cvtps_pd(_mm256_extractf128_ps(x, 1)); }
};
using DoublesAvx2 = Lanes<double, 4, Avx2>;
using FloatsAvx2 = Lanes<float, 8, Avx2>;
#endif

#if defined(__AVX512F__) && defined(__AVX512DQ__)
/// Registers of 64 bytes: 8 doubles or 16 floats. The forms with a mask of all lanes spare a false warning of
/// g++ 12 (bug 105593).
struct Avx512 {
    using Bits64 [[gnu::vector_size(64)]] = std::int64_t;
    using Bits32 [[gnu::vector_size(64)]] = std::int32_t;
    static __m512d sqrt(__m512d x) { return _mm512_maskz_sqrt_pd(0xFF, x); }
    static __m512 sqrt(__m512 x) { return _mm512_maskz_sqrt_ps(0xFFFF, x); }
    static __m512d floor(__m512d x) { return _mm512_maskz_roundscale_pd(0xFF, x, _MM_FROUND_TO_NEG_INF); }
    static __m512 floor(__m512 x) { return _mm512_maskz_roundscale_ps(0xFFFF, x, _MM_FROUND_TO_NEG_INF); }
    static __m512d magnitude(__m512d x) { return _mm512_andnot_pd(_mm512_set1_pd(-0.0), x); }
    static __m512 magnitude(__m512 x) { return _mm512_andnot_ps(_mm512_set1_ps(-0.0F), x); }
    static unsigned bits(Bits64 m) { return _mm512_movepi64_mask(reinterpret_cast<__m512i>(m)); }
    static unsigned bits(Bits32 m) { return _mm512_movepi32_mask(reinterpret_cast<__m512i>(m)); }
    static __m512 join(__m512d a, __m512d b) {
        return __builtin_shufflevector(_mm512_maskz_cvtpd_ps(0xFF, a), _mm512_maskz_cvtpd_ps(0xFF, b), 0, 1,
                                       2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    }
    static __m512d low(__m512 x) {
        return _mm512_maskz_cvtps_pd(0xFF, __builtin_shufflevector(x, x, 0, 1, 2, 3, 4, 5, 6, 7));
    }
    static __m512d high(__m512 x) {
        return _mm512_maskz_cvtps_pd(0xFF, __builtin_shufflevector(x, x, 8, 9, 10, 11, 12, 13, 14, 15));
    }
};
using DoublesAvx512 = Lanes<double, 8, Avx512>;
using FloatsAvx512 = Lanes<float, 16, Avx512>;
#endif

}  // namespace roboss
