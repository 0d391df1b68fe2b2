// One trial in a process of its own: a peer that crashes, runs out of memory or takes too long costs its row
// and nothing else, and each engine's memory is its own. The parent tells it when to step, so that engines
// take turns and never run at the same time.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "scenes/scene.h"

namespace roboss::bench {

/// What a worker has to say.
struct Report {
    bool failed = false;
    bool good = false;     // the verdict
    double cpu_s = 0;      // of the engine's steps
    double build_s = 0;    // of building the scene
    double bytes = 0;      // of memory that the engine holds
    char engine[64] = "";  // with version
    char settings[256] = "";
    char text[256] = "";  // the verdict's figures, or why it failed
};

class Worker {
  public:
    Worker(const EngineKind& kind, const Scene& scene, double accuracy);
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Builds (first call) and steps; the counted time is cpu_s. A report that `failed` ends the worker.
    Report run(int ticks, double limit_s);
    /// The verdict on where the engine has come to.
    Report judge(double limit_s);

  private:
    Report ask(int ticks, double limit_s);
    void end();

    pid_t child_ = -1;
    int to_child_ = -1, from_child_ = -1;
};

}  // namespace roboss::bench
