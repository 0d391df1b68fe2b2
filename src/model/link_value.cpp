// See link_value.h.
#include "model/link_value.h"

#include "model/robot_state.h"

namespace roboss {

std::optional<double> link_value(const RobotType& type, const RobotState& state, LinkId link,
                                 LinkParameter parameter) {
    for (const OwnLinkNumber& one : state.own.links)
        if (one.link == link && one.number.parameter == parameter) return one.number.value;
    return link_number(is_inertia(parameter) ? type_of(type, state) : type, link, parameter);
}

}  // namespace roboss
