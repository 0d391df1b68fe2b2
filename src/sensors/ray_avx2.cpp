// The ray tracer on AVX2. Built for that instruction set alone (layer.cmake): nothing in here may run before
// the processor has been asked (best_ray_tracer).
#include "core/lanes_x86.h"
#include "sensors/ray_lanes.h"

namespace roboss {

std::unique_ptr<RayTracer> make_avx2_ray_tracer() {
#if defined(__AVX2__)
    if (__builtin_cpu_supports("avx2")) return std::make_unique<LaneRayTracer<FloatsAvx2, DoublesAvx2>>();
#endif
    return nullptr;
}

}  // namespace roboss
