// See addressee.h.
#include "model/addressee.h"

#include <algorithm>

namespace roboss {

std::optional<RobotId> find_addressee(const Model& model, const std::string& name) {
    if (const auto robot = model.find_robot(name)) return robot;
    if (name.empty()) return std::nullopt;
    for (std::size_t i = 0; i < model.robots.size(); ++i) {
        const RobotType& type = model.type_of(RobotId(i));
        const auto has_address = [&](std::uint32_t sensor) {
            return type.sensors[sensor].spec.as<RadioSpec>()->address == name;
        };
        if (std::ranges::any_of(type.radios, has_address)) return RobotId(i);
    }
    return std::nullopt;
}

Result<std::uint32_t> radio_number(const Model& model, RobotId robot, std::size_t sensor) {
    const RobotType& type = model.type_of(robot);
    const auto found = std::ranges::find(type.radios, static_cast<std::uint32_t>(sensor));
    if (found != type.radios.end()) return static_cast<std::uint32_t>(found - type.radios.begin());
    std::string radios;
    for (const std::uint32_t i : type.radios)
        radios += (radios.empty() ? "it has " : ", ") + type.sensors[i].spec.name;
    const std::string& name = model.robots[robot.index()].name;
    const std::string what = sensor < type.sensors.size()
                                 ? "sensor '" + type.sensors[sensor].spec.name + "' of robot '" + name + "'"
                                 : "sensor number " + std::to_string(sensor) + " of robot '" + name + "'";
    return Error{what + " is no radio", radios.empty() ? "the robot has no radio" : radios, "no-radio"};
}

}  // namespace roboss
