// The tracer on AVX2. Built for that instruction set alone (layer.cmake): nothing in here may run before the
// processor has been asked (best_tracer).
#include "core/lanes_x86.h"
#include "render/trace_lanes.h"

namespace roboss::render {

std::unique_ptr<Tracer> make_avx2_tracer() {
#if defined(__AVX2__)
    if (__builtin_cpu_supports("avx2")) return std::make_unique<LaneTracer<FloatsAvx2>>();
#endif
    return nullptr;
}

}  // namespace roboss::render
