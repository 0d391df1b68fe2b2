// RateLimit: a token bucket, which allows a number of events a second, and a burst after a pause.
#pragma once

#include <algorithm>
#include <cstdint>

namespace roboss {

/// See the top of the file.
class RateLimit {
  public:
    /// `burst`: as often at once, after a pause.
    RateLimit(double per_second, double burst) : per_second_(per_second), burst_(burst), left_(burst) {}
    /// For one second's worth at once.
    explicit RateLimit(double per_second) : RateLimit(per_second, per_second) {}

    /// False: too many.
    bool take(std::int64_t now_ms) {
        if (then_ms_ == 0) then_ms_ = now_ms;
        left_ = std::min(burst_, left_ + 1e-3 * static_cast<double>(now_ms - then_ms_) * per_second_);
        then_ms_ = now_ms;
        if (left_ < 1) return false;
        left_ -= 1;
        return true;
    }

  private:
    double per_second_, burst_, left_;
    std::int64_t then_ms_ = 0;
};

}  // namespace roboss
