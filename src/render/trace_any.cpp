// The tracer on any processor, where the compiler makes eight lanes of what there is; and the choice.
#include <cmath>

#include "render/trace_lanes.h"

namespace roboss::render {
namespace {

/// Eight lanes by the language alone.
struct AnySet {
    using Floats [[gnu::vector_size(32)]] = float;
    using Bits [[gnu::vector_size(32)]] = std::int32_t;
    static Floats sqrt(Floats x) {
        for (std::size_t i = 0; i < kPacket; ++i) x[i] = std::sqrt(x[i]);
        return x;
    }
    static Floats magnitude(Floats x) { return x < 0.0F ? -x : x; }
    static unsigned bits(Bits m) {
        unsigned bits = 0;
        for (std::size_t i = 0; i < kPacket; ++i) bits |= m[i] != 0 ? 1u << i : 0u;
        return bits;
    }
};

std::unique_ptr<Tracer> make_best() {
    if (auto tracer = make_avx2_tracer()) return tracer;
    return make_any_tracer();
}

}  // namespace

std::unique_ptr<Tracer> make_any_tracer() {
    return std::make_unique<LaneTracer<Lanes<float, kPacket, AnySet>>>();
}

const Tracer& best_tracer() {
    static const std::unique_ptr<Tracer> best = make_best();
    return *best;
}

}  // namespace roboss::render
