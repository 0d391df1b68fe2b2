// All scenes and the sizes in which they are measured.
#include "scenes/scene.h"

#include <algorithm>
#include <iterator>

namespace roboss::bench {

std::span<const SceneKind> scenes() {
    static const std::vector<SceneKind> kinds = [] {
        std::vector<SceneKind> all = {
            {"cars", "four-wheeled cars driving on a plane, 1.5 m apart", {50, 500, 2000, 10000}, cars_scene},
            {"city", "the same cars driving into 100 boxes and each other", {50, 500, 2000}, city_scene},
            {"spiders", "six-legged walkers: standing, then a tripod gait", {20, 200}, spiders_scene},
            {"arms", "arms of four joints on fixed bases following a path", {100}, arms_scene},
            {"shapes",
             "boxes, spheres and cylinders falling on a plane and on each other",
             {3000},
             shapes_scene},
            {"deep_pile", "the same in twenty layers that collapse", {400, 4000}, deep_pile_scene},
            {"pile", "four-legged bodies without motors dropped into a box", {50, 500}, pile_scene},
            {"joint_grid",
             "a net of plates and ball joints on two corners; plates are counted",
             {36, 100},
             joint_grid_scene},
            {"many_hulls",
             "humanoids of 1000 convex hulls each, falling freely and bending",
             {1, 10},
             many_hulls_scene},
            {"belt", "parcels on a moving belt; some engines have none", {500}, belt_scene},
            {"3k_shapes",
             "the shapes of gz-sim's 3k_shapes at rest, awake, dt 1 ms",
             {3000},
             resting_shapes_scene},
            {"3k_asleep",
             "the same, free to fall asleep, where an engine can",
             {3000},
             sleeping_shapes_scene},
        };
        std::ranges::move(terrain_kinds(), std::back_inserter(all));
        return all;
    }();
    return kinds;
}

}  // namespace roboss::bench
