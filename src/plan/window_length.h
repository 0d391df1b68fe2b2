// How many ticks the next window should have. Long windows spare messages; but forecasts reach further,
// islands grow and repeats cost more. Depends on counts only (never on clocks), so a run's windows are the
// same every time.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/types.h"

namespace roboss {

class WindowLength {
  public:
    /// `fixed` 0: adapt within 1 .. `longest`.
    WindowLength(Tick fixed, Tick longest)
        : fixed_(fixed), longest_(longest), ticks_(std::min<Tick>(8, longest)) {}

    Tick ticks() const { return fixed_ > 0 ? fixed_ : ticks_; }

    /// A window of `ticks` was committed: whether islands had to be merged and repeated, and how much of the
    /// world the largest island was, as a share of what one worker should have (1: just even).
    void committed(Tick ticks, bool repeated, double largest_share) {
        if (repeated) {
            ticks_ = std::max<Tick>(1, std::min(ticks_, ticks) / 2);
            calm_ = 0;
        } else if (largest_share > 1 && ticks_ > kShort) {
            ticks_ = std::max(kShort, ticks_ - ticks_ / 4);  // it may fall apart when looked at for less long
            calm_ = 0;
        } else if (++calm_ >= kCalm && largest_share <= 1) {
            ticks_ = std::min(longest_, ticks_ + std::max<Tick>(1, ticks_ / 4));
            calm_ = 0;
        }
    }

  private:
    static constexpr int kCalm = 4;  // windows without a repeat before the length grows
    static constexpr Tick kShort = 4;
    Tick fixed_, longest_, ticks_;
    int calm_ = 0;
};

}  // namespace roboss
