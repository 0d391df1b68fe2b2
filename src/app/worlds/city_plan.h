// The plan of a made-up city: streets in a grid, blocks with buildings or trees, parked obstacles, and places
// for cars. Lengths in m; x is east, y is north, the middle of the city is the origin. A pure function of the
// options, so the same options give the same city on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace roboss {

struct CityOptions {
    int cars = 50;
    std::uint64_t seed = 1;
};

/// An upright box, or a cylinder if radius > 0, standing on the ground.
struct CitySolid {
    double x = 0, y = 0, yaw = 0;
    double length = 0, width = 0;  // of a box, along its own x and y
    double radius = 0;
    double height = 0;
    const char* colour = "";  // "r g b"
};

/// Things that make one static model: the buildings of a block, or one parked obstacle.
struct CityGroup {
    std::string name;
    std::vector<CitySolid> solids;
};

struct CarPlace {
    double x = 0, y = 0, yaw = 0;
};

struct CityPlan {
    double width = 0, depth = 0;  // outer edges of the outer streets
    std::vector<CityGroup> groups;
    std::vector<CarPlace> cars;
};

inline constexpr double kStreetWidth = 4.0;
inline constexpr double kBlockSize = 8.0;

/// Blocks grow with the cars, so that the density stays that of fifty cars on six by six blocks.
CityPlan plan_city(const CityOptions& options);

}  // namespace roboss
