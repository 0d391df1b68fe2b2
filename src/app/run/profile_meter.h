// ProfileMeter: the profile of a run for people who look at it, of about the last second. The run measures
// its steps only while somebody asks.
#pragma once

#include <cstdint>

#include "core/types.h"
#include "physics/step_profile.h"
#include "wire/control.h"

namespace roboss {

class ProfileMeter {
  public:
    /// Somebody asked less than three seconds ago.
    bool wanted(std::int64_t now_ms) const { return asked_ms_ >= 0 && now_ms - asked_ms_ < kFor_ms; }
    /// Of windows that were measured.
    void add(const StepProfile& more) { sum_ += more; }
    /// The newest full second that ended; `tick`: the last one committed.
    const RunProfile& asked(std::int64_t now_ms, Tick tick, double friction_tolerance);

  private:
    static constexpr std::int64_t kFor_ms = 3'000, kEvery_ms = 900;

    void begin(std::int64_t now_ms, Tick tick) { sum_ = {}, since_ms_ = now_ms, from_ = tick; }

    std::int64_t asked_ms_ = -1, since_ms_ = 0;
    Tick from_ = 0;
    StepProfile sum_;
    RunProfile shown_;
};

}  // namespace roboss
