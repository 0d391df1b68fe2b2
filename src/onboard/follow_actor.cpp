// See onboard_kinds/follow_actor.h.
#include <cmath>

#include "core/fixed_math.h"
#include "onboard/controllers.h"

namespace roboss {

void run(const FollowActorSpec& spec, OnboardContext& c) {
    if (!c.type().kinematic) return;
    const auto stand = [&] { c.state().surfaces.clear(); };
    if (!c.is_commanded(0)) return stand();
    const Pose X = base_pose(c.state());
    const double dx = c.command(0)[0] - X.p.x, dy = c.command(0)[1] - X.p.y;
    const double distance = std::sqrt(dx * dx + dy * dy);
    if (distance <= spec.min_distance || distance > spec.max_distance) return stand();
    const double rate = spec.velocity / distance;
    set_base_pose(c.state(), {X.p, from_rpy(0, 0, fixed_atan2(dy, dx))});
    c.move_base({}, {dx * rate, dy * rate, 0});
}

}  // namespace roboss
