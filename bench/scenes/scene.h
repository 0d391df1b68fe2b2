// The scenes on which engines are compared: a World, what drives it, and how to tell that an engine simulated
// it rightly. Everything goes through the Engine interface, so every engine does the same work.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/types.h"
#include "engines/engine.h"

namespace roboss::bench {

inline constexpr double kSceneDt = 0.002;

/// Whether the result is right, with the figures that say so.
struct Verdict {
    bool good = false;
    std::string text;
};

struct Scene {
    World world;
    std::size_t robots = 0;  // those that the figures count
    double dt_s = kSceneDt;
    int settle = 0;                                     // ticks at least before anything is counted
    bool sleep = false;                                 // what rests may be left alone
    std::function<void(Engine&)> start;                 // before the first tick
    std::function<void(Engine&, Tick)> control;         // before every tick; may be empty
    std::function<Verdict(const Engine&, Tick)> judge;  // after the tick before `Tick`
};

struct SceneKind {
    std::string name;
    std::string what;                 // one line for people
    std::vector<std::size_t> robots;  // the sizes that are measured
    std::function<Scene(std::size_t robots)> make;
};

std::span<const SceneKind> scenes();

// Cars 1.5 m apart on a plane, all driving forward: four wheels, velocity motors of 10 rad/s and .5 N m.
Scene cars_scene(std::size_t cars);
// The same cars among a hundred static boxes, at one car on .7 m^2, driving to and fro: they hit the boxes
// and each other all the time.
Scene city_scene(std::size_t cars);
// Six-legged walkers of 18 servos: a second standing, then a tripod gait.
Scene spiders_scene(std::size_t spiders);
// Arms of four servos on fixed bases, following a path.
Scene arms_scene(std::size_t arms);
// Boxes, spheres and cylinders falling onto a plane and onto each other.
Scene shapes_scene(std::size_t shapes);
// The same in twenty layers: they land on each other and collapse.
Scene deep_pile_scene(std::size_t shapes);
// Bodies with four passive legs, dropped into a box.
Scene pile_scene(std::size_t robots);
// Parcels on a moving belt.
Scene belt_scene(std::size_t parcels);
// Boxes, cylinders and spheres at rest, as in gz-sim's example world 3k_shapes: awake, or free to fall
// asleep.
Scene resting_shapes_scene(std::size_t shapes);
Scene sleeping_shapes_scene(std::size_t shapes);
// A net of plates and ball joints, hanging on two corners: one robot. Its plates are counted.
Scene joint_grid_scene(std::size_t plates);
// Humanoids of a thousand convex hulls each, falling freely.
Scene many_hulls_scene(std::size_t humanoids);
// Four-wheelers on hills: a scene for each kind of ground and of wheels.
std::vector<SceneKind> terrain_kinds();

}  // namespace roboss::bench
