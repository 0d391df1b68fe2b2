// The step of a few robots of one type in lanes; see lane_stepper.h. Included only by the translation units
// of the instruction sets.
#pragma once

#include <bit>
#include <vector>

#include "model/coordinates.h"
#include "physics/contact_rows.h"
#include "physics/dynamics.h"
#include "physics/joint_rows.h"
#include "physics/lane_contacts.h"
#include "physics/loads.h"
#include "physics/newton.h"
#include "physics/sleep.h"
#include "physics/tree_hessian.h"

namespace roboss {

template <class T>
class LaneStep final : public LaneStepper {
  public:
    std::size_t width() const override { return kLanesOf<T>; }

    unsigned step(const Model& model, std::span<const LaneRobot> robots, StepReport& report) override {
        Lockstep<T> together;
        gather(model, robots, together);
        place(model, robots, together);
        if (!together.any()) return 0;
        take_contacts(together);
        add_rows(model, together);
        solve(model, together);
        leave_the_free(together);
        advance_coordinates<T>(*work_.type, way_, model.dt_s, q_);
        leave_where(!finite(), together);
        for (std::size_t i = 0; i < robots.size(); ++i)
            if (is_in(together, i)) scatter(model, i, robots[i], report);
        return together.present();
    }

  private:
    using Mask = MaskOf<T>;

    static bool is_in(const Lockstep<T>& together, std::size_t lane) {
        return (together.present() >> lane & 1u) != 0;
    }

    static void leave_where(const Mask& m, Lockstep<T>& together) {
        const unsigned bits = LaneTraits<T>::bits(m);
        for (std::size_t lane = 0; lane < kLanesOf<T>; ++lane)
            if ((bits >> lane & 1u) != 0) together.leave(lane);
    }

    /// Coordinates, velocities and motors. Lanes without a robot, or with a motor in another mode than the
    /// first robot's, leave, but compute along with the first robot's values.
    void gather(const Model& model, std::span<const LaneRobot> robots, Lockstep<T>& together) {
        const RobotType& type = model.type_of(robots[0].id);
        const RobotState& first = *robots[0].state;
        work_.type = &type;
        q_.resize(first.q.size()), v_.resize(first.v.size()), motors_.resize(first.motors.size());
        for (std::size_t m = 0; m < motors_.size(); ++m) motors_[m].mode = first.motors[m].mode;
        for (std::size_t lane = 0; lane < kLanesOf<T>; ++lane) {
            const RobotState& state = lane < robots.size() ? *robots[lane].state : first;
            if (lane >= robots.size()) together.leave(lane);
            for (std::size_t i = 0; i < q_.size(); ++i) set_lane(q_[i], lane, state.q[i]);
            for (std::size_t i = 0; i < v_.size(); ++i) set_lane(v_[i], lane, state.v[i]);
            for (std::size_t m = 0; m < motors_.size(); ++m) {
                const MotorSetpoint& motor = state.motors[m];
                if (motor.mode != motors_[m].mode) together.leave(lane);
                set_lane(motors_[m].target, lane, motor.target);
                set_lane(motors_[m].max_effort, lane, motor.max_effort);
                set_lane(motors_[m].impulse, lane, motor.impulse);
                set_lane(motors_[m].load, lane, motor.load);
            }
        }
    }

    /// Bodies and shapes in lanes, contacts lane by lane. Who might fall asleep leaves.
    void place(const Model& model, std::span<const LaneRobot> robots, Lockstep<T>& together) {
        const RobotType& type = *work_.type;
        place_bodies<T>(type, q_, work_);
        move_bodies<T>(type, v_, work_);
        place_shapes<T>(type, model.dt_s, q_, work_);
        if (model.sleep) leave_where(work_.speed <= T(kRestSpeed), together);
        for (std::size_t lane = 0; lane < robots.size(); ++lane) {
            if (!is_in(together, lane)) continue;
            put_shapes(lane, found_.start(model, lane, robots[lane]));
            if (!found_.find(model, lane)) together.leave(lane);
        }
        const unsigned alike = found_.alike(together.present());
        for (std::size_t lane = 0; lane < kLanesOf<T>; ++lane)
            if ((alike >> lane & 1u) == 0) together.leave(lane);
    }

    void put_shapes(std::size_t i, ShapeWork* shapes) const {
        const auto vector = [&](const Vec3T<T>& x) { return Vec3{lane(x.x, i), lane(x.y, i), lane(x.z, i)}; };
        for (const ShapeWorkT<T>& from : work_.shapes) {
            ShapeWork& to = *shapes++;
            to.X_WS.R = {vector(from.X_WS.R.r0), vector(from.X_WS.R.r1), vector(from.X_WS.R.r2)};
            to.X_WS.p = vector(from.X_WS.p);
            to.box = {vector(from.box.min), vector(from.box.max)};
            to.margin = lane(from.margin, i);
        }
    }

    /// What all lanes have in common from the first of them, the rest lane by lane.
    void take_contacts(const Lockstep<T>& together) {
        const auto first = static_cast<std::size_t>(std::countr_zero(together.present()));
        contacts_.resize(found_.count(first));
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            const Contact& all = found_.contact(first, c);
            ContactT<T>& to = contacts_[c];
            to.body_a = all.body_a;
            to.mu = all.mu, to.restitution = all.restitution, to.bounce_threshold = all.bounce_threshold;
            to.stiffness = all.stiffness, to.damping = all.damping;
            to.slop = all.slop, to.mend_speed = all.mend_speed;
            for (std::size_t i = 0; i < kLanesOf<T>; ++i) {
                const Contact& from = found_.contact(is_in(together, i) ? i : first, c);
                set_lanes(to.p_W, i, from.p_W), set_lanes(to.normal, i, from.normal);
                set_lanes(to.friction, i, from.friction);
                set_lane(to.gap, i, from.gap);
                set_lane(to.impulse, i, from.impulse), set_lane(to.load, i, from.load);
            }
        }
    }

    static void set_lanes(Vec3T<T>& to, std::size_t i, const Vec3& from) {
        set_lane(to.x, i, from.x), set_lane(to.y, i, from.y), set_lane(to.z, i, from.z);
    }

    void add_rows(const Model& model, Lockstep<T>& together) {
        const RobotType& type = *work_.type;
        const JointStates<T> joints{q_, v_, motors_};
        rows_.clear();
        set_body_impulses(model, model.dt_s, 1.0, work_);
        sum_impulses<T>(model.dt_s, 1.0, q_, v_, work_);
        compute_mass_matrix(type, model.dt_s, work_);
        split_ = add_tree_rows(model, type, joints, 0, together, buffer_, rows_);
        for (const ContactT<T>& c : contacts_)
            split_ = split_ | add_contact_row<T>(model, c, {&work_, c.body_a, 0}, nullptr, rows_);
        free_ = true;
        for (std::size_t d = 0; d < type.dofs.size(); ++d)
            free_ = free_ & Mask(!is_stiff(type.dofs[d], model.dt_s)) &
                    is_left_alone(tree_axis(model, type, joints, d));
    }

    /// Velocities and way of the tick, and what motors and contacts gave.
    void solve(const Model& model, Lockstep<T>& together) {
        const Mechanics<T>* robot = &work_;
        const int offset = 0;
        SolveProblem<T> problem{model.accuracy, {&robot, 1}, {&offset, 1}, rows_};
        solution_ = v_;
        solved_ = {};
        newton_.start(problem, solution_);
        leave_where(!newton_.solve(problem, together, solution_, solved_), together);
        pushed_ = false;
        take_impulses();
        way_ = solution_;
        if (together.any() && together(split_)) solve_way(problem, together);
    }

    void take_impulses() {
        for (const JointRowT<T>& row : rows_.joints)
            if (row.motor != nullptr) remember_load(row.impulse, *row.motor);
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            take_impulse(rows_.contacts[c], contacts_[c]);
            pushed_ = pushed_ | (contacts_[c].impulse > T(0));
        }
    }

    void solve_way(SolveProblem<T> problem, Lockstep<T>& together) {
        problem.position = true;
        for (ContactRowT<T>& row : rows_.contacts) row.slip.bound = row.slip.coefficient * row.normal.impulse;
        way_ = v_;
        SolveReportT<T> report;
        newton_.start(problem, way_);
        leave_where(!newton_.solve(problem, together, way_, report), together);
        solved_.iterations += report.iterations;
        for (const ContactRowT<T>& row : rows_.contacts) pushed_ = pushed_ | (row.normal.impulse > T(0));
        leave_where(share_of_mending<T>(v_, solution_, way_) < T(1), together);
    }

    /// What nothing holds moves by the method for free motion.
    void leave_the_free(Lockstep<T>& together) { leave_where(free_ & !pushed_, together); }

    Mask finite() const {
        T sum = 0;
        for (const T& x : q_) sum += x - x;
        for (const T& x : solution_) sum += x - x;
        return equal(sum, T(0));
    }

    void scatter(const Model& model, std::size_t i, const LaneRobot& robot, StepReport& report) {
        RobotState& state = *robot.state;
        for (std::size_t k = 0; k < q_.size(); ++k) state.q[k] = lane(q_[k], i);
        for (std::size_t k = 0; k < v_.size(); ++k) state.v[k] = lane(solution_[k], i);
        for (std::size_t m = 0; m < motors_.size(); ++m) {
            state.motors[m].impulse = lane(motors_[m].impulse, i);
            state.motors[m].load = lane(motors_[m].load, i);
        }
        if (model.sleep) state.rest.still_ticks = 0;
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            Contact& to = found_.contact(i, c);
            const ContactT<T>& from = contacts_[c];
            to.impulse = lane(from.impulse, i), to.load = lane(from.load, i);
            to.friction = {lane(from.friction.x, i), lane(from.friction.y, i), lane(from.friction.z, i)};
        }
        found_.remember(model, i, report);
        *robot.bound = found_.box(i);
        report.iterations += static_cast<int>(lane(solved_.iterations, i));
        if (lane(solved_.residual, i) > report.residual) report.residual = lane(solved_.residual, i);
    }

    Mechanics<T> work_;
    std::vector<T> q_, v_, solution_, way_;
    std::vector<MotorSetpointT<T>> motors_;
    std::vector<ContactT<T>> contacts_;
    std::vector<BoundedRowT<T>> buffer_;
    IslandRowsT<T> rows_;
    Newton<T, TreeHessian<T>> newton_;
    SolveReportT<T> solved_;
    Mask split_{false}, free_{false}, pushed_{false};
    LaneContacts found_{kLanesOf<T>};
};

}  // namespace roboss
