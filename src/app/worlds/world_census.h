// Counts what is in a World, for summaries.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "model/model.h"
#include "world/world.h"

namespace roboss {

struct WorldCensus {
    std::size_t robots = 0;       // as the run counts them; a model in several parts is several robots
    std::size_t robot_types = 0;  // distinct ones
    std::size_t static_models = 0;
    std::size_t links = 0;                       // of the robots
    std::map<std::string, std::size_t> joints;   // of the robots, by kind
    std::map<std::string, std::size_t> shapes;   // collisions of everything, by kind
    std::map<std::string, std::size_t> sensors;  // that measure, of robots and static models, by kind
    std::map<std::string, std::size_t> silent;   // that give no readings, by type
};

/// Robots, links and joints are those of the Model. Null: the world cannot run; they are those of the file.
WorldCensus take_census(const World& world, const Model* model);

/// The robots of a run, without the board that carries the messages of the world.
std::size_t count_robots(const Model& model);

const char* to_text(GeometryKind kind);

}  // namespace roboss
