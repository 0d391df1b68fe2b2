// Random crowds of boxes, spheres, cylinders and cars near each other, and the exact grouping of
// ARCHITECTURE.md ("Many Simulators"): islands by the interaction bounds that a step puts out, stepped again
// when two of them meet.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include <support/robots.h>
#include <support/simulation.h>

namespace roboss::test {

inline World random_crowd(std::uint64_t seed, int robots) {
    Random random(seed);
    World world = empty_world(2e-3);
    place(world, ground(surface(0.7)), "ground");
    place(world, scenery(box_shape({0.3, 3, 0.5}, surface(0.5))), "wall", {{0.4, 0, 0.2}, {}});
    const double side = 0.2 * std::sqrt(static_cast<double>(robots)) + 0.1;
    const double bounce = random.uniform(0, 1) < 0.5 ? 0.0 : 0.4;
    std::vector<std::size_t> kinds;
    const auto add = [&](ModelSpec model) {
        kinds.push_back(world.prototypes.size());
        world.prototypes.push_back(std::move(model));
    };
    add(solid_box(1.0, {0.2, 0.3, 0.1}, surface(0.6, bounce)));
    add(solid_box(0.4, {0.1, 0.1, 0.1}, surface(0.9)));
    add(solid_sphere(0.5, 0.1, surface(0.4, bounce)));
    add(solid_cylinder(0.8, 0.1, 0.2, surface(0.6)));
    add(car());
    for (int i = 0; i < robots; ++i) {
        const std::size_t kind = kinds[static_cast<std::size_t>(random.integer(0, 4))];
        Pose X{{random.uniform(-side, side), random.uniform(-side, side), random.uniform(0.1, 0.7)},
               random.rotation()};
        if (kind == kinds[4]) X = {{X.p.x, X.p.y, 0.01}, from_rpy(0, 0, random.uniform(-3, 3))};
        world.instances.push_back({"robot_" + std::to_string(i), kind, X, {}});
    }
    return world;
}

/// Random velocities and motor targets.
inline void stir(Simulation& sim, std::uint64_t seed) {
    Random random(seed + 1000);
    for (std::size_t r = 0; r < sim.states.size(); ++r) {
        for (std::size_t i = 0; i < 6; ++i) sim.states[r].v[i] = random.uniform(-1.5, 1.5);
        for (std::size_t d = 0; d < sim.states[r].motors.size(); ++d)
            sim.set_motor(r, d, MotorMode::kVelocity, random.uniform(-10, 10));
    }
}

/// Steps a world in islands: starts from every robot by itself, joins those whose bounds met, and repeats the
/// tick until none meet.
class GroupedStepper {
  public:
    /// One tick of all robots of `sim`; returns how many islands there were at the end. Uses one scratch for
    /// all.
    std::size_t step(Simulation& sim) {
        const std::vector<RobotState> start = sim.states;
        std::vector<std::vector<std::size_t>> islands;
        for (std::size_t i = 0; i < start.size(); ++i) islands.push_back({i});
        std::vector<char> done(islands.size(), 0);
        for (;;) {
            for (std::size_t i = 0; i < islands.size(); ++i) {
                if (!done[i]) step_one(sim, start, islands[i]);
                done[i] = 1;
            }
            if (!merge_first(sim, islands, done)) break;
        }
        ++sim.tick;
        return islands.size();
    }

  private:
    void step_one(Simulation& sim, const std::vector<RobotState>& start,
                  const std::vector<std::size_t>& members) {
        std::vector<RobotId> ids;
        std::vector<RobotState*> states;
        std::vector<Aabb> bounds(members.size());
        for (std::size_t m : members) {
            sim.states[m] = start[m];
            ids.push_back(sim.ids[m]);
            states.push_back(&sim.states[m]);
        }
        step_island(*sim.model, sim.tick, ids, states, {}, bounds, scratch_);
        for (std::size_t k = 0; k < members.size(); ++k) sim.bounds[members[k]] = bounds[k];
    }

    static bool meet(const Simulation& sim, const std::vector<std::size_t>& a,
                     const std::vector<std::size_t>& b) {
        for (std::size_t i : a)
            for (std::size_t j : b)
                if (overlaps(sim.bounds[i], sim.bounds[j])) return true;
        return false;
    }

    static bool merge_first(const Simulation& sim, std::vector<std::vector<std::size_t>>& islands,
                            std::vector<char>& done) {
        bool merged = false;
        for (std::size_t a = 0; a < islands.size(); ++a) {
            for (std::size_t b = a + 1; b < islands.size();) {
                if (!meet(sim, islands[a], islands[b])) {
                    ++b;
                    continue;
                }
                islands[a].insert(islands[a].end(), islands[b].begin(), islands[b].end());
                std::sort(islands[a].begin(), islands[a].end());
                islands.erase(islands.begin() + static_cast<std::ptrdiff_t>(b));
                done.erase(done.begin() + static_cast<std::ptrdiff_t>(b));
                done[a] = 0;
                merged = true;
                b = a + 1;
            }
        }
        return merged;
    }

    StepScratch scratch_;
};

}  // namespace roboss::test
