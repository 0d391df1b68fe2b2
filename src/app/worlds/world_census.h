// Counts what is in a World, for summaries.
#pragma once

#include <map>
#include <string>

#include "world/world.h"

namespace roboss {

struct WorldCensus {
    std::size_t robots = 0;       // movable models
    std::size_t robot_types = 0;  // distinct ones
    std::size_t static_models = 0;
    std::size_t links = 0;                       // of the robots
    std::map<std::string, std::size_t> joints;   // of the robots, by kind
    std::map<std::string, std::size_t> shapes;   // collisions of everything, by kind
    std::map<std::string, std::size_t> sensors;  // of the robots, by kind
    std::map<std::string, std::size_t> silent;   // sensors of everything that give no readings, by type
};

WorldCensus take_census(const World& world);

const char* to_text(GeometryKind kind);

}  // namespace roboss
