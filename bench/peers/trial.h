// One engine on one scene: built, settled, stepped in counted blocks, judged. Only the engine's own steps are
// counted, in CPU time of the thread, so that other work on the machine disturbs little.
#pragma once

#include <memory>

#include "scenes/scene.h"

namespace roboss::bench {

/// Seconds.
struct Spent {
    double cpu = 0, wall = 0;
};

class Trial {
  public:
    /// The scene must outlive the trial. Throws std::runtime_error if the engine cannot express it.
    Trial(const EngineKind& kind, const Scene& scene, double accuracy = 1, bool measure = false);

    /// Steps on; the orders that the scene gives between the ticks are not counted.
    Spent run(int ticks);
    Verdict judge() const { return scene_.judge(*engine_, tick_); }
    const Engine& engine() const { return *engine_; }
    double build_s() const { return build_s_; }
    /// What the engine holds beyond what was there before it: on the heap, or resident where that is less
    /// (some reserve far more than they touch).
    double memory_bytes() const;

  private:
    const Scene& scene_;
    double heap_before_ = 0, resident_before_ = 0, build_s_ = 0;
    std::unique_ptr<Engine> engine_;
    Tick tick_ = 0;
};

}  // namespace roboss::bench
