// A small hand-made Model for the sensors' tests: a free-floating cart with a mast link and a wheel on a
// revolute joint.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/model.h"
#include "model/robot_state.h"
#include "physics/probe.h"
#include "sensors/readings.h"
#include "world/joint_type.h"

namespace roboss::sensors_test {

/// Links: 0 "cart" (body 0, a box of 0.4 x 0.2 x 0.1 m), 1 "mast" (welded to body 0, 1 m above it, no shape),
/// 2 "wheel" (body 1, a sphere of 0.1 m at 0.5 m ahead, turning about y). Joints: 0 "mast_joint" (fixed), 1
/// "axle".
inline RobotType cart_type() {
    RobotType type;
    type.name = "cart";
    Body cart, wheel;
    cart.nv = 6;
    cart.mass = 1;
    wheel.parent = 0;
    wheel.joint = JointKind::kRevolute;
    wheel.X_PJ.p = {0.5, 0, 0};
    wheel.axis_J = {0, 1, 0};
    wheel.q_index = 7, wheel.v_index = 6, wheel.nv = 1;
    wheel.mass = 1;
    type.bodies = {cart, wheel};
    Dof axle;
    axle.body = 1;
    axle.joint = JointId(std::size_t{1});
    type.dofs = {axle};
    type.dof_parent = {-1, 0, 1, 2, 3, 4, 5};
    type.paths = DofPaths(type.dof_parent);
    type.links = {{"cart", 0, {}, {}}, {"mast", 0, {}, {}}, {"wheel", 1, {}, {}}};
    type.links[1].X_BL.p = {0, 0, 1};
    type.joints = {{"mast_joint", JointSpecKind::kFixed, -1, -1, -1, 0},
                   {"axle", JointSpecKind::kRevolute, 1, 7, 6, 1}};
    BodyShape box, tyre;
    box.shape = {ShapeKind::kBox, {0.2, 0.1, 0.05}, 0, 0};
    box.body = 0, box.link = LinkId(std::size_t{0});
    tyre.shape = {ShapeKind::kSphere, {}, 0.1, 0};
    tyre.body = 1, tyre.link = LinkId(std::size_t{2});
    type.shapes = {box, tyre};
    type.nq = 8, type.nv = 7;
    type.initial_q = {0.25};
    return type;
}

/// The parameters of a sensor, and where it stands on its link.
template <class Kind>
struct Mounted : Kind {
    Pose X_LS;
};

inline SensorSpec sensor(const std::string& name, const SensorParameters& parameters, const Pose& X_LS = {}) {
    SensorSpec spec;
    spec.name = name;
    spec.parameters = parameters;
    spec.X_LS = X_LS;
    return spec;
}

/// All states of a small world at one tick, as a Client has them.
class KnownStates final : public SensorSources {
  public:
    KnownStates(std::shared_ptr<const Model> model, std::vector<const RobotState*> states, Tick tick = 0)
        : model_(std::move(model)), states_(std::move(states)), tick_(tick) {}
    RayScene& ray_scene() override {
        if (!rays_) rays_ = std::make_unique<RayScene>(model_), rays_->update(states_);
        return *rays_;
    }
    StepProbe& step_probe() override {
        if (probe_.tick() < 0) probe_.step(tick_, states_);
        return probe_;
    }

    const RobotState& state_of(RobotId robot) override { return *states_[robot.index()]; }

  private:
    std::shared_ptr<const Model> model_;
    std::vector<const RobotState*> states_;
    Tick tick_ = 0;
    std::unique_ptr<RayScene> rays_;
    StepProbe probe_{*model_};
};

/// A reading of sensor `sensor` of robot `robot`; the test fails if there is none.
template <class Reading>
Reading read_as(const std::shared_ptr<const Model>& model, const std::vector<const RobotState*>& states,
                std::size_t sensor, Tick tick = 0, std::uint64_t seed = 1, std::size_t robot = 0) {
    KnownStates sources(model, states, tick);
    return measure_as<Reading>({*model, RobotId(robot), sensor, *states[robot], tick, seed, sources}).value();
}

inline void add_sensor(RobotType& type, std::size_t link, const SensorSpec& spec) {
    type.sensors.push_back({spec, LinkId(link)});
}

inline void add_static(Model& model, const Shape& shape, const Transform& X_WS) {
    model.statics.push_back({shape, X_WS, {}, "scenery", {}, {}, {}, false});
}

/// The model with `count` robots of this type.
inline std::shared_ptr<Model> model_of(const RobotType& type, std::size_t count) {
    auto model = std::make_shared<Model>();
    model->types = {type};
    for (std::size_t i = 0; i < count; ++i)
        model->robots.push_back({"cart_" + std::to_string(i), TypeId(std::size_t{0}), {}, 0});
    return model;
}

/// A cart at X_WB at rest, its wheel at 0.25 rad.
inline RobotState cart_at(const Pose& X_WB) {
    RobotState state;
    state.q = {X_WB.p.x, X_WB.p.y, X_WB.p.z, X_WB.q.w, X_WB.q.x, X_WB.q.y, X_WB.q.z, 0.25};
    state.v.assign(7, 0.0);
    state.motors.resize(1);
    return state;
}

/// What a sensor of a test::Simulation measures now, with seed 1.
template <class Reading, class Simulation>
Reading reading_of(const Simulation& sim, std::size_t robot = 0, std::size_t sensor = 0) {
    std::vector<const RobotState*> states;
    for (const RobotState& state : sim.states) states.push_back(&state);
    return read_as<Reading>(sim.model, states, sensor, sim.tick, 1, robot);
}

}  // namespace roboss::sensors_test
