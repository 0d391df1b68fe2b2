// The makers of the single adapters; engines.cpp lists those that were built in.
#pragma once

#include "engines/engine.h"

namespace roboss::bench {

std::unique_ptr<Engine> make_roboss(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_roboss_in_4_lanes(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_roboss_in_1_lane(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_roboss_fast(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_roboss_high(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_roboss_in_floats(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_roboss_in_8_floats(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_mujoco(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_ode(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_bullet(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_dart(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_box3d(const World& world, const EngineOptions& options);
std::unique_ptr<Engine> make_rapier(const World& world, const EngineOptions& options);

}  // namespace roboss::bench
