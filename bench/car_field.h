// Cars on a plane, far enough apart never to meet: the work that the benchmark times. Each car is an island
// of its own, stepped one after the other, as a Simulator does.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "physics/step.h"
#include "support/robots.h"

namespace roboss::bench {

inline World car_field_world(int cars, double dt_s) {
    World world;
    world.name = "car_field";
    world.dt_s = dt_s;
    world.prototypes.push_back(test::scenery(test::collision(GeometryKind::kPlane, test::surface(0.9))));
    world.prototypes.push_back(test::car());
    world.instances.push_back({"ground", 0, {}, {}});
    for (int i = 0; i < cars; ++i) {
        const Pose X_WM{{2.0 * (i % 25), 2.0 * (i / 25), 0}, from_rpy(0, 0, 0.1 * i)};
        world.instances.push_back({"car_" + std::to_string(i), 1, X_WM, {}});
    }
    return world;
}

class CarField {
  public:
    CarField(int cars, double dt_s) {
        Diagnostics diagnostics;
        model_ = compile(car_field_world(cars, dt_s), {}, diagnostics);
        for (std::size_t i = 0; i < model_->robots.size(); ++i)
            states_.push_back(initial_state(*model_, RobotId(i)));
    }

    /// Latches all four motors: velocity in rad/s of the left and the right wheels.
    void drive(double left, double right) {
        for (RobotState& state : states_) {
            for (std::size_t wheel = 0; wheel < state.motors.size(); ++wheel)
                state.motors[wheel] = {MotorMode::kVelocity, wheel % 2 == 0 ? left : right, 2.0};
        }
    }

    void step() {
        for (std::size_t i = 0; i < states_.size(); ++i) {
            const RobotId robot(i);
            RobotState* state = &states_[i];
            const StepReport report =
                step_island(*model_, tick_, {&robot, 1}, {&state, 1}, {}, {&bound_, 1}, scratch_);
            contacts_ += report.contacts;
            residual_max_ = std::max(residual_max_, report.residual);
        }
        ++tick_;
    }

    std::size_t cars() const { return states_.size(); }
    const std::vector<RobotState>& states() const { return states_; }
    std::int64_t contacts() const { return contacts_; }  // summed over all cars and steps
    double residual_max() const { return residual_max_; }
    std::uint64_t hash() const {
        std::vector<std::uint64_t> hashes;
        for (std::size_t i = 0; i < states_.size(); ++i)
            hashes.push_back(state_hash(RobotId(i), tick_, states_[i]));
        return world_hash(model_->hash, hashes);
    }

  private:
    std::shared_ptr<const Model> model_;
    std::vector<RobotState> states_;
    StepScratch scratch_;
    Aabb bound_;
    Tick tick_ = 0;
    std::int64_t contacts_ = 0;
    double residual_max_ = 0;
};

}  // namespace roboss::bench
