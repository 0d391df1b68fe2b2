// A world built in code, compiled and stepped as one island, with what tests ask of it: energy, momentum,
// links by name. Energy and momentum come from the links' own masses and twists, not from the mass matrix
// that is under test.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <support/random.h>

#include "physics/dynamics/kinematics.h"
#include "physics/step.h"

namespace roboss::test {

inline std::shared_ptr<const Model> compiled(const World& world) {
    Diagnostics diagnostics;
    auto model = compile(world, {}, diagnostics);
    for (const Diagnostic& d : diagnostics.items())
        if (d.severity == Severity::kError) ADD_FAILURE() << to_text(d);
    return model;
}

/// A number worth reading in the test's output, beside the bound that it must keep.
inline void tell(const std::string& what, double value) {
    std::printf("    measured: %s = %.6g\n", what.c_str(), value);
}

struct Momentum {
    Vec3 linear, angular;  // about the world's origin
};

class Simulation {
  public:
    explicit Simulation(const World& from) : world(from), model(compiled(from)) {
        for (std::size_t i = 0; i < model->robots.size(); ++i) {
            ids.emplace_back(i);
            states.push_back(initial_state(*model, ids.back()));
        }
        for (RobotState& s : states) pointers.push_back(&s);
        bounds.resize(states.size());
    }
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    const StepReport& step(std::span<const Order> orders = {}) {
        report = step_island(*model, tick++, ids, pointers, orders, bounds, scratch);
        residual_max = std::max(residual_max, report.residual);
        iterations_max = std::max(iterations_max, report.iterations);
        return report;
    }
    void run(double seconds) {
        const auto ticks = static_cast<Tick>(seconds / model->dt_s + 0.5);
        for (Tick t = 0; t < ticks; ++t) step();
    }
    double time() const { return static_cast<double>(tick) * model->dt_s; }

    const RobotType& type(std::size_t robot) const { return model->type_of(RobotId(robot)); }
    /// Latches a motor; `dof` counts joint degrees of freedom.
    void set_motor(std::size_t robot, std::size_t dof, MotorMode mode, double target) {
        states[robot].motors[dof] = {mode, target, type(robot).dofs[dof].max_effort};
    }

    double energy(std::size_t robot) const {
        double sum = 0;
        for_links(robot, [&](const LinkSpec& spec, const Transform& X_WL, const Twist& twist) {
            const Vec3 arm = X_WL.R * spec.p_LC;
            const Vec3 v = twist.linear + cross(twist.angular, arm);
            const Vec3 w = transpose_times(X_WL.R, twist.angular);
            sum += 0.5 * spec.mass * norm_squared(v) + 0.5 * dot(w, spec.inertia_C * w);
            if (spec.gravity) sum -= spec.mass * dot(model->gravity, X_WL.p + arm);
        });
        return sum;
    }
    double energy() const {
        double sum = 0;
        for (std::size_t r = 0; r < states.size(); ++r) sum += energy(r);
        return sum;
    }
    Momentum momentum() const {
        Momentum sum;
        for (std::size_t r = 0; r < states.size(); ++r) {
            for_links(r, [&](const LinkSpec& spec, const Transform& X_WL, const Twist& twist) {
                const Vec3 arm = X_WL.R * spec.p_LC;
                const Vec3 p = (twist.linear + cross(twist.angular, arm)) * spec.mass;
                sum.linear += p;
                const Vec3 spin = X_WL.R * (spec.inertia_C * transpose_times(X_WL.R, twist.angular));
                sum.angular += cross(X_WL.p + arm, p) + spin;
            });
        }
        return sum;
    }
    std::uint64_t hash() const {
        std::vector<std::uint64_t> hashes;
        for (std::size_t i = 0; i < states.size(); ++i) hashes.push_back(state_hash(ids[i], tick, states[i]));
        return world_hash(model->hash, hashes);
    }

    World world;
    std::shared_ptr<const Model> model;
    std::vector<RobotId> ids;
    std::vector<RobotState> states;
    std::vector<RobotState*> pointers;
    std::vector<Aabb> bounds;
    StepScratch scratch;
    StepReport report;
    Tick tick = 0;
    double residual_max = 0;
    int iterations_max = 0;

  private:
    /// Calls visit(spec, pose, twist) for each link of the robot. Robots of several parts: links by name.
    template <class Visit>
    void for_links(std::size_t robot, Visit visit) const {
        const RobotType& t = type(robot);
        const ModelSpec& spec = world.prototypes[world.instances[model->robots[robot].family].prototype];
        for (const LinkSpec& l : spec.links) {
            const auto id = t.find_link(l.name);
            if (id) visit(l, link_pose(t, states[robot], *id), link_twist(t, states[robot], *id));
        }
    }
};

}  // namespace roboss::test
