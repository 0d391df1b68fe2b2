// See onboard_kinds/buoyancy_engine.h.
#include <algorithm>

#include "onboard/controllers.h"

namespace roboss {

void run(const BuoyancyEngineSpec& spec, OnboardContext& c) {
    constexpr double kUsual = 3e-5;  // m^3: Gazebo's set point where none is written
    const double usual = spec.default_volume >= 0 ? spec.default_volume : kUsual;
    const double aim =
        std::clamp(c.is_commanded(0) ? c.command(0)[0] : usual, spec.min_volume, spec.max_volume);
    double& volume = c.memory()[0];
    const double most = spec.max_rate * c.dt();
    volume += std::clamp(aim - volume, -most, most);
    const Vec3 place = c.pose(c.link(0)).p;
    const double density = place.z < spec.surface ? spec.density : 0.0;
    const double mass = density * volume - spec.density * spec.neutral_volume;
    if (mass != 0) c.push_at(c.link(0), c.gravity() * -mass, place);
}

}  // namespace roboss
