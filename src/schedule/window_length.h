// How many ticks the next window should have. Long windows need fewer messages; but forecasts reach further,
// islands grow and repetitions cost more. Depends on counts only (never on clocks), so a run's windows are
// the same every time on one Simulator; on several, work stealing influences what forecasts see.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/types.h"

namespace roboss {

/// With few robots per worker the messages would take most of the time, so windows are longer: 64 ticks for
/// many robots, up to 128 for few, and 256 with one worker, for which no island can be too large. `workers`:
/// threads that step, of all Simulators.
inline Tick longest_window(std::size_t robots, std::size_t workers) {
    const std::size_t robots_each = robots / std::max<std::size_t>(workers, 1);
    const Tick wanted = 32'000 / static_cast<Tick>(std::max<std::size_t>(robots_each, 1));
    return std::clamp<Tick>(wanted, 64, workers > 1 ? 128 : 256);
}

class WindowLength {
  public:
    /// `fixed` 0: adapt.
    explicit WindowLength(Tick fixed) : fixed_(fixed) {}

    Tick ticks() const {
        if (fixed_ > 0) return fixed_;
        return probing_ ? std::min(kShort, ticks_) : ticks_;
    }

    /// A window of `ticks` was committed: whether islands were merged and repeated, and the size of the
    /// largest island relative to an even share of one worker (1: just even). The next ones have at most
    /// `longest` ticks, twice as many for a pile that nothing separates.
    void committed(Tick ticks, bool repeated, double largest_share, Tick longest) {
        const bool probed = std::exchange(probing_, false);
        if (largest_share <= 1) {
            if (probed) ticks_ = kShort;  // it does separate
            one_pile_ = false, short_windows_ = 0;
        }
        if (repeated) {
            ticks_ = std::max<Tick>(1, std::min(ticks_, ticks) / 2);
            calm_ = 0, in_haste_ = false;
        } else if (largest_share <= 1 || one_pile_) {
            grow_when_calm(one_pile_ ? 2 * longest : longest);
            probing_ = one_pile_ && ++since_probe_ % kProbeEvery == 0;
        } else if (ticks_ > kShort) {
            ticks_ = std::max(kShort, ticks_ - ticks_ / 4);  // it may separate in shorter windows
            calm_ = 0, in_haste_ = false;
        } else {
            one_pile_ = in_haste_ = ++short_windows_ >= kTries;
        }
    }

  private:
    static constexpr int kCalm = 4;  // windows without a repeat before the length grows
    static constexpr Tick kShort = 4;
    static constexpr int kTries = 8;        // short windows with one large island before it counts as a pile
    static constexpr int kProbeEvery = 32;  // windows; then a short one tests whether it still is a pile

    void grow_when_calm(Tick longest) {
        if (++calm_ < kCalm && !in_haste_) return;
        ticks_ = std::min(longest, ticks_ + (in_haste_ ? ticks_ : std::max<Tick>(1, ticks_ / 4)));
        calm_ = 0;
    }

    Tick fixed_, ticks_ = 8;
    int calm_ = 0, short_windows_ = 0, since_probe_ = 0;
    bool one_pile_ = false, probing_ = false;  // a large island that short windows do not separate
    bool in_haste_ = true;                     // doubles with every window until one had to be repeated
};

}  // namespace roboss
