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
#ifdef ROBOSS_BENCH_BOX3D
        {"Box3D", make_box3d},
#endif
#ifdef ROBOSS_BENCH_RAPIER
        {"Rapier", make_rapier},
#endif
    };
    return kinds;
}

const EngineKind& floats() {
    static const EngineKind kind{"RoBOSS-float", make_roboss_in_floats};
    return kind;
}

std::span<const EngineKind> contestants() {
    static const std::vector<EngineKind> kinds = [] {
        std::vector<EngineKind> all(engines().begin(), engines().end());
        all.insert(all.begin() + 1, {{"RoBOSS-4", make_roboss_in_4_lanes},
                                     {"RoBOSS-1", make_roboss_in_1_lane},
                                     {"RoBOSS-fast", make_roboss_fast},
                                     floats(),
                                     {"RoBOSS-float-8", make_roboss_in_8_floats}});
        return all;
    }();
    return kinds;
}

}  // namespace roboss::bench
