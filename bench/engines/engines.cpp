// Which engines this build has: RoBOSS always, each peer where its library was found (bench/CMakeLists.txt).
#include "engines/makers.h"

namespace roboss::bench {

std::span<const EngineKind> engines() {
    static const std::vector<EngineKind> kinds = {
        {"RoBOSS", make_roboss},
#ifdef ROBOSS_BENCH_MUJOCO
        {"MuJoCo", make_mujoco},
#endif
#ifdef ROBOSS_BENCH_ODE
        {"ODE", make_ode},
#endif
#ifdef ROBOSS_BENCH_BULLET
        {"Bullet", make_bullet},
#endif
#ifdef ROBOSS_BENCH_DART
        {"DART", make_dart},
#endif
    };
    return kinds;
}

}  // namespace roboss::bench
