// RoBOSS behind the common interface, by its real path: compile() once, then step_island() with all robots in
// one call, so that the broad phase, the contact islands and the solver all count, as they do in every peer.
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/check.h"
#include "engines/engine.h"
#include "engines/makers.h"
#include "physics/dynamics/kinematics.h"
#include "physics/step.h"

namespace roboss::bench {
namespace {

class RobossEngine final : public Engine {
  public:
    RobossEngine(const World& world, const EngineOptions& options, Model model, std::size_t lanes)
        : world_(world), accuracy_(options.accuracy), lanes_(lanes), model_(std::move(model)) {
        if (lanes_ > 0) scratch_.use_lanes(lanes_);
        if (options.measure)
            scratch_.measure_stages([]() -> std::uint64_t { return 0; });  // no times, only figures
        first_robot_.assign(world.instances.size() + 1, model_.robots.size());
        for (std::size_t r = model_.robots.size(); r-- > 0;) first_robot_[model_.robots[r].family] = r;
        for (std::size_t i = world.instances.size(); i-- > 0;)
            first_robot_[i] = std::min(first_robot_[i], first_robot_[i + 1]);
        robots_.reserve(model_.robots.size()), states_.reserve(model_.robots.size());
        pointers_.reserve(model_.robots.size());
        for (std::size_t r = 0; r < model_.robots.size(); ++r) {
            robots_.emplace_back(r);
            states_.push_back(initial_state(model_, RobotId(r)));
        }
        for (RobotState& state : states_) pointers_.push_back(&state);
        bounds_.resize(states_.size());
    }

    std::string name() const override {
        const std::string ours = model_.precision == Precision::kFloat ? "RoBOSS-float"
                                 : accuracy_ < 1                       ? "RoBOSS-fast"
                                                                       : "RoBOSS";
        return lanes_ == 0 ? ours : ours + "-" + std::to_string(lanes_) + (lanes_ == 1 ? " lane" : " lanes");
    }
    std::string settings() const override {
        const bool in_floats = model_.precision == Precision::kFloat;
        return (in_floats ? "floats for robots that meet no other, Newton to the tolerance"
                          : "double, Newton to the tolerance") +
               accuracy_text() + "; all robots in one call of step_island; lanes: " +
               std::to_string(scratch_.lanes(model_.precision));
    }

    void step(int ticks) override {
        for (int i = 0; i < ticks; ++i) {
            const StepReport report = step_island(model_, tick_++, robots_, pointers_, {}, bounds_, scratch_);
            solver_ += report.profile.solver;
            if (report.not_finite.valid()) throw std::runtime_error("RoBOSS: a state is not finite");
        }
    }

    LinkState link(LinkRef ref) const override {
        const ModelInstance& instance = world_.instances[ref.instance];
        const LinkSpec& spec = world_.prototypes[instance.prototype].links[ref.link];
        for (std::size_t r = first_robot_[ref.instance]; r < first_robot_[ref.instance + 1]; ++r) {
            const RobotType& type = model_.type_of(RobotId(r));
            const auto link = type.find_link(spec.name);
            if (!link) continue;
            const Transform X_WL = link_pose(type, states_[r], *link);
            const Twist twist = link_twist(type, states_[r], *link);
            return {to_pose(X_WL), twist.angular, twist.linear + cross(twist.angular, X_WL.R * spec.p_LC)};
        }
        return {instance.X_WM * spec.X_ML, {}, {}};
    }

    std::optional<SolverFigures> solver_figures() const override {
        if (solver_.islands == 0) return std::nullopt;
        const auto share = [](std::uint64_t part, std::uint64_t of) {
            return of > 0 ? static_cast<double>(part) / static_cast<double>(of) : 0.0;
        };
        return SolverFigures{share(solver_.iterations, solver_.islands), solver_.residual,
                             solver_.friction_error, share(solver_.friction_misses, solver_.friction_solves)};
    }

    JointState joint(JointRef ref) const override {
        const Place place = find(ref);
        return {states_[place.robot].q[place.q], states_[place.robot].v[place.v]};
    }

    void set_joint(JointRef ref, JointState state) override {
        const Place place = find(ref);
        states_[place.robot].q[place.q] = state.position;
        states_[place.robot].v[place.v] = state.velocity;
    }

    void set_base(std::size_t instance, const Pose& X_WM, const Vec3& angular, const Vec3& linear) override {
        const std::size_t r = first_robot_[instance];
        ROBOSS_CHECK(first_robot_[instance + 1] == r + 1, "one robot an instance");
        const RobotType& type = model_.type_of(RobotId(r));
        RobotState& state = states_[r];
        apply_order(model_, {0, {}, 0, RobotId(r), SetPose{X_WM}}, state);
        if (!type.free_base) return;
        const Quat q_WB = base_pose(state).q;
        const auto root = std::find_if(type.links.begin(), type.links.end(),
                                       [](const Link& link) { return link.body == 0; });
        const Vec3 origin = linear - cross(angular, rotate(q_WB, root->p_BC));
        apply_order(model_, {0, {}, 0, RobotId(r), SetVelocity{origin, angular}}, state);
    }

    void drive_velocity(JointRef ref, double velocity, double max_effort) override {
        motor(ref) = {MotorMode::kVelocity, velocity, max_effort};
    }

    /// The gains belong to the robot's type: they hold for all its robots.
    void drive_position(JointRef ref, const Servo& servo) override {
        const Place place = find(ref);
        RobotType& type = model_.types[model_.robots[place.robot].type.index()];
        Dof& dof = type.dofs[place.v - static_cast<std::size_t>(type.base_nv())];
        dof.position_gain = servo.stiffness;
        dof.velocity_gain = servo.damping;
        motor(ref) = {MotorMode::kPosition, servo.position, servo.max_effort};
    }

    void drive_effort(JointRef ref, double effort) override {
        motor(ref) = {MotorMode::kEffort, effort, std::numeric_limits<double>::infinity()};
    }

  private:
    struct Place {
        std::size_t robot = 0, q = 0, v = 0;
    };

    std::string accuracy_text() const {
        if (accuracy_ == 1) return {};
        return accuracy_ > 1 ? ", accuracy high" : ", accuracy fast";
    }

    Place find(JointRef ref) const {
        const ModelSpec& spec = world_.prototypes[world_.instances[ref.instance].prototype];
        for (std::size_t r = first_robot_[ref.instance]; r < first_robot_[ref.instance + 1]; ++r) {
            const RobotType& type = model_.type_of(RobotId(r));
            // Types mostly keep the order of the file: look there first.
            const bool same =
                ref.joint < type.joints.size() && type.joints[ref.joint].name == spec.joints[ref.joint].name;
            const auto id = same ? JointId(ref.joint) : type.find_joint(spec.joints[ref.joint].name);
            if (!id) continue;
            const Joint& joint = type.joints[id->index()];
            ROBOSS_CHECK(joint.v_index >= 0, joint.name);
            const int offset = joint.axis_offset(static_cast<int>(ref.axis));
            return {r, static_cast<std::size_t>(joint.q_index + offset),
                    static_cast<std::size_t>(joint.v_index + offset)};
        }
        ROBOSS_CHECK(false, "no joint " + spec.joints[ref.joint].name);
    }

    MotorSetpoint& motor(JointRef ref) {
        const Place place = find(ref);
        const auto base = static_cast<std::size_t>(model_.type_of(RobotId(place.robot)).base_nv());
        return states_[place.robot].motors[place.v - base];
    }

    const World& world_;
    double accuracy_;
    std::size_t lanes_;  // 0: as many as the processor has
    Model model_;
    std::vector<std::size_t> first_robot_;  // by instance
    std::vector<RobotId> robots_;
    std::vector<RobotState> states_;
    std::vector<RobotState*> pointers_;
    std::vector<Aabb> bounds_;
    StepScratch scratch_;
    SolverProfile solver_;  // empty unless it is measured
    Tick tick_ = 0;
};

std::unique_ptr<Engine> make(const World& world, const EngineOptions& options, std::size_t lanes,
                             Precision precision = Precision::kDouble) {
    CompileOptions compiling;
    compiling.precision = precision;
    compiling.dt_s = options.dt_s;
    compiling.accuracy.setting = options.accuracy > 1 ? "high" : options.accuracy < 1 ? "fast" : "";
    Diagnostics diagnostics;
    const auto model = compile(world, compiling, diagnostics);
    if (!model) return nullptr;
    return std::make_unique<RobossEngine>(world, options, *model, lanes);
}

EngineOptions with_accuracy(EngineOptions options, double accuracy) {
    options.accuracy = accuracy;
    return options;
}

}  // namespace

std::unique_ptr<Engine> make_roboss(const World& world, const EngineOptions& options) {
    return make(world, options, 0);
}

std::unique_ptr<Engine> make_roboss_in_4_lanes(const World& world, const EngineOptions& options) {
    return make(world, options, 4);
}

std::unique_ptr<Engine> make_roboss_in_1_lane(const World& world, const EngineOptions& options) {
    return make(world, options, 1);
}

std::unique_ptr<Engine> make_roboss_fast(const World& world, const EngineOptions& options) {
    return make(world, with_accuracy(options, 0.1), 0);
}

std::unique_ptr<Engine> make_roboss_high(const World& world, const EngineOptions& options) {
    return make(world, with_accuracy(options, 10), 0);
}

std::unique_ptr<Engine> make_roboss_in_floats(const World& world, const EngineOptions& options) {
    return make(world, options, 0, Precision::kFloat);
}

std::unique_ptr<Engine> make_roboss_in_8_floats(const World& world, const EngineOptions& options) {
    return make(world, options, 8, Precision::kFloat);
}

}  // namespace roboss::bench
