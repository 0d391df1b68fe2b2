// See onboard_kinds/surface_velocity.h.
#include "onboard/controllers.h"

namespace roboss {

void run(const SurfaceVelocitySpec& spec, OnboardContext& c) {
    SurfaceMotion motion;
    motion.link = c.link(0);
    motion.linear_L = spec.linear, motion.angular_L = spec.angular;
    if (!spec.fixed && c.is_commanded(0)) {
        const std::span<const double> v = c.command(0);
        motion.linear_L = {v[0], v[1], v[2]}, motion.angular_L = {v[3], v[4], v[5]};
    }
    c.move_surface(motion);
}

}  // namespace roboss
