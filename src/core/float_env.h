// The floating-point environment of a step: round to nearest, no flush-to-zero, no denormals-are-zero. A
// plugin built with -Ofast changes MXCSR (x86-64) or FPCR (aarch64) for every thread started later, so each
// step entry sets and restores it.
#pragma once

#include <cfenv>
#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace roboss {

class ExactFloatScope {
  public:
#if defined(__x86_64__)
    ExactFloatScope() : saved_(_mm_getcsr()) {
        _mm_setcsr(kExact);
    }
    ~ExactFloatScope() {
        _mm_setcsr(saved_);
    }

  private:
    static constexpr unsigned kExact = 0x1F80;  // all exceptions masked, round to nearest, FTZ and DAZ off
    unsigned saved_ = 0;
#elif defined(__aarch64__)
    ExactFloatScope() {
        asm volatile("mrs %0, fpcr" : "=r"(saved_));
        if (saved_ != kExact) set(kExact);
    }
    ~ExactFloatScope() {
        if (saved_ != kExact) set(saved_);
    }

  private:
    static constexpr std::uint64_t kExact = 0;  // no traps, round to nearest, FZ off, NaNs keep their bits
    static void set(std::uint64_t control) {    // slow on some processors, so only where it changes something
        asm volatile("msr fpcr, %0" : : "r"(control) : "memory");
    }
    std::uint64_t saved_ = 0;
#else
    ExactFloatScope() {
        std::fegetenv(&saved_), std::fesetenv(FE_DFL_ENV);
    }
    ~ExactFloatScope() {
        std::fesetenv(&saved_);
    }

  private:
    std::fenv_t saved_{};
#endif
  public:
    ExactFloatScope(const ExactFloatScope&) = delete;
    ExactFloatScope& operator=(const ExactFloatScope&) = delete;
};

}  // namespace roboss
