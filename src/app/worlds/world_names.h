// The names in a world that orders, control programs and options use: robots, links, joints, sensors,
// commands; and the frames of files, each on the link that stands for it there.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "model/model.h"
#include "world/world.h"

namespace roboss {

/// A joint, a sensor, or another thing that has a kind.
struct NamedThing {
    std::string name;  // as orders spell it
    std::string kind;  // "revolute", "gpu_lidar"
    bool operator==(const NamedThing&) const = default;
};

/// A frame of a file, such as a link of URDF that holds nothing.
struct NamedFrame {
    std::string name, link;  // as programs spell the link that it is fixed to
    bool operator==(const NamedFrame&) const = default;
};

/// The names of one robot type, and the robots that have it.
struct TypeNames {
    std::string type;
    std::vector<std::string> robots, links;
    std::vector<NamedThing> joints, sensors;
    std::vector<NamedFrame> frames;
    std::vector<std::string> commands;
};

/// All names that robots have, in the order of their first robots; types whose names are equal are one entry.
/// The board of the world's messages is left out. `world`: what the Model was compiled from.
std::vector<TypeNames> list_names(const Model& model, const World& world);

/// "car_0 ... car_49 (50)": consecutive numbers of a name are shortened where there are more than four.
std::string shortened(const std::vector<std::string>& names);

std::string to_text(const std::vector<TypeNames>& types);
nlohmann::json to_json(const std::vector<TypeNames>& types);

}  // namespace roboss
