// See own_numbers.h.
#include "model/own_numbers.h"

#include <algorithm>
#include <utility>

#include "core/float_env.h"
#include "model/compile_type.h"
#include "model/robot_state.h"

namespace roboss {
namespace {

/// Renews all that follows from masses and rotor inertias, as compile() computes it.
void renew_masses(RobotType& type) {
    type.mass = 0;
    for (const Body& body : type.bodies) type.mass += body.mass;
    for (LinkDrag& drag : type.drags)
        if (drag.carried > 0) drag.carried = type.links[drag.link.index()].mass;
    for (LoopJoint& loop : type.loops) loop.inverse_mass = loop.inverse_inertia = 0;
    compute_mobility(type);
}

RobotType with_numbers(const RobotType& type, const OwnNumbers& own) {
    const ExactFloatScope exact;
    RobotType made = type;
    const bool rotors = put_numbers(own.joints, made), masses = put_numbers(own.links, made);
    if (rotors || masses) renew_masses(made);
    made.around = own.around;
    return made;
}

}  // namespace

OwnType::OwnType(const RobotType& type, const OwnNumbers& own)
    : type_(own.empty() ? nullptr : std::make_shared<const RobotType>(with_numbers(type, own))) {}

void OwnType::move_to(const RobotType& type, const OwnNumbers& own) {
    const auto is_alike = [](const BodyShape& a, const BodyShape& b) {
        return a.shape.hull == b.shape.hull && a.shape.surface == b.shape.surface;
    };
    if (type_ == nullptr || !std::ranges::equal(type_->shapes, type.shapes, is_alike))
        *this = OwnType(type, own);
}

void set_own(const RobotType& type, OwnNumbers own, RobotState& state) {
    if (own == state.own) return;
    state.own = std::move(own);
    state.own_type = OwnType(type, state.own);
}

}  // namespace roboss
