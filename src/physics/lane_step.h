// The step of a few robots of one type in lanes; see lane_stepper.h. Included only by the translation units
// of the instruction sets.
#pragma once

#include <bit>
#include <vector>

#include "geometry/plane_contacts.h"
#include "model/coordinates.h"
#include "physics/contact_rows.h"
#include "physics/dynamics.h"
#include "physics/joint_rows.h"
#include "physics/lane_contacts.h"
#include "physics/loads.h"
#include "physics/newton.h"
#include "physics/sleep.h"
#include "physics/surface_pair.h"
#include "physics/tree_hessian.h"
#include "physics/velocity_forces.h"

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

    /// Bit i: lane i leaves.
    static void leave(unsigned bits, Lockstep<T>& together) {
        for (std::size_t lane = 0; lane < kLanesOf<T>; ++lane)
            if ((bits >> lane & 1u) != 0) together.leave(lane);
    }
    static void leave_where(const Mask& m, Lockstep<T>& together) { leave(LaneTraits<T>::bits(m), together); }

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

    /// Bodies and shapes in lanes, contacts lane by lane. Who might fall asleep or turns far leaves. All
    /// robots come with contacts, or none.
    void place(const Model& model, std::span<const LaneRobot> robots, Lockstep<T>& together) {
        const RobotType& type = *work_.type;
        place_bodies<T>(type, q_, work_);
        move_bodies<T>(type, v_, work_);
        leave_where(turns_far(work_, model.dt_s), together);
        const bool has_contacts = robots[0].has_contacts;
        if (model.sleep || !has_contacts) place_shapes<T>(type, model.dt_s, q_, work_);
        if (model.sleep) leave_where(work_.speed <= T(kRestSpeed), together);
        if (!has_contacts) leave_where(!is_finite(work_), together);
        on_plane_ = !has_contacts && find_on_plane(model, robots, together);
        if (on_plane_) return;
        for (std::size_t lane = 0; lane < robots.size(); ++lane) {
            if (!is_in(together, lane)) continue;
            if (has_contacts) {
                found_.take(lane, robots[lane].contacts);
            } else {
                put_shapes(lane, found_.start(model, lane, robots[lane], box_of(lane)));
                found_.find(model, lane);
            }
        }
        leave(~found_.alike(together.present()), together);
    }

    /// Whether everything that contacts are found from is a number.
    static Mask is_finite(const Mechanics<T>& work) {
        T sum =
            work.origin.x - work.origin.x + (work.origin.y - work.origin.y) + (work.origin.z - work.origin.z);
        for (const ShapeWorkT<T>& shape : work.shapes) sum += shape.margin - shape.margin;
        return equal(sum, T(0));
    }

    /// Where one plane is all that is near, the narrow phase itself goes in lanes. False if it cannot.
    bool find_on_plane(const Model& model, std::span<const LaneRobot> robots, Lockstep<T>& together) {
        std::optional<std::uint32_t> plane;
        for (std::size_t i = 0; i < robots.size(); ++i) {
            if (!is_in(together, i)) continue;
            const auto found = found_.only_plane(model, box_of(i));
            if (!found || (plane && *plane != *found)) return false;
            plane = found;
        }
        if (!plane) return false;
        contacts_.clear();
        for (std::size_t s = 0; s < work_.shapes.size(); ++s)
            if (work_.type->shapes[s].body >= 0 && !add_on_plane(model, s, *plane, together)) return false;
        for (std::size_t i = 0; i < robots.size(); ++i)
            if (is_in(together, i)) recall(i, *robots[i].state);
        return true;
    }

    bool add_on_plane(const Model& model, std::size_t s, std::uint32_t plane, Lockstep<T>& together) {
        const BodyShape& shape = work_.type->shapes[s];
        const StaticShape& scenery = model.statics[plane];
        if (!may_collide(shape.material, scenery.material)) return true;
        const Vec3 n = scenery.X_WS.R.col(2);
        PlaneContacts<T> points(scenery.X_WS.p, n, work_.shapes[s].margin, together);
        const std::optional<Contact> surface = found_.plain_surface(model, shape, plane);
        if (!surface || !points.add(shape.shape, work_.shapes[s].X_WS)) return false;
        for (std::size_t i = 0; i < points.count(); ++i) {
            if (i > 0 && points[i].feature < points[i - 1].feature) return false;  // they would be sorted
            ContactT<T>& c = contacts_.emplace_back();
            c.shape_a = static_cast<std::uint32_t>(s), c.shape_b = plane, c.feature = points[i].feature;
            c.body_a = shape.body;
            set_surface(*surface, c);
            c.p_W = points[i].p_W, c.gap = points[i].gap, c.normal = broadcast<T>(n);
        }
        return true;
    }

    /// What the last tick remembers of the contacts; both sorted.
    void recall(std::size_t i, const RobotState& state) {
        const auto key = [](std::uint32_t shape, std::uint32_t other, std::uint32_t feature) {
            return std::array{shape, other, feature};
        };
        auto m = state.contacts.begin();
        const auto is_before = [&](const ContactT<T>& c) {
            return m->other_robot != RobotId::kNone ||
                   key(m->shape, m->other_shape, m->feature) < key(c.shape_a, c.shape_b, c.feature);
        };
        for (ContactT<T>& c : contacts_) {
            while (m != state.contacts.end() && is_before(c)) ++m;
            if (m == state.contacts.end()) return;
            if (key(m->shape, m->other_shape, m->feature) != key(c.shape_a, c.shape_b, c.feature)) continue;
            set_lane(c.impulse, i, m->impulse), set_lane(c.load, i, m->load);
            set_lanes(c.friction, i, m->friction);
        }
    }

    static Vec3 vector_of(const Vec3T<T>& x, std::size_t i) {
        return {lane(x.x, i), lane(x.y, i), lane(x.z, i)};
    }
    static Aabb box_of(const AabbT<T>& box, std::size_t i) {
        return {vector_of(box.min, i), vector_of(box.max, i)};
    }
    Aabb box_of(std::size_t i) const { return box_of(work_.box, i); }

    static void set_surface(const Contact& from, ContactT<T>& to) {
        to.mu = from.mu, to.restitution = from.restitution, to.bounce_threshold = from.bounce_threshold;
        to.stiffness = from.stiffness, to.damping = from.damping;
        to.slop = from.slop, to.mend_speed = from.mend_speed;
    }

    void put_shapes(std::size_t i, ShapeWork* shapes) const {
        for (const ShapeWorkT<T>& from : work_.shapes) {
            ShapeWork& to = *shapes++;
            const Mat3T<T>& R = from.X_WS.R;
            to.X_WS = {{vector_of(R.r0, i), vector_of(R.r1, i), vector_of(R.r2, i)},
                       vector_of(from.X_WS.p, i)};
            to.box = box_of(from.box, i);
            to.margin = lane(from.margin, i);
        }
    }

    /// What all lanes have in common from the first of them, the rest lane by lane.
    void take_contacts(const Lockstep<T>& together) {
        if (on_plane_) return;
        const auto first = static_cast<std::size_t>(std::countr_zero(together.present()));
        contacts_.resize(found_.count(first));
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            const Contact& all = found_.contact(first, c);
            ContactT<T>& to = contacts_[c];
            to.body_a = all.body_a;
            set_surface(all, to);
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
        if (on_plane_)
            remember_on_plane(i, robot, report);
        else
            scatter_contacts(i);
        if (!robot.has_contacts) *robot.bound = box_of(i);
        if (!robot.has_contacts && !on_plane_) found_.remember(model, i, report);
        report.iterations += static_cast<int>(lane(solved_.iterations, i));
        if (lane(solved_.residual, i) > report.residual) report.residual = lane(solved_.residual, i);
    }

    void scatter_contacts(std::size_t i) {
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            Contact& to = found_.contact(i, c);
            const ContactT<T>& from = contacts_[c];
            to.impulse = lane(from.impulse, i), to.load = lane(from.load, i);
            to.friction = vector_of(from.friction, i);
        }
    }

    void remember_on_plane(std::size_t i, const LaneRobot& robot, StepReport& report) {
        found_.clear_memory();
        for (const ContactT<T>& c : contacts_) {
            const double impulse = lane(c.impulse, i);
            if (impulse <= 0) continue;
            found_.add_memory({RobotId::kNone, c.shape_a, c.shape_b, c.feature, impulse, lane(c.load, i),
                               vector_of(c.friction, i)});
        }
        report.contacts += found_.remember(*robot.state);
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
    bool on_plane_ = false;  // contacts_ are not from found_
};

}  // namespace roboss
