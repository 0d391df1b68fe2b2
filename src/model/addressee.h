// Who a radio message is for, by name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/result.h"
#include "model/model.h"

namespace roboss {

/// The robot with this name, or else the first one with a radio that has it as its address; nullopt: none.
std::optional<RobotId> find_addressee(const Model& model, const std::string& name);

/// Number of a radio in RobotType::radios, by its sensor's index; an Error names the robot and its radios.
Result<std::uint32_t> radio_number(const Model& model, RobotId robot, std::size_t sensor);

}  // namespace roboss
