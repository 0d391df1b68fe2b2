// See sanity.h.
#include "corpus/sanity.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <support/mechanical_sums.h>

#include "core/union_find.h"
#include "onboard_kinds/onboard_spec.h"
#include "physics/dynamics/motor_effort.h"
#include "physics/step.h"

namespace roboss::corpus {
namespace {

constexpr double kSample_s = 0.01;

/// Whether a controller moves the robot by something else than its motors.
bool pushes(const OnboardInfo& info) {
    const auto is_of = [&]<class... Kinds>() {
        return (std::holds_alternative<Kinds>(info.spec.parameters) || ...);
    };
    return is_of.operator()<VelocityControlSpec, DriveToPoseSpec, TrajectoryFollowerSpec, ApplyLinkWrenchSpec,
                            PlanarMoveSpec, MotorModelSpec, MulticopterControlSpec, LiftDragSpec,
                            AdvancedLiftDragSpec, ThrusterSpec, BuoyancyEngineSpec, HydrodynamicsSpec,
                            WindEffectsSpec, TrackControllerSpec, TrackedVehicleSpec, SurfaceVelocitySpec,
                            ActorSpec, LighterThanAirSpec, ElevatorSpec, FollowActorSpec, CrumbSpec>();
}

bool is_driven(const Model& model, const RobotType& type) {
    const bool windy = norm(model.wind) > 0 && !type.drags.empty();
    return type.kinematic || type.feels_flow || type.wind_index >= 0 || windy ||
           std::ranges::any_of(type.onboard, pushes);
}

/// All robots of a world in one call of the step.
class Stepper {
  public:
    Stepper(const Model& model, std::vector<RobotState> states)
        : model_(model), states_(std::move(states)), bounds_(states_.size()) {
        for (std::size_t r = 0; r < states_.size(); ++r)
            ids_.push_back(RobotId(r)), pointers_.push_back(&states_[r]);
        scratch_.keep_reactions(true);
    }

    bool step() {
        const StepReport report = step_island(model_, tick_++, ids_, pointers_, {}, bounds_, scratch_);
        return !report.not_finite.valid();
    }
    double time_s() const { return static_cast<double>(tick_) * model_.dt_s; }
    const std::vector<RobotState>& states() const { return states_; }
    std::span<const ContactReport> contacts() { return read_contacts(scratch_); }

  private:
    const Model& model_;
    std::vector<RobotState> states_;
    std::vector<RobotId> ids_;
    std::vector<RobotState*> pointers_;
    std::vector<Aabb> bounds_;
    StepScratch scratch_;
    Tick tick_ = 0;
};

std::vector<RobotState> initial_states(const Model& model) {
    std::vector<RobotState> states;
    for (std::size_t r = 0; r < model.robots.size(); ++r) states.push_back(initial_state(model, RobotId(r)));
    return states;
}

/// Work of the motors in one tick, J.
double motor_work(const Model& model, RobotId robot, const RobotState& before, const RobotState& after) {
    const RobotType& type = model.type_of(robot);
    double work = 0;
    for (std::size_t j = 0; j < type.joints.size(); ++j)
        for (int axis = 0; axis < type.joints[j].nv; ++axis) {
            const JointId joint(j);
            if (after.motors[type.motor_index(type.joints[j], axis)].mode == MotorMode::kPassive) continue;
            const double rate = 0.5 * (joint_state(type, before, joint, axis).velocity +
                                       joint_state(type, after, joint, axis).velocity);
            work += motor_effort(model, type, after, joint, axis) * rate * model.dt_s;
        }
    return work;
}

/// A robot over the run.
struct Course {
    std::vector<double> unexplained,  // J, by samples: energy beyond the motors' work
        fallen;                       // J, since the highest
    double work = 0, mass = 0, highest = 0, speed = 0, depth = 0, soft_speed = 0;
    bool carried = false;  // by a belt
};

double fastest_centre(const RobotType& type, const RobotState& state, Mechanics<double>& at) {
    forward_kinematics<double>(type, state.q, at);
    forward_velocities<double>(type, state.v, at);
    double most = 0;
    for (const auto& body : at.bodies)
        most = std::fmax(most, norm(body.velocity.linear + cross(body.velocity.angular, body.centre)));
    return most;
}

/// The greatest speed at which a soft surface of the robot pushes apart, m/s.
double soft_speed(const RobotType& type) {
    double speed = 0;
    for (const BodyShape& shape : type.shapes)
        if (shape.material.stiffness > 0) speed = std::fmax(speed, shape.material.correction_speed);
    return speed;
}

class Judge {
  public:
    Judge(const Model& model, const Model& awake)
        : model_(model),
          awake_(awake),
          stepper_(model, initial_states(model)),
          summer_(model),
          courses_(model.robots.size()) {
        touching_.reset(courses_.size());
        for (std::size_t r = 0; r < courses_.size(); ++r) {
            const RobotType& type = model.type_of(RobotId(r));
            courses_[r].mass = type.mass, courses_[r].soft_speed = soft_speed(type);
        }
    }

    Sanity run(double seconds) {
        Sanity sanity;
        sanity.robots = courses_.size();
        sample();
        const Tick every = std::max<Tick>(1, std::llround(kSample_s / model_.dt_s));
        const Tick ticks = std::llround(seconds / model_.dt_s);
        for (Tick tick = 1; tick <= ticks; ++tick) {
            before_ = stepper_.states();
            if (!stepper_.step()) {
                sanity.not_finite_s = stepper_.time_s();
                return sanity;
            }
            follow();
            if (tick % every == 0 || tick == ticks) sample(), times_.push_back(stepper_.time_s());
        }
        sanity.asleep = static_cast<std::size_t>(std::ranges::count_if(
            stepper_.states(), [](const RobotState& state) { return state.rest.asleep; }));
        judge_groups(sanity);
        return sanity;
    }

  private:
    void follow() {
        for (std::size_t r = 0; r < courses_.size(); ++r)
            courses_[r].work += motor_work(model_, RobotId(r), before_[r], stepper_.states()[r]);
        for (const ContactReport& c : stepper_.contacts()) {
            Course& a = courses_[c.robot_a.index()];
            a.depth = std::fmax(a.depth, -c.gap);
            if (c.robot_b.valid())
                touching_.unite(c.robot_a.value, c.robot_b.value);
            else
                a.carried |= model_.statics[c.scenery].may_flow();
        }
        for (std::size_t r = 0; r < courses_.size(); ++r)
            for (const Bond& bond : stepper_.states()[r].bonds)
                if (bond.other < courses_.size()) touching_.unite(static_cast<std::uint32_t>(r), bond.other);
    }

    void sample() {
        for (std::size_t r = 0; r < courses_.size(); ++r) {
            Course& course = courses_[r];
            const RobotState& state = stepper_.states()[r];
            const test::MechanicalSums sums = summer_.of(RobotId(r), state);
            course.highest =
                course.unexplained.empty() ? sums.potential : std::fmax(course.highest, sums.potential);
            course.unexplained.push_back(sums.energy() - course.work);
            course.fallen.push_back(course.highest - sums.potential);
            course.speed = std::fmax(course.speed, fastest_centre(model_.type_of(RobotId(r)), state, at_));
        }
    }

    /// Figures by sets of robots that touched each other.
    void judge_groups(Sanity& sanity) {
        const std::vector<double> moved = sleepers_moves();
        std::vector<std::vector<std::size_t>> members(courses_.size());
        for (std::uint32_t r = 0; r < courses_.size(); ++r) members[touching_.find(r)].push_back(r);
        for (const std::vector<std::size_t>& group : members)
            if (!group.empty()) sanity.groups.push_back(figures(group, moved));
        std::ranges::stable_sort(sanity.groups, [](const Figures& a, const Figures& b) {
            return std::pair(!a.is_sane(), a.gain - a.explained) >
                   std::pair(!b.is_sane(), b.gain - b.explained);
        });
    }

    Figures figures(const std::vector<std::size_t>& group, const std::vector<double>& moved) const {
        Figures f;
        f.robot = model_.robots[group.front()].name;
        double mass = 0, soft = 0;
        bool any_awake = false;
        for (const std::size_t r : group) {
            const Course& c = courses_[r];
            mass += c.mass, soft = std::fmax(soft, c.soft_speed);
            f.speed = std::fmax(f.speed, c.speed), f.depth = std::fmax(f.depth, c.depth);
            f.driven |= c.carried || is_driven(model_, model_.type_of(RobotId(r)));
            f.sleeper_moves = std::fmax(f.sleeper_moves, moved[r]);
            any_awake |= !stepper_.states()[r].rest.asleep && !model_.type_of(RobotId(r)).is_static;
        }
        if (any_awake) f.sleeper_moves = 0;  // what is awake may push it
        if (!(mass > 0)) return f;
        for (std::size_t k = 0; k < times_.size(); ++k) {
            double gain = 0, fallen = 0;
            for (const std::size_t r : group) {
                gain += courses_[r].unexplained[k + 1] - courses_[r].unexplained.front();
                fallen += courses_[r].fallen[k + 1];
            }
            // What lies in each other is raised by its depth, one on top of the other; soft surfaces part at
            // a speed, of the common centre and of the parts against each other.
            const double raised = norm(model_.gravity) * f.depth * static_cast<double>(group.size()),
                         explained =
                             raised + (f.depth > 0 ? soft * soft : 0) + kFallErrorMost * fallen / mass;
            if (k > 0 && gain / mass - explained <= f.gain - f.explained) continue;
            f.gain = gain / mass, f.explained = explained, f.time_s = times_[k];
        }
        return f;
    }

    /// How far each sleeper moves in a second, awake.
    std::vector<double> sleepers_moves() const {
        std::vector<double> moved(courses_.size());
        std::vector<RobotState> states = stepper_.states();
        for (RobotState& state : states) state.rest = {};
        Stepper on(awake_, states);
        while (on.time_s() < 1)
            if (!on.step()) break;
        Mechanics<double> was, is;
        for (std::size_t r = 0; r < moved.size(); ++r) {
            const RobotType& type = model_.type_of(RobotId(r));
            if (!stepper_.states()[r].rest.asleep) continue;
            forward_kinematics<double>(type, states[r].q, was);
            forward_kinematics<double>(type, on.states()[r].q, is);
            for (std::size_t b = 0; b < type.bodies.size(); ++b)
                moved[r] = std::fmax(
                    moved[r], norm(is.origin + is.bodies[b].centre - was.origin - was.bodies[b].centre));
        }
        return moved;
    }

    const Model &model_, &awake_;
    Stepper stepper_;
    test::MechanicalSummer summer_;
    std::vector<Course> courses_;
    UnionFind touching_;
    std::vector<RobotState> before_;
    std::vector<double> times_;
    Mechanics<double> at_;
};

}  // namespace

bool Figures::is_sane() const {
    return (driven || gain - explained <= kGainMost) && sleeper_moves <= kSleeperMovesMost;
}

bool Sanity::is_sane() const {
    return not_finite_s < 0 && std::ranges::all_of(groups, &Figures::is_sane);
}

Sanity judge(const Model& model, const Model& awake, double seconds) {
    return Judge(model, awake).run(seconds);
}

}  // namespace roboss::corpus
