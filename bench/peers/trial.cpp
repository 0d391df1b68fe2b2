// See trial.h.
#include "peers/trial.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
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

double resident() {
    long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%*d %ld", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

Trial::Trial(const EngineKind& kind, const Scene& scene, double accuracy, bool measure)
    : scene_(scene), heap_before_(heap_in_use()), resident_before_(resident()) {
    const double start = seconds(CLOCK_MONOTONIC);
    engine_ = kind.make(
        scene.world,
        EngineOptions{.dt_s = scene.dt_s, .measure = measure, .sleep = scene.sleep, .accuracy = accuracy});
    if (!engine_) throw std::runtime_error(kind.name + " cannot express this scene");
    scene.start(*engine_);
    build_s_ = seconds(CLOCK_MONOTONIC) - start;
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

double Trial::memory_bytes() const {
    malloc_trim(0);
    return std::min(heap_in_use() - heap_before_, resident() - resident_before_);
}

}  // namespace roboss::bench
