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
    Trial(const EngineKind& kind, const Scene& scene);

    /// Steps on; the orders that the scene gives between the ticks are not counted.
    Spent run(int ticks);
    Verdict judge() const { return scene_.judge(*engine_, tick_); }
    const Engine& engine() const { return *engine_; }
    /// What the engine has on the heap beyond what was there before it, in bytes.
    double heap_bytes() const;

  private:
    const Scene& scene_;
    double heap_before_ = 0;
    std::unique_ptr<Engine> engine_;
    Tick tick_ = 0;
};

}  // namespace roboss::bench
