// See trial.h.
#include "peers/trial.h"

#include <malloc.h>

#include <ctime>

#include <stdexcept>

namespace roboss::bench {
namespace {

double seconds(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Bytes in use, small pieces and mapped ones.
double heap_in_use() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

}  // namespace

Trial::Trial(const EngineKind& kind, const Scene& scene) : scene_(scene), heap_before_(heap_in_use()) {
    engine_ = kind.make(scene.world, EngineOptions{.dt_s = kSceneDt, .accuracy = 1});
    if (!engine_) throw std::runtime_error(kind.name + " cannot express this scene");
    scene.start(*engine_);
}

Spent Trial::run(int ticks) {
    Spent spent;
    // Between ticks without orders the engine may go on by itself.
    const int stride = scene_.control ? 1 : ticks;
    for (int done = 0; done < ticks; done += stride) {
        if (scene_.control) scene_.control(*engine_, tick_);
        const double cpu = seconds(CLOCK_THREAD_CPUTIME_ID), wall = seconds(CLOCK_MONOTONIC);
        engine_->step(stride);
        spent.wall += seconds(CLOCK_MONOTONIC) - wall;
        spent.cpu += seconds(CLOCK_THREAD_CPUTIME_ID) - cpu;
        tick_ += stride;
    }
    return spent;
}

double Trial::heap_bytes() const {
    return heap_in_use() - heap_before_;
}

}  // namespace roboss::bench
