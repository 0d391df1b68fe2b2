// The step of a few robots of one type in lanes; see lane_stepper.h. Included only by the translation units
// of the instruction sets, and by that of one robot in floats. Where T is floats, what has a place in the
// world is found in doubles (Wide) all the same: decision 0014.
#pragma once

#include <bit>
#include <vector>

#include "geometry/plane_contacts.h"
#include "physics/contact/contact_rows.h"
#include "physics/contact/even_motion.h"
#include "physics/contact/island_guard.h"
#include "physics/contact/turns_far.h"
#include "physics/dynamics/dynamics.h"
#include "physics/dynamics/fast_turning.h"
#include "physics/dynamics/joint_rows.h"
#include "physics/dynamics/lone_body.h"
#include "physics/dynamics/warm_start.h"
#include "physics/lanes/lane_contacts.h"
#include "physics/lanes/lane_state.h"
#include "physics/sleep.h"
#include "physics/solver/newton.h"
#include "physics/solver/tree_hessian.h"
#include "physics/tick.h"

namespace roboss {

template <class T>
class LaneStep final : public LaneStepper {
  public:
    std::size_t width() const override { return kLanesOf<T>; }

    unsigned step(const Model& model, std::span<const LaneRobot> robots, StepReport& report,
                  StageClock& clock) override {
        Batch batch{*this, model, robots, report, clock.is_on()};
        return step_robots(batch, clock) ? batch.together.present() : 0;
    }

    void find_bounds(const Model& model, std::span<const LaneRobot> robots) override {
        Lockstep<T> together;
        place_bodies(model, robots, together);
        place_shapes<Wide>(*work_.type, model.dt_s, placed());
        for (std::size_t i = 0; i < robots.size(); ++i) *robots[i].bound = box_of(i);
    }

  private:
    using Mask = MaskOf<T>;
    using Wide = WideOf<T>;

    /// The stages of a batch, called by step_robots (tick.h) in this order. Its robots touch no others and do
    /// not sleep, and all lanes are one contact island. `together`: the lanes that are still in.
    struct Batch {
        LaneStep& kernel;
        const Model& model;
        std::span<const LaneRobot> robots;
        StepReport& result;
        bool is_profiled = false;
        Lockstep<T> together{};

        bool forward_kinematics() { return kernel.place(model, robots, together); }
        void wake_left_sleepers() {}
        void form_bonds() {}
        void find_pairs() {}
        void wake_touched_sleepers() {}
        void hold_bonds() {}
        bool find_contacts() { return kernel.find_contacts(model, robots, together); }
        void build_contact_islands() {}
        template <class StepIsland>
        void for_each_contact_island(StepIsland&& step, StageClock& clock) {
            step(*this, clock);
        }
        bool has_rows() const { return true; }
        void build_rows() { kernel.add_rows(model, together); }
        void solve_velocities() {
            kernel.solve(model, together);
            if (is_profiled) kernel.friction_error_ = friction::bound_error(kernel.rows_);
        }
        void solve_displacements() { kernel.find_displacement(model, together); }
        void integrate() { kernel.integrate(model, together); }
        void guard() {}         // whose energy or momentum is guarded has left
        void put_to_sleep() {}  // who is slow enough has left
        void report() {
            kernel.scatter(model, robots, together, result);
            if (is_profiled) kernel.profile(model, together, result.profile.solver);
        }
    };

    static bool is_in(const Lockstep<T>& together, std::size_t lane) {
        return (together.present() >> lane & 1u) != 0;
    }

    /// Bit i: lane i leaves.
    static void leave(unsigned bits, Lockstep<T>& together) {
        for (std::size_t lane = 0; lane < kLanesOf<T>; ++lane)
            if ((bits >> lane & 1u) != 0) together.leave(lane);
    }
    static void leave_where(const Mask& m, Lockstep<T>& together) { leave(LaneTraits<T>::bits(m), together); }
    template <class Other>
    static void leave_where(const Other& m, Lockstep<T>& together) {
        leave(LaneTraits<Wide>::bits(m), together);
    }

    void place_bodies(const Model& model, std::span<const LaneRobot> robots, Lockstep<T>& together) {
        const RobotType& type = type_of(model.type_of(robots[0].id), *robots[0].state);
        work_.type = &type;
        state_.gather(type, robots, together);
        placed().type = &type;
        forward_kinematics<Wide>(type, state_.q(), placed());
        forward_velocities<Wide>(type, state_.v(), placed());
    }

    /// Bodies and shapes in lanes. What might fall asleep or turns fast leaves; false if all do.
    bool place(const Model& model, std::span<const LaneRobot> robots, Lockstep<T>& together) {
        place_bodies(model, robots, together);
        const RobotType& type = *work_.type;
        leave_where(turns_fast<Wide>(placed(), model.dt_s), together);
        const bool has_contacts = robots[0].has_contacts;
        if (model.sleep || !has_contacts) place_shapes<Wide>(type, model.dt_s, placed());
        if (model.sleep) leave_where(placed().speed <= Wide(kRestSpeed), together);
        if (!has_contacts) leave_where(!is_finite(placed()), together);
        return together.any();
    }

    /// On one plane in lanes, else lane by lane, then gathered. All robots come with contacts, or none.
    bool find_contacts(const Model& model, std::span<const LaneRobot> robots, Lockstep<T>& together) {
        const bool has_contacts = robots[0].has_contacts;
        on_plane_ = !has_contacts && find_on_plane(model, robots, together);
        if (on_plane_) return together.any();
        for (std::size_t lane = 0; lane < robots.size(); ++lane) {
            if (!is_in(together, lane)) continue;
            if (has_contacts) {
                found_.take(lane, robots[lane].contacts);
            } else {
                put_placed(lane, found_.start(model, lane, robots[lane], box_of(lane)));
                if (!found_.find(model, lane)) together.leave(lane);
            }
        }
        leave(~found_.alike(model, *work_.type, together.present()), together);
        if (!together.any()) return false;
        take_contacts(model, together);
        return true;
    }

    /// Poses and velocities, in doubles.
    Mechanics<Wide>& placed() {
        if constexpr (kIsFloat<T>)
            return placed_;
        else
            return work_;
    }
    const Mechanics<Wide>& placed() const {
        if constexpr (kIsFloat<T>)
            return placed_;
        else
            return work_;
    }

    /// Whether everything that contacts are found from is a number.
    static MaskOf<Wide> is_finite(const Mechanics<Wide>& work) {
        Wide sum =
            work.origin.x - work.origin.x + (work.origin.y - work.origin.y) + (work.origin.z - work.origin.z);
        for (const ShapeWorkT<Wide>& shape : work.shapes) sum += shape.margin - shape.margin;
        return equal(sum, Wide(0));
    }

    /// Where one plane is all that is near, or nothing, the narrow phase itself goes in lanes. False if it
    /// cannot.
    bool find_on_plane(const Model& model, std::span<const LaneRobot> robots, Lockstep<T>& together) {
        std::optional<std::uint32_t> plane;
        for (std::size_t i = 0; i < robots.size(); ++i) {
            if (!is_in(together, i)) continue;
            const auto found = found_.only_plane(model, box_of(i));
            if (!found || (plane && *plane != *found)) return false;
            plane = found;
        }
        if (!plane) return false;
        contacts_.clear(), surfaces_.clear(), velocities_.clear();
        if (*plane == LaneContacts::kNothing) return true;
        Lockstep<Wide> finders(together.present());
        for (std::size_t s = 0; s < placed().shapes.size(); ++s)
            if (work_.type->shapes[s].body >= 0 && !add_on_plane(model, s, *plane, finders)) return false;
        leave(~finders.present(), together);
        for (std::size_t i = 0; i < robots.size(); ++i)
            if (is_in(together, i)) recall(i, *robots[i].state);
        return true;
    }

    bool add_on_plane(const Model& model, std::size_t s, std::uint32_t plane, Lockstep<Wide>& finders) {
        const BodyShape& shape = work_.type->shapes[s];
        const StaticShape& scenery = model.statics[plane];
        if (!may_collide(shape.material, scenery.material)) return true;
        const Vec3 n = scenery.X_WS.R.col(2);
        PlaneContacts<Wide> points(scenery.X_WS.p, n, placed().shapes[s].margin, finders);
        if (!found_.is_plain(model, shape, plane) || !found_.keeps_all_points(model, shape, plane))
            return false;
        if (!points.add(shape.shape, placed().shapes[s].X_WS)) return false;
        const SurfacePair surface = found_.plain_surface(model, shape, plane);
        for (std::size_t i = 0; i < points.count(); ++i) {
            if (i > 0 && points[i].feature < points[i - 1].feature) return false;  // they would be sorted
            ContactT<T>& c = contacts_.emplace_back();
            c.shape_a = static_cast<std::uint32_t>(s), c.shape_b = plane, c.feature = points[i].feature;
            c.body_a = shape.body;
            surfaces_.push_back(surface);
            c.gap = kernel(points[i].gap), c.normal = broadcast<T>(n);
            put_point(points[i].p_W, c);
        }
        return true;
    }

    /// Where the contact is; floats count from the base, and want to know how fast the point is.
    void put_point(const Vec3T<Wide>& p_W, ContactT<T>& c) {
        if constexpr (kIsFloat<T>) {
            const Vec3T<Wide> p = p_W - placed_.origin;
            const SpatialT<Wide>& v = placed_.bodies[static_cast<std::size_t>(c.body_a)].velocity;
            c.p_W = kernel(p);
            velocities_.push_back(kernel(v.linear + cross(v.angular, p)));
        } else {
            c.p_W = p_W;
        }
    }

    /// As a number of the kernel's.
    static T kernel(const Wide& x) {
        if constexpr (kIsFloat<T>)
            return narrow<T>(x);
        else
            return x;
    }
    static Vec3T<T> kernel(const Vec3T<Wide>& x) { return {kernel(x.x), kernel(x.y), kernel(x.z)}; }
    static SpatialT<T> kernel(const SpatialT<Wide>& x) { return {kernel(x.angular), kernel(x.linear)}; }

    /// What the last tick remembers of the contacts; both sorted, and mostly the same.
    void recall(std::size_t i, const RobotState& state) {
        const auto is_of = [](const ContactMemory& m, const ContactT<T>& c) {
            return m.other_robot == RobotId::kNone && m.shape == c.shape_a && m.other_shape == c.shape_b &&
                   m.feature == c.feature;
        };
        const auto is_before = [](const ContactMemory& m, const ContactT<T>& c) {
            return m.other_robot != RobotId::kNone || std::array{m.shape, m.other_shape, m.feature} <
                                                          std::array{c.shape_a, c.shape_b, c.feature};
        };
        const ContactMemory *m = state.contacts.data(), *end = m + state.contacts.size();
        for (ContactT<T>& c : contacts_) {
            if (m != end && !is_of(*m, c))
                while (m != end && is_before(*m, c)) ++m;
            if (m == end) return;
            if (!is_of(*m, c)) continue;
            set_lane(c.impulse, i, m->impulse), set_lane(c.load, i, m->load);
            set_lanes(c.friction, i, m->friction);
            ++m;
        }
    }

    template <class Number>
    static Vec3 vector_of(const Vec3T<Number>& x, std::size_t i) {
        return {lane(x.x, i), lane(x.y, i), lane(x.z, i)};
    }
    static Aabb box_of(const AabbT<Wide>& box, std::size_t i) {
        return {vector_of(box.min, i), vector_of(box.max, i)};
    }
    Aabb box_of(std::size_t i) const { return box_of(placed().box, i); }

    static Transform transform_of(const TransformT<Wide>& X, std::size_t i) {
        return {{vector_of(X.R.r0, i), vector_of(X.R.r1, i), vector_of(X.R.r2, i)}, vector_of(X.p, i)};
    }
    static Spatial spatial_of(const SpatialT<Wide>& x, std::size_t i) {
        return {vector_of(x.angular, i), vector_of(x.linear, i)};
    }
    /// What contacts are found from.
    void put_placed(std::size_t i, RobotWork& work) const {
        work.origin = vector_of(placed().origin, i);
        for (std::size_t b = 0; b < work.bodies.size(); ++b) {
            const BodyWorkT<Wide>& from = placed().bodies[b];
            BodyWork& to = work.bodies[b];
            to.X_WB = transform_of(from.X_WB, i);
            to.velocity = spatial_of(from.velocity, i), to.bias = spatial_of(from.bias, i);
        }
        for (std::size_t s = 0; s < work.shapes.size(); ++s) {
            const ShapeWorkT<Wide>& from = placed().shapes[s];
            ShapeWork& to = work.shapes[s];
            to.X_WS = transform_of(from.X_WS, i);
            to.box = box_of(from.box, i);
            to.margin = lane(from.margin, i);
        }
    }

    /// What all lanes have in common from the first of them, the rest lane by lane.
    void take_contacts(const Model& model, const Lockstep<T>& together) {
        const auto first = static_cast<std::size_t>(std::countr_zero(together.present()));
        contacts_.resize(found_.count(first)), surfaces_.clear(), velocities_.clear();
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            const Contact& all = found_.contact(first, c);
            contacts_[c].body_a = all.body_a;
            surfaces_.push_back(found_.plain_surface(model, work_.type->shapes[all.shape_a], all.shape_b));
            for (std::size_t i = 0; i < kLanesOf<T>; ++i) {
                const Contact& from = found_.contact(is_in(together, i) ? i : first, c);
                set_lanes(point_, i, from.p_W);
                take_contact(i, from, contacts_[c]);
            }
            put_point(point_, contacts_[c]);
        }
    }

    /// All but the point.
    static void take_contact(std::size_t i, const Contact& from, ContactT<T>& to) {
        set_lanes(to.normal, i, from.normal), set_lanes(to.friction, i, from.friction);
        set_lane(to.gap, i, from.gap);
        set_lane(to.impulse, i, from.impulse), set_lane(to.load, i, from.load);
    }

    template <class Number>
    static void set_lanes(Vec3T<Number>& to, std::size_t i, const Vec3& from) {
        set_lane(to.x, i, from.x), set_lane(to.y, i, from.y), set_lane(to.z, i, from.z);
    }

    void add_rows(const Model& model, Lockstep<T>& together) {
        const RobotType& type = *work_.type;
        const JointStates<T> joints = state_.joints();
        if constexpr (kIsFloat<T>) take_placed();
        constexpr double kMomentum = kIsFloat<T> ? 0.0 : 1.0;  // of floats, only what the tick changes
        rows_.clear();
        set_body_impulses(gravity_of(model, type), model.dt_s, kMomentum, work_);
        sum_impulses<T>(model.dt_s, kMomentum, joints.q, joints.v, work_);
        if constexpr (kIsFloat<T>) take_off_damping<T>(model.dt_s, joints.v, work_);
        compute_mass_matrix(type, model.dt_s, work_);
        split_ = add_tree_rows(model, type, joints, 0, together, rows_.joints);
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            const ContactT<T>& contact = contacts_[c];
            split_ = split_ | add_contact_row<T>(model, contact, surfaces_[c], {&work_, contact.body_a, 0},
                                                 nullptr, rows_);
            if constexpr (kIsFloat<T>)
                count_from(velocities_[c], frame_of(contact.normal, surfaces_[c].friction),
                           rows_.contacts.back());
        }
        free_ = true;
        for (std::size_t d = 0; d < type.dofs.size(); ++d)
            free_ = free_ & Mask(!is_stiff(joints.dofs[d], model.dt_s)) &
                    is_left_alone(tree_axis(model, type, joints, d));
    }

    /// Floats: what the solver needs of the poses and velocities.
    void take_placed() {
        work_.origin = {};
        work_.bodies.resize(placed_.bodies.size()), work_.axes.resize(placed_.axes.size());
        for (std::size_t b = 0; b < placed_.bodies.size(); ++b) {
            const BodyWorkT<Wide>& from = placed_.bodies[b];
            BodyWorkT<T>& to = work_.bodies[b];
            const Mat3T<Wide>& R = from.X_WB.R;
            to.X_WB = {{kernel(R.r0), kernel(R.r1), kernel(R.r2)}, kernel(from.X_WB.p - placed_.origin)};
            to.centre = kernel(from.centre);
            to.velocity = kernel(from.velocity), to.bias = kernel(from.bias);
        }
        for (std::size_t k = 0; k < placed_.axes.size(); ++k) work_.axes[k] = kernel(placed_.axes[k]);
    }

    /// Floats: targets of a contact relative to the velocity of its point before the tick.
    static void count_from(const Vec3T<T>& velocity, const ContactFrameT<T>& frame, ContactRowT<T>& row) {
        const T normal = dot(frame.n, velocity);
        row.normal.target -= normal, row.normal.position_target -= normal;
        row.slip.target_1 -= dot(frame.t1, velocity), row.slip.target_2 -= dot(frame.t2, velocity);
    }

    SolveProblem<T> problem(const Model& model) {
        return {model.accuracy, {&robot_, 1}, {&kOffset, 1}, rows_};
    }

    /// Velocities of the tick, and what motors and contacts gave.
    void solve(const Model& model, Lockstep<T>& together) {
        const SolveProblem<T> problem = this->problem(model);
        if constexpr (kIsFloat<T>)  // what the tick changes of the velocities
            solution_.assign(state_.v().size(), T(0));
        else
            solution_ = state_.v();
        solved_ = {};
        if (has_free_bodies()) leave_where(!newton::have_one_normal<T>(rows_), together);
        newton_.start(problem, solution_);
        leave_where(!newton_.solve(problem, together, solution_, solved_), together);
        if (has_free_bodies()) leave_where(!newton::meets_tolerances(problem, solved_.residual), together);
        pushed_ = false;
        take_impulses();
        leave_isolated_robots(together);
        if (has_free_bodies()) leave_guarded(model, together);
    }

    bool has_free_bodies() const { return is_free_body(*work_.type); }

    /// Free bodies whose energy is guarded (island_guard.h).
    void leave_guarded(const Model& model, Lockstep<T>& together) {
        const Vec3T<Wide>& turning = placed().bodies[0].velocity.angular;
        leave_where(norm_squared(turning) * Wide(model.dt_s) * Wide(model.dt_s) > Wide(kSlowTurn * kSlowTurn),
                    together);
        for (const ContactRowT<T>& row : rows_.contacts) leave_where(throws_back<T>(row), together);
    }

    void find_displacement(const Model& model, Lockstep<T>& together) {
        displacement_ = solution_;
        displaced_ = together.any() && together(split_);
        if (displaced_)
            solve_displacement(problem(model), together);
        else if (has_free_bodies())
            take_mean_displacement(model.dt_s);
        leave_free_robots(together);
        leave_far_turning_robots(model, together);
    }

    /// As contact_island.cpp.
    void take_mean_displacement(double dt) {
        const std::span<const T> before = state_.joints().v;
        const Mask even = hardly_turns<T>(before) & hardly_turns<T>(solution_) &
                          contacts_are_steady<T>(rows_, before, solution_, dt);
        for (std::size_t i = 0; i < solution_.size(); ++i)
            displacement_[i] = select(even, T(0.5) * (before[i] + solution_[i]), solution_[i]);
    }

    void integrate(const Model& model, Lockstep<T>& together) {
        state_.advance(*work_.type, model.dt_s, displacement_, solution_);
        leave(state_.not_finite(), together);
    }

    void take_impulses() {
        for (const JointRowT<T>& row : rows_.joints)
            if (row.motor != nullptr) store_warm_start(row.impulse, *row.motor);
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            take_impulse(rows_.contacts[c], surfaces_[c].friction, contacts_[c]);
            pushed_ = pushed_ | (contacts_[c].impulse > T(0));
        }
    }

    void solve_displacement(SolveProblem<T> problem, Lockstep<T>& together) {
        problem.position = true;
        for (ContactRowT<T>& row : rows_.contacts) turn_to_displacement(row);
        SolveReportT<T> report;
        newton_.start(problem, displacement_);
        leave_where(!newton_.solve(problem, together, displacement_, report), together);
        if (has_free_bodies()) leave_where(!newton::meets_tolerances(problem, report.residual), together);
        solved_.iterations += report.iterations;
        for (const ContactRowT<T>& row : rows_.contacts) pushed_ = pushed_ | (row.normal.impulse > T(0));
        leave_where(corrects_too_fast(), together);
    }

    Mask corrects_too_fast() {
        const std::span<const T> before = state_.joints().v;
        if constexpr (!kIsFloat<T>) return share_of_correction<T>(before, solution_, displacement_) < T(1);
        whole_solution_ = solution_, whole_displacement_ = displacement_;
        for (std::size_t i = 0; i < displacement_.size(); ++i)
            whole_solution_[i] += before[i], whole_displacement_[i] += before[i];
        return share_of_correction<T>(before, whole_solution_, whole_displacement_) < T(1);
    }

    /// What moves freely and nothing pushes keeps its momentum: it takes the kick-drift step
    /// (contact_island.cpp).
    void leave_isolated_robots(Lockstep<T>& together) {
        if (work_.type->free_base) leave_where(!pushed_, together);
    }

    /// What nothing holds moves by the method for free motion.
    void leave_free_robots(Lockstep<T>& together) { leave_where(free_ & !pushed_, together); }

    /// Contacts of bodies that turn far get a second look, one by one.
    void leave_far_turning_robots(const Model& model, Lockstep<T>& together) {
        if (on_plane_ || !together.any()) return;
        const auto first = static_cast<std::size_t>(std::countr_zero(together.present()));
        bool is_known = false;
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            const Contact& contact = found_.contact(first, c);
            if (model.statics[contact.shape_b].shape.kind == ShapeKind::kPlane) continue;
            if (!is_known) turn_bodies();
            is_known = true;
            const BodyShape& shape = work_.type->shapes[contact.shape_a];
            const auto body = static_cast<std::size_t>(shape.body);
            const Mat3T<T> R = work_.bodies[body].X_WB.R * broadcast<T>(shape.X_BS.R);
            leave_where(turns_far<T>(shape.shape, R, turning_[body], model.dt_s), together);
        }
    }

    /// How the bodies turn during the tick.
    void turn_bodies() {
        const RobotType& type = *work_.type;
        turning_.resize(type.bodies.size());
        const std::span<const T> before = state_.joints().v;
        const auto rate = [&](std::size_t i) {
            return kIsFloat<T> ? before[i] + displacement_[i] : displacement_[i];
        };
        for (std::size_t b = 0; b < type.bodies.size(); ++b) {
            const Body& body = type.bodies[b];
            const auto first = static_cast<std::size_t>(body.v_index);
            if (body.joint == JointKind::kFree) {
                turning_[b] = {rate(first), rate(first + 1), rate(first + 2)};
                continue;
            }
            Vec3T<T> joint = work_.axes[first].angular * rate(first);
            for (std::size_t k = 1; k < static_cast<std::size_t>(body.nv); ++k)
                joint += work_.axes[first + k].angular * rate(first + k);
            turning_[b] = body.parent < 0 ? joint : turning_[static_cast<std::size_t>(body.parent)] + joint;
        }
    }

    void scatter(const Model& model, std::span<const LaneRobot> robots, const Lockstep<T>& together,
                 StepReport& report) {
        for (std::size_t i = 0; i < robots.size(); ++i)
            if (is_in(together, i)) scatter(model, i, robots[i], report);
    }

    void scatter(const Model& model, std::size_t i, const LaneRobot& robot, StepReport& report) {
        RobotState& state = *robot.state;
        state_.scatter(i, state);
        if (model.sleep) state.rest.still_ticks = 0;
        if (on_plane_)
            remember_on_plane(i, robot, report);
        else
            scatter_contacts(i);
        if (robot.bound != nullptr) *robot.bound = box_of(i);
        if (!robot.has_contacts && !on_plane_) found_.remember(model, i, report);
        report.iterations += static_cast<int>(lane(solved_.iterations, i));
        if (lane(solved_.residual, i) > report.residual) report.residual = lane(solved_.residual, i);
    }

    /// Each lane is a contact island of one robot.
    void profile(const Model& model, const Lockstep<T>& together, SolverProfile& profile) const {
        const double tolerance = std::max(model.accuracy.friction_tolerance, newton::kFinest<T>);
        const T error = friction_error_.relative();
        for (std::size_t i = 0; i < kLanesOf<T>; ++i) {
            if (!is_in(together, i)) continue;
            profile.add_island(1, 1, static_cast<int>(lane(solved_.iterations, i)));
            ++profile.velocities[static_cast<std::size_t>(SolveMethod::kNewton)];
            profile.displacements[static_cast<std::size_t>(SolveMethod::kNewton)] += displaced_ ? 1 : 0;
            if (lane(friction_error_.largest, i) > 0) profile.add_friction(lane(error, i), tolerance);
        }
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
        ContactMemory* const first = LaneContacts::memory_for(contacts_.size(), *robot.state);
        ContactMemory* m = first;
        for (const ContactT<T>& c : contacts_) {
            const double impulse = lane(c.impulse, i);
            if (impulse <= 0) continue;
            *m++ = {RobotId::kNone,          c.shape_a, c.shape_b, c.feature, impulse, lane(c.load, i),
                    vector_of(c.friction, i)};
        }
        const auto count = static_cast<std::size_t>(m - first);
        if (count < contacts_.size()) LaneContacts::memory_for(count, *robot.state);
        report.contacts += static_cast<int>(count);
    }

    static constexpr int kOffset = 0;

    Mechanics<T> work_;
    const Mechanics<T>* robot_ = &work_;  // as the solver wants it
    Mechanics<Wide> placed_;              // floats: poses and velocities
    LaneState<T> state_;
    std::vector<T> solution_, displacement_;              // of floats, what is added to the velocities before
    std::vector<T> whole_solution_, whole_displacement_;  // of floats, in all
    std::vector<Vec3T<T>> turning_;                       // of the bodies, rad/s
    std::vector<ContactT<T>> contacts_;
    std::vector<SurfacePair> surfaces_;  // of these, the same in all lanes
    IslandRowsT<T> rows_;
    Newton<T, TreeHessian<T>> newton_;
    SolveReportT<T> solved_;
    friction::BoundError<T> friction_error_;  // of the velocities, if it is profiled
    Mask split_{false}, free_{false}, pushed_{false};
    LaneContacts found_{kLanesOf<T>};
    bool on_plane_ = false;             // contacts_ are not from found_
    bool displaced_ = false;            // the displacement was solved for
    Vec3T<Wide> point_;                 // of one contact
    std::vector<Vec3T<T>> velocities_;  // floats: of the contact points, before the tick
};

}  // namespace roboss
