// Labels of what cameras see: those of the world file (Gazebo's Label plugin), or one for each kind of model.
#pragma once

#include <map>
#include <string>

#include "world/world.h"

namespace roboss {

/// Names of labels, by number.
using LabelNames = std::map<int, std::string>;

/// The name of a kind: that of the model without a number at its end ("car_12" and "car 3" are "car").
std::string kind_of_model(const std::string& model);

/// Labels as `choice` says: `world` leaves them; `models` gives each kind of model that can move a label,
/// from 1 in the order of the file, 255 at most; `auto` does so if the world has none. Returns the names of
/// all labels. Labels of a world are named after the kinds of models that have them.
LabelNames label_world(World& world, const std::string& choice);

}  // namespace roboss
