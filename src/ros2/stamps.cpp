// See stamps.h.
#include "ros2/stamps.h"

#include <cmath>

namespace roboss::ros2 {

Time stamp_of(const Model& model, Tick tick) {
    const double seconds = static_cast<double>(tick) * model.dt_s;
    auto sec = static_cast<std::int32_t>(std::floor(seconds));
    auto nanosec = static_cast<std::int64_t>(std::llround((seconds - sec) * 1e9));
    if (nanosec >= 1'000'000'000) ++sec, nanosec -= 1'000'000'000;
    return {sec, static_cast<std::uint32_t>(nanosec)};
}

}  // namespace roboss::ros2
