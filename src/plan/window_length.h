// How many ticks the next window should have. Long windows spare messages; but forecasts reach further,
// islands grow and repeats cost more. Depends on counts only (never on clocks), so a run's windows are the
// same every time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/types.h"

namespace roboss {

class WindowLength {
  public:
    /// `fixed` 0: adapt within 1 .. `longest`.
    WindowLength(Tick fixed, Tick longest)
        : fixed_(fixed), longest_(longest), ticks_(std::min<Tick>(8, longest)) {}

    Tick ticks() const {
        if (fixed_ > 0) return fixed_;
        return probing_ ? std::min(kShort, ticks_) : ticks_;
    }

    /// A window of `ticks` was committed: whether islands had to be merged and repeated, and how much of the
    /// world the largest island was, as a share of what one worker should have (1: just even).
    void committed(Tick ticks, bool repeated, double largest_share) {
        const bool probed = std::exchange(probing_, false);
        if (largest_share <= 1) {
            if (probed) ticks_ = kShort;  // it does fall apart
            one_heap_ = false, short_windows_ = 0;
        }
        if (repeated) {
            ticks_ = std::max<Tick>(1, std::min(ticks_, ticks) / 2);
            calm_ = 0;
        } else if (largest_share <= 1 || one_heap_) {
            grow_when_calm();
            probing_ = one_heap_ && ++since_probe_ % kProbeEvery == 0;
        } else if (ticks_ > kShort) {
            ticks_ = std::max(kShort, ticks_ - ticks_ / 4);  // it may fall apart when looked at for less long
            calm_ = 0;
        } else {
            one_heap_ = ++short_windows_ >= kTries;
        }
    }

  private:
    static constexpr int kCalm = 4;  // windows without a repeat before the length grows
    static constexpr Tick kShort = 4;
    static constexpr int kTries = 8;        // short windows with one large island before it is believed
    static constexpr int kProbeEvery = 32;  // windows; then one short one shows whether it still is one

    void grow_when_calm() {
        if (++calm_ < kCalm) return;
        ticks_ = std::min(longest_, ticks_ + std::max<Tick>(1, ticks_ / 4));
        calm_ = 0;
    }

    Tick fixed_, longest_, ticks_;
    int calm_ = 0, short_windows_ = 0, since_probe_ = 0;
    bool one_heap_ = false, probing_ = false;  // a large island that short windows do not part
};

}  // namespace roboss
