// See lane_stepper.h.
#include "physics/lanes/lane_stepper.h"

#include <algorithm>

#include "physics/contact/island_guard.h"
#include "physics/dynamics/fast_turning.h"
#include "physics/dynamics/lone_body.h"
#include "physics/lanes/lane_contacts.h"

namespace roboss {
namespace {

/// Nothing pushes it that lanes do not know.
bool is_plain(const RobotType& type, const RobotState& state) {
    return !type.has_equalities() && type.drags.empty() && !type.feels_flow && !type.has_slip &&
           type.self_pairs.empty() && type.shape_groups.crowds.empty() && state.wrenches.empty() &&
           state.bonds.empty() && state.surfaces.empty();
}

}  // namespace

LaneStepper::~LaneStepper() = default;

bool fits_lanes(const RobotType& type, const RobotState& state) {
    return type.nv > 0 && !is_free_body(type) && is_plain(type, state) && is_driven<double>(state.motors);
}

bool rests_in_lanes(const Model& model, const RobotType& type, const RobotState& state) {
    if (!is_free_body(type) || state.contacts.empty() || !is_plain(type, state)) return false;
    if (model.sleep && state.rest.still_ticks > 0) return false;
    const bool on_plain_ground = std::ranges::all_of(state.contacts, [&](const ContactMemory& c) {
        return c.other_robot == RobotId::kNone && c.other_shape < model.statics.size() &&
               c.shape < type.shapes.size() &&
               LaneContacts::is_plain(model, type.shapes[c.shape], c.other_shape);
    });
    if (!on_plain_ground) return false;
    const Vec3 turn = Vec3{state.v[0], state.v[1], state.v[2]} * model.dt_s;
    return norm_squared(turn) <= kSlowTurn * kSlowTurn;
}

bool LaneSteppers::take(const Model& model, const RobotType& type, const RobotState& state) const {
    if (lanes == nullptr) return false;
    // Lanes compute with the numbers of one type, so a robot with own numbers of joints or links is stepped
    // by itself. Those with own gravity or wind share lanes with robots that have the same. In floats each
    // robot has a try by itself behind the lanes.
    const bool differs = !state.own.joints.empty() || !state.own.links.empty();
    if (!in_floats() && differs) return false;
    return fits_lanes(type, state) || (!in_floats() && rests_in_lanes(model, type, state));
}

std::unique_ptr<LaneStepper> make_lane_stepper(Precision precision, std::size_t most) {
    const bool floats = precision == Precision::kFloat;
    if (floats) most /= 2;  // twice as many fill a register
#if defined(__x86_64__)
    if (most >= 8 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        if (auto stepper = make_avx512_stepper(precision)) return stepper;
    if (most >= 4 && __builtin_cpu_supports("avx2"))
        if (auto stepper = make_avx2_stepper(precision)) return stepper;
#elif defined(__aarch64__)
    if (most >= 8) return make_neon8_stepper(precision);
    if (most >= 4) return make_neon4_stepper(precision);
    if (most >= 2) return make_neon2_stepper(precision);
#endif
    return floats ? make_single_stepper() : nullptr;
}

}  // namespace roboss
