// The states of a few robots of one type, gathered into lanes and scattered again. Doubles go as they are.
// Where the kernel computes in floats, what is stored stays in doubles beside it (core/wide.h): places count
// from each robot's base and angles from the nearest whole turn, so that a float tells them finely wherever
// the robot is, and what a tick changes is added to the doubles.
#pragma once

#include <vector>

#include "core/wide.h"
#include "model/coordinates.h"
#include "physics/dynamics/joint_rows.h"
#include "physics/lanes/lane_stepper.h"

namespace roboss {

template <class T>
class LaneState {
  public:
    using Wide = WideOf<T>;

    /// Coordinates, velocities and motors. Lanes without a robot, or with a motor in another mode than the
    /// first robot's, or with other own numbers, leave, but compute along with the first robot's values.
    void gather(const RobotType& type, std::span<const LaneRobot> robots, Lockstep<T>& together) {
        const RobotState& first = *robots[0].state;
        dofs_ = type.dofs;
        q_.resize(first.q.size()), v_.resize(first.v.size()), motors_.resize(first.motors.size());
        targets_.resize(motors_.size());
        for (std::size_t m = 0; m < motors_.size(); ++m) motors_[m].mode = first.motors[m].mode;
        for (std::size_t lane = 0; lane < kLanesOf<T>; ++lane) {
            if (lane >= robots.size() || robots[lane].state->own != first.own) together.leave(lane);
            take(lane, lane < robots.size() ? *robots[lane].state : first, together);
        }
        if constexpr (kIsFloat<T>)
            set_local(type);
        else
            for (std::size_t m = 0; m < motors_.size(); ++m) motors_[m].target = targets_[m];
    }

    const std::vector<Wide>& q() const { return q_; }
    const std::vector<Wide>& v() const { return v_; }
    /// What rows are made from. In floats, velocities that motors are to reach are relative to the present.
    JointStates<T> joints() {
        if constexpr (kIsFloat<T>)
            return {local_q_, local_v_, motors_, dofs_};
        else
            return {q_, v_, motors_, dofs_};
    }
    /// Coordinates go by `displacement`, velocities become `solution`, which is overwritten; in floats both
    /// are added to the velocities before.
    void advance(const RobotType& type, double dt, const std::vector<T>& displacement,
                 std::vector<T>& solution) {
        if constexpr (kIsFloat<T>) {
            wide_.resize(v_.size());
            for (std::size_t i = 0; i < v_.size(); ++i) wide_[i] = v_[i] + widen(displacement[i]);
            advance_coordinates<Wide>(type, wide_, dt, q_);
            for (std::size_t i = 0; i < v_.size(); ++i) v_[i] += widen(solution[i]);
        } else {
            advance_coordinates<T>(type, displacement, dt, q_);
            v_.swap(solution);
        }
    }

    /// Bit i: something in lane i is no number.
    unsigned not_finite() const {
        Wide sum = 0;
        for (const Wide& x : q_) sum += x - x;
        for (const Wide& x : v_) sum += x - x;
        return LaneTraits<Wide>::bits(!equal(sum, Wide(0)));
    }

    void scatter(std::size_t i, RobotState& state) const {
        for (std::size_t k = 0; k < q_.size(); ++k) state.q[k] = lane(q_[k], i);
        for (std::size_t k = 0; k < v_.size(); ++k) state.v[k] = lane(v_[k], i);
        for (std::size_t m = 0; m < motors_.size(); ++m) {
            state.motors[m].impulse = lane(motors_[m].impulse, i);
            state.motors[m].load = lane(motors_[m].load, i);
        }
    }

  private:
    void take(std::size_t lane, const RobotState& state, Lockstep<T>& together) {
        for (std::size_t i = 0; i < q_.size(); ++i) set_lane(q_[i], lane, state.q[i]);
        for (std::size_t i = 0; i < v_.size(); ++i) set_lane(v_[i], lane, state.v[i]);
        for (std::size_t m = 0; m < motors_.size(); ++m) {
            const MotorSetpoint& motor = state.motors[m];
            if (motor.mode != motors_[m].mode) together.leave(lane);
            set_lane(targets_[m], lane, motor.target);
            set_lane(motors_[m].max_effort, lane, motor.max_effort);
            set_lane(motors_[m].impulse, lane, motor.impulse);
            set_lane(motors_[m].load, lane, motor.load);
        }
    }

    void set_local(const RobotType& type) {
        local_q_.resize(q_.size()), local_v_.resize(v_.size());
        for (std::size_t i = 0; i < q_.size(); ++i) local_q_[i] = narrow<T>(q_[i]);
        for (std::size_t i = 0; i < v_.size(); ++i) local_v_[i] = narrow<T>(v_[i]);
        for (std::size_t d = 0; d < type.dofs.size(); ++d) set_motor(type, d);
    }

    void set_motor(const RobotType& type, std::size_t d) {
        const Dof& dof = dofs_[d];
        MotorSetpointT<T>& motor = motors_[d];
        Wide target = targets_[d];
        if (motor.mode == MotorMode::kVelocity) {
            const Wide most = dof.max_velocity;
            target = clamped(target, -most, most) - v_[d + static_cast<std::size_t>(type.base_nv())];
        }
        take_off_turns(type, d, target);
        motor.target = narrow<T>(target);
    }

    /// Whole turns of a joint that has no place of its own (limits, a spring), from its angle and from where
    /// it is to go.
    void take_off_turns(const RobotType& type, std::size_t d, Wide& target) {
        using std::floor;
        const Dof& dof = dofs_[d];
        const Body& body = type.bodies[static_cast<std::size_t>(dof.body)];
        if (!joint_traits(body.joint).is_periodic || dof.spring_stiffness != 0 || std::isfinite(dof.lower) ||
            std::isfinite(dof.upper))
            return;
        const auto i = static_cast<std::size_t>(body.q_index);
        const Wide turns = floor(q_[i] * Wide(0.5 / kPi) + Wide(0.5)) * Wide(2 * kPi);
        local_q_[i] = narrow<T>(q_[i] - turns);
        if (motors_[d].mode == MotorMode::kPosition) target -= turns;
    }

    std::vector<Wide> q_, v_, targets_, wide_;
    std::vector<T> local_q_, local_v_;
    std::vector<MotorSetpointT<T>> motors_;
    std::span<const Dof> dofs_;  // of the robots
};

}  // namespace roboss
