// The register that says how a processor rounds and what it does with tiny numbers, for tests that a step
// does not depend on what a caller left in it.
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace roboss::test {

#if defined(__x86_64__)
inline constexpr std::uint64_t kFlushTinyNumbers = 0x8040, kRoundTowardsZero = 0x6000;  // in MXCSR

inline std::uint64_t float_control() {
    return _mm_getcsr();
}
inline void set_float_control(std::uint64_t control) {
    _mm_setcsr(static_cast<unsigned>(control));
}
#elif defined(__aarch64__)
inline constexpr std::uint64_t kFlushTinyNumbers = 1u << 24, kRoundTowardsZero = 3u << 22;  // in FPCR

inline std::uint64_t float_control() {
    std::uint64_t control = 0;
    asm volatile("mrs %0, fpcr" : "=r"(control));
    return control;
}
inline void set_float_control(std::uint64_t control) {
    asm volatile("msr fpcr, %0" : : "r"(control) : "memory");
}
#endif

}  // namespace roboss::test
