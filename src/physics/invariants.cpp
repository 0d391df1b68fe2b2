// See invariants.h.
#include "physics/invariants.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "model/joint_motion.h"
#include "physics/contact/surface_pair.h"
#include "physics/dynamics/robot_work.h"
#include "physics/dynamics/tree_factor.h"
#include "physics/soft/soft_solver.h"
#include "physics/solver/fast_accuracy.h"

namespace roboss {
namespace {

constexpr double kUnitError = 1e-9;  // of a quaternion's length

bool all_finite(std::span<const double> values) {
    return std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
}

bool is_unit(const std::vector<double>& q, std::size_t first) {
    double square = 0;
    for (std::size_t i = first; i < first + 4; ++i) square += q[i] * q[i];
    return std::fabs(square - 1) <= 2 * kUnitError;
}

auto key_of(const ContactMemory& m) {
    return std::tuple(m.other_robot, m.shape, m.other_shape, m.feature);
}

/// Of one state at a time; each returns what is wrong, or an empty string.
class StateCheck {
  public:
    StateCheck(const Model& model, std::span<const RobotState> states, double friction_error)
        : model_(model), states_(states), friction_error_(friction_error) {}

    std::string check(RobotId robot) {
        const RobotState& state = states_[robot.index()];
        const RobotType& type = type_in_use(robot);
        for (const auto part : {&StateCheck::check_coordinates, &StateCheck::check_mass_matrix,
                                &StateCheck::check_impulses, &StateCheck::check_rest})
            if (std::string wrong = (this->*part)(robot, type, state); !wrong.empty())
                return model_.robots[robot.index()].name + ": " + wrong;
        return {};
    }

  private:
    const RobotType& type_in_use(RobotId robot) const {
        return type_of(model_.type_of(robot), states_[robot.index()]);
    }

    std::string check_coordinates(RobotId, const RobotType& type, const RobotState& state) {
        if (state.q.size() != static_cast<std::size_t>(type.nq) ||
            state.v.size() != static_cast<std::size_t>(type.nv) || state.motors.size() != type.motor_count())
            return "the state has not the sizes of its type";
        if (!all_finite(state.q)) return "a coordinate is not finite";
        if (!all_finite(state.v)) return "a velocity is not finite";
        if (!is_unit(state.q, 3)) return "the base's quaternion has not unit length";
        for (const Body& body : type.bodies)
            if (joint_traits(body.joint).nq == 4 && !is_unit(state.q, static_cast<std::size_t>(body.q_index)))
                return "a joint's quaternion has not unit length";
        return {};
    }

    std::string check_mass_matrix(RobotId robot, const RobotType& type, const RobotState& state) {
        if (type.nv == 0) return {};
        copy_ = state;
        place_robot(model_, robot, copy_, work_);
        compute_inertias(type, work_);
        compute_mass_matrix<double>(type, model_.dt_s, work_);
        tree_factor(type.paths, work_.mass_matrix.data());
        for (std::size_t i = 0; i < type.paths.size(); ++i)  // the pivots' reciprocals
            if (const double pivot = 1 / work_.mass_matrix[type.paths.diagonal(i)]; !(pivot > 0))
                return "the mass matrix has pivot " + std::to_string(pivot) + " at " + std::to_string(i);
        return {};
    }

    std::string check_impulses(RobotId, const RobotType& type, const RobotState& state) {
        for (const MotorSetpoint& motor : state.motors)
            if (!std::isfinite(motor.impulse) || !(std::fabs(motor.load) <= std::fabs(motor.impulse)))
                return "a motor's warm-start impulse is " + std::to_string(motor.load) + " of " +
                       std::to_string(motor.impulse);
        const double most_load = is_fast(model_.accuracy) ? soft::kSubsteps : 1;  // of the impulse
        for (std::size_t i = 0; i < state.contacts.size(); ++i) {
            const ContactMemory& contact = state.contacts[i];
            if (i > 0 && key_of(state.contacts[i - 1]) >= key_of(contact)) return "contacts are not sorted";
            if (!(contact.impulse > 0) || !std::isfinite(contact.impulse))
                return "a contact's impulse is " + std::to_string(contact.impulse);
            if (!(contact.load >= 0 && contact.load <= most_load * contact.impulse))
                return "a contact's warm-start impulse is " + std::to_string(contact.load) + " of " +
                       std::to_string(contact.impulse);
            const double most = friction_coefficient(type, contact) * contact.impulse;
            if (const double friction = norm(contact.friction); friction - most > friction_error_ * most)
                return "friction " + std::to_string(friction) + " exceeds its bound " + std::to_string(most);
        }
        return {};
    }

    double friction_coefficient(const RobotType& type, const ContactMemory& contact) const {
        const Material& a = type.shapes[contact.shape].material;
        const Material& b =
            contact.other_robot == RobotId::kNone
                ? model_.statics[contact.other_shape].material
                : type_in_use(RobotId(contact.other_robot)).shapes[contact.other_shape].material;
        return std::max(std::min(a.mu, b.mu), std::min(a.mu2, b.mu2));
    }

    std::string check_rest(RobotId robot, const RobotType& type, const RobotState& state) {
        const Rest& rest = state.rest;
        if (!rest.asleep) return rest.neighbours.empty() ? "" : "it is awake and has neighbours of sleep";
        if (type.nv == 0) return "it sleeps, and cannot move";
        if (std::ranges::any_of(state.v, [](double x) { return x != 0; })) return "it sleeps, and moves";
        if (!state.wrenches.empty()) return "it sleeps under a wrench";
        if (rest.bound.empty() || !is_finite(rest.bound.min) || !is_finite(rest.bound.max))
            return "it sleeps without a bound";
        if (!std::ranges::is_sorted(rest.neighbours)) return "its neighbours are not sorted";
        for (const std::uint32_t id : rest.neighbours) {
            if (id >= states_.size() || id == robot.value)
                return "it has robot " + std::to_string(id) + " as neighbour";
            if (model_.type_of(RobotId(id)).nv > 0 && !states_[id].rest.asleep)
                return "it sleeps, and robot " + std::to_string(id) + ", which it touches, is awake";
        }
        return {};
    }

    const Model& model_;
    std::span<const RobotState> states_;
    double friction_error_;
    RobotState copy_;
    RobotWork work_;
};

}  // namespace

std::string check_invariants(const Model& model, std::span<const RobotState> states, double friction_error) {
    StateCheck check(model, states, friction_error);
    for (std::size_t i = 0; i < states.size(); ++i)
        if (std::string wrong = check.check(RobotId(i)); !wrong.empty()) return wrong;
    return {};
}

}  // namespace roboss
