// The floating-point environment of a step: round to nearest, no flush-to-zero, no denormals-are-zero. A
// plugin built with -Ofast changes MXCSR for every thread started later, so each step entry sets and restores
// it.
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
