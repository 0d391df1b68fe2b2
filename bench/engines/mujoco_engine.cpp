// MuJoCo behind the common interface. Motors are written into qfrc_applied, because MuJoCo's own actuators
// keep a dense matrix (actuators x degrees of freedom), which would cost a crowd of robots most of its time.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "accuracy/mujoco_load.h"
#include "core/check.h"
#include "engines/makers.h"
#include "engines/mjcf.h"

namespace roboss::bench {
namespace {

struct FreeModel {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
};
struct FreeData {
    void operator()(mjData* d) const { mj_deleteData(d); }
};
using ModelPointer = std::unique_ptr<mjModel, FreeModel>;
using DataPointer = std::unique_ptr<mjData, FreeData>;

/// How many robots' worth of numbers MuJoCo has to hold.
struct Sizes {
    long bodies = 0, freedoms = 0;
};

Sizes count(const World& world) {
    std::vector<Sizes> prototypes;
    for (const ModelSpec& model : world.prototypes) {
        const Assembly assembly = assemble(model);
        Sizes sizes;
        for (const PartBody& body : assembly.bodies) ++sizes.bodies, sizes.freedoms += body.joint < 0 ? 6 : 0;
        for (const PartJoint& joint : assembly.joints)
            sizes.freedoms +=
                joint.spec->kind == JointSpecKind::kBall ? 3 : static_cast<long>(joint.spec->axes.size());
        prototypes.push_back(sizes);
    }
    Sizes all;
    for (const ModelInstance& instance : world.instances) {
        all.bodies += prototypes[instance.prototype].bodies;
        all.freedoms += prototypes[instance.prototype].freedoms;
    }
    return all;
}

/// Constraint rows for `wanted` contacts, or as many as MuJoCo 2 can hold: it counts its buffer, which takes
/// rows x (freedoms + rows) numbers whatever is zero in them, in 32 bits.
long rows_that_fit(long freedoms, long wanted) {
    constexpr double kBytes = 2.0e9;
    const double a = 12, b = 24.0 * static_cast<double>(freedoms) + 1000;
    return std::min(wanted, static_cast<long>((std::sqrt(b * b + 4 * a * kBytes) - b) / (2 * a)));
}

constexpr int kArenaSince = 300, kSpeculativeSince = 4000000;  // versions

void set_buffers(const Sizes& sizes, MjcfOptions& mjcf) {
    if (mj_version() >= kArenaSince) {
        mjcf.memory_bytes = 100'000'000 + 40'000 * sizes.bodies + 24 * sizes.freedoms * sizes.freedoms;
        return;
    }
    mjcf.rows_max = rows_that_fit(sizes.freedoms, 20 * sizes.bodies + 300);
    if (mjcf.rows_max < sizes.bodies)  // known before the long compilation
        throw std::runtime_error("MuJoCo 2 holds at most " + std::to_string(mjcf.rows_max) +
                                 " constraint rows for " + std::to_string(sizes.bodies) +
                                 " bodies (its buffer is counted in 32 bits)");
    mjcf.contacts_max = mjcf.rows_max / 3;
    mjcf.stack_numbers =
        std::min(1000000 + 400 * mjcf.rows_max + 3 * sizes.freedoms * sizes.freedoms, 1000000000L);
}

ModelPointer load(const std::string& xml) {
    std::string error;
    ModelPointer model(test::load_mjcf(xml, error));
    if (!model) throw std::runtime_error("MuJoCo: " + error);
    return model;
}

/// Elevations from 0 to 1.
void fill_height_fields(const MjcfPlaces& places, mjModel& model) {
    for (std::size_t h = 0; h < places.heights.size(); ++h) {
        const std::vector<double>& heights = places.heights[h]->heights;
        const auto [low, high] = std::ranges::minmax(heights);
        float* to = model.hfield_data + model.hfield_adr[h];
        for (const double z : heights) *to++ = static_cast<float>(high > low ? (z - low) / (high - low) : 0);
    }
}

/// A motor on one degree of freedom: effort = clamp(stiffness (target - q) + damping (speed - qd), bound).
struct Motor {
    bool on = false;
    double stiffness = 0, damping = 0, target = 0, speed = 0, bound = 0;
    double own_damping = 0;  // of the joint
    int q = 0;
};

class MujocoEngine final : public Engine {
  public:
    MujocoEngine(const World& world, MjcfPlaces places, ModelPointer model, std::string settings)
        : world_(world),
          instances_(std::move(places.instances)),
          model_(std::move(model)),
          data_(mj_makeData(model_.get())),
          settings_(std::move(settings)) {
        if (!data_) throw std::runtime_error("MuJoCo: no memory for its data");
        motors_.resize(static_cast<std::size_t>(model_->nv));
        for (int j = 0; j < model_->njnt; ++j) {
            Motor& motor = motors_[static_cast<std::size_t>(model_->jnt_dofadr[j])];
            motor.q = model_->jnt_qposadr[j];
            motor.own_damping = model_->dof_damping[model_->jnt_dofadr[j]];
        }
        for (std::size_t i = 0; i < world.instances.size(); ++i) set_initial_positions(i);
        mj_forward(model_.get(), data_.get());
    }

    std::string name() const override { return std::string("MuJoCo ") + mj_versionString(); }
    std::string settings() const override { return settings_; }

    void step(int ticks) override {
        for (int i = 0; i < ticks; ++i) {
            apply_motors();
            mj_step(model_.get(), data_.get());
        }
        if (data_->warning[mjWARN_CONTACTFULL].number + data_->warning[mjWARN_CNSTRFULL].number > 0)
            throw std::runtime_error("MuJoCo " + std::string(mj_versionString()) +
                                     " has no room for the constraint rows of " + std::to_string(model_->nv) +
                                     " degrees of freedom (version 2 counts its buffer in 32 bits)");
        for (const int lost :
             {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})  // it starts anew, and goes on
            if (data_->warning[lost].number > 0) throw std::runtime_error("MuJoCo: a state is not finite");
        mj_kinematics(model_.get(), data_.get());  // poses of the state after the step
        mj_comPos(model_.get(), data_.get());
        mj_comVel(model_.get(), data_.get());
    }

    LinkState link(LinkRef ref) const override {
        const MjcfPlaces::Instance& place = instances_[ref.instance];
        const ModelInstance& instance = world_.instances[ref.instance];
        const int b = place.assembly.body_of_link[ref.link];
        const Pose& X_BL = place.assembly.X_BL[ref.link];
        if (b < 0) return {instance.X_WM * X_BL, {}, {}};
        const int id = place.first_body + b;
        const mjtNum *p = data_->xpos + 3 * id, *q = data_->xquat + 4 * id;
        const Pose X_WL = Pose{{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}} * X_BL;
        mjtNum v[6];
        mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, id, v, 0);
        const Vec3 angular{v[0], v[1], v[2]};
        const Vec3 offset =
            X_WL * world_.prototypes[instance.prototype].links[ref.link].p_LC - Vec3{p[0], p[1], p[2]};
        return {X_WL, angular, Vec3{v[3], v[4], v[5]} + cross(angular, offset)};
    }

    JointState joint(JointRef ref) const override {
        const int j = id_of(ref);
        return {data_->qpos[model_->jnt_qposadr[j]], data_->qvel[model_->jnt_dofadr[j]]};
    }

    void set_joint(JointRef ref, JointState state) override {
        const int j = id_of(ref);
        data_->qpos[model_->jnt_qposadr[j]] = state.position;
        data_->qvel[model_->jnt_dofadr[j]] = state.velocity;
        mj_forward(model_.get(), data_.get());
    }

    void set_base(std::size_t instance, const Pose& X_WM, const Vec3& angular, const Vec3& linear) override {
        const MjcfPlaces::Instance& place = instances_[instance];
        for (std::size_t b = 0; b < place.free_joints.size(); ++b) {
            if (place.free_joints[b] < 0) continue;
            const PartBody& part = place.assembly.bodies[b];
            const Pose X_WB = X_WM * part.X_MB;
            mjtNum* q = data_->qpos + model_->jnt_qposadr[place.free_joints[b]];
            const double pose[] = {X_WB.p.x, X_WB.p.y, X_WB.p.z, X_WB.q.w, X_WB.q.x, X_WB.q.y, X_WB.q.z};
            std::copy(std::begin(pose), std::end(pose), q);
            const Vec3 origin = linear - cross(angular, rotate(X_WB.q, part.p_BC));
            const Vec3 local = rotate(conjugate(X_WB.q), angular);
            mjtNum* v = data_->qvel + model_->jnt_dofadr[place.free_joints[b]];
            const double twist[] = {origin.x, origin.y, origin.z, local.x, local.y, local.z};
            std::copy(std::begin(twist), std::end(twist), v);
        }
        mj_forward(model_.get(), data_.get());
    }

    void drive_velocity(JointRef ref, double velocity, double max_effort) override {
        // As stiff as an explicit motor may be at this inertia.
        const double gain = 1.0 / (model_->dof_invweight0[dof_of(ref)] * model_->opt.timestep);
        set_motor(ref, {true, 0, gain, 0, velocity, max_effort});
    }

    void drive_position(JointRef ref, const Servo& servo) override {
        set_motor(ref, {true, servo.stiffness, servo.damping, servo.position, 0, servo.max_effort});
    }

    void drive_effort(JointRef ref, double effort) override {
        motor(ref).on = false;
        const int dof = dof_of(ref);
        model_->dof_damping[dof] = motor(ref).own_damping;
        data_->qfrc_applied[dof] = effort;
    }

  private:
    int id_of(JointRef ref) const {
        const int j = instances_[ref.instance].joints[ref.joint][ref.axis];
        ROBOSS_CHECK(j >= 0, "no such axis");
        return j;
    }
    int dof_of(JointRef ref) const { return model_->jnt_dofadr[id_of(ref)]; }
    Motor& motor(JointRef ref) { return motors_[static_cast<std::size_t>(dof_of(ref))]; }

    void set_motor(JointRef ref, Motor wanted) {
        Motor& motor = this->motor(ref);
        wanted.own_damping = motor.own_damping, wanted.q = motor.q;
        motor = wanted;
    }

    void set_initial_positions(std::size_t instance) {
        const ModelSpec& spec = world_.prototypes[world_.instances[instance].prototype];
        for (std::size_t j = 0; j < spec.joints.size(); ++j)
            for (std::size_t a = 0; a < spec.joints[j].axes.size(); ++a)
                if (const int id = instances_[instance].joints[j][a]; id >= 0)
                    data_->qpos[model_->jnt_qposadr[id]] = spec.joints[j].axes[a].initial_position;
    }

    /// Within its bound a motor's damping is the joint's, which Euler's method takes implicitly; beyond, the
    /// motor is the bound.
    void apply_motors() {
        for (std::size_t i = 0; i < motors_.size(); ++i) {
            const Motor& motor = motors_[i];
            if (!motor.on) continue;
            const double pull =
                motor.stiffness * (motor.target - data_->qpos[motor.q]) + motor.damping * motor.speed;
            const double effort = pull - motor.damping * data_->qvel[i];
            const bool bounded = std::fabs(effort) > motor.bound;
            model_->dof_damping[i] = motor.own_damping + (bounded ? 0 : motor.damping);
            data_->qfrc_applied[i] = bounded ? std::copysign(motor.bound, effort) : pull;
        }
    }

    const World& world_;
    std::vector<MjcfPlaces::Instance> instances_;
    ModelPointer model_;
    DataPointer data_;
    std::string settings_;
    std::vector<Motor> motors_;  // by degree of freedom
};

}  // namespace

std::unique_ptr<Engine> make_mujoco(const World& world, const EngineOptions& options) {
    if (has_belts(world) || (options.sleep && mj_version() < kSpeculativeSince)) return nullptr;
    MjcfOptions mjcf;
    mjcf.dt_s = options.dt_s;
    mjcf.contact_time_s = 2 * options.dt_s;
    mju_user_error = [](const char* message) {  // the library's own handler waits for a key
        std::fprintf(stderr, "MuJoCo: %s\n", message);
        std::_Exit(3);
    };
    const Sizes sizes = count(world);
    constexpr long kNewtonMax = 1000;  // degrees of freedom; Newton's stack takes their square
    mjcf.solver = sizes.freedoms <= kNewtonMax ? "Newton" : "CG";
    mjcf.tolerance /= options.accuracy;
    set_buffers(sizes, mjcf);
    mjcf.sleep = options.sleep;
    mjcf.speculative = options.fast_bodies && mj_version() >= kSpeculativeSince;
    if (options.fast_bodies && mj_version() >= kArenaSince) mjcf.integrator = "implicit";
    mju_user_warning = [](const char*) {};  // by default they go to a file in the current folder
    auto places = write_mjcf(world, mjcf);
    if (!places) return nullptr;
    ModelPointer model = load(places->xml);
    fill_height_fields(*places, *model);
    const std::string settings =
        "double, " + mjcf.integrator + ", " + mjcf.solver + ", " + mjcf.cone + " cones, " + mjcf.jacobian +
        " Jacobians" +
        (mj_version() >= kSpeculativeSince ? "; where bodies are fast: implicit, speculative contacts" : "");
    return std::make_unique<MujocoEngine>(world, std::move(*places), std::move(model), settings);
}

}  // namespace roboss::bench
