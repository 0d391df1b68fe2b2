// Rapier behind the common interface, in doubles: rigid bodies, impulse joints, force-based motors, contacts
// with Coulomb's cone a point. rapier/ is the crate that gives it C functions.
#include "engines/rapier/rapier.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engines/body_engine.h"
#include "engines/makers.h"

namespace roboss::bench {
namespace {

constexpr std::uint32_t kScenery = 0xFFFFFFFFu;
constexpr double kStiff = 1e6;  // N m s/rad, N s/m: of a motor that holds a velocity

std::array<double, 3> put(const Vec3& v) {
    return {v.x, v.y, v.z};
}
std::array<double, 7> put(const Pose& X) {
    return {X.p.x, X.p.y, X.p.z, X.q.x, X.q.y, X.q.z, X.q.w};
}

class RapierEngine final : public BodyEngine {
  public:
    RapierEngine(const World& world, const EngineOptions& options, int iterations)
        : BodyEngine(world, options), iterations_(iterations), fast_(options.fast_bodies) {
        scale_ = body_scale(world);
        sim_ = rapier_new(put(world.gravity).data(), dt_, static_cast<std::uint32_t>(iterations), fast_,
                          options.sleep, scale_);
        build();
    }
    ~RapierEngine() override { rapier_free(sim_); }

    std::string name() const override { return "Rapier " ROBOSS_RAPIER_VERSION; }
    std::string settings() const override {
        return "double, impulse joints, warm start, friction cone a point, " + std::to_string(iterations_) +
               " iterations (substeps), lengths in units of " + (scale_ < 1 ? "10 cm" : "1 m");
    }

  protected:
    std::size_t add_body(const PartBody& part) override {
        const PrincipalAxes axes = principal_axes(part.inertia_C);
        Mat3 R = axes.R;
        const Quat q = to_quat(R);
        const double frame[] = {q.x, q.y, q.z, q.w};
        return rapier_body(sim_, part.mass, put(part.p_BC).data(), put(axes.moments).data(), frame,
                           part.gravity, fast_);
    }

    void add_shape(const Shape& shape) override {
        const GeometrySpec& g = shape.collision->geometry;
        const SurfaceSpec& surface = shape.collision->surface;
        std::array<double, 3> size{g.radius, g.length, 0};
        std::uint32_t kind = 4;
        if (g.kind == GeometryKind::kBox) kind = 0, size = put(g.size);
        if (g.kind == GeometryKind::kSphere) kind = 1;
        if (g.kind == GeometryKind::kCylinder) kind = 2;
        if (g.kind == GeometryKind::kCapsule) kind = 3;
        rapier_shape(sim_, number(shape.body), kind, size.data(), put(shape.X_BS).data(), surface.mu,
                     surface.restitution, surface.collide_bitmask, static_cast<std::uint32_t>(shape.instance),
                     shape.filter, put(shape.surface_velocity_W).data());
    }

    std::size_t add_joint(const Joint& joint) override {
        std::uint32_t kind = 0;
        if (joint.spec->kind == JointSpecKind::kPrismatic) kind = 1;
        if (joint.spec->kind == JointSpecKind::kBall) kind = 2;
        if (joint.spec->kind == JointSpecKind::kFixed) kind = 3;
        const double none = std::numeric_limits<double>::infinity();
        double lower = -none, upper = none;
        Pose turn;
        if (kind < 2) {
            const AxisSpec& axis = joint.spec->axes[0];
            turn.q = turning({1, 0, 0}, axis.xyz);
            const double most = kind == 1 ? 1e6 : kPi;
            if (joint.spec->kind != JointSpecKind::kContinuous) {
                if (axis.lower > -most) lower = axis.lower;
                if (axis.upper < most) upper = axis.upper;
            }
        }
        return rapier_joint(sim_, kind, number(joint.parent), number(joint.child),
                            put(joint.X_PJ * turn).data(), put(joint.X_CJ * turn).data(), lower, upper);
    }

    void set_motor(std::size_t joint, const Motor& motor) override {
        rapier_motor(sim_, static_cast<std::uint32_t>(joint), motor.position, motor.velocity, motor.stiffness,
                     motor.holds_velocity ? kStiff : motor.damping, std::min(motor.max_effort, 1e12));
    }

    BodyState body_state(std::size_t body) const override {
        std::array<double, 13> x{};
        rapier_state(sim_, number(body), x.data());
        return {{{x[0], x[1], x[2]}, {x[6], x[3], x[4], x[5]}}, {x[7], x[8], x[9]}, {x[10], x[11], x[12]}};
    }

    void set_body_state(std::size_t body, const BodyState& state) override {
        const std::array<double, 7> X = put(state.X_WB);
        std::array<double, 13> x{};
        std::copy(X.begin(), X.end(), x.begin());
        x[7] = state.angular.x, x[8] = state.angular.y, x[9] = state.angular.z;
        x[10] = state.v_WC.x, x[11] = state.v_WC.y, x[12] = state.v_WC.z;
        rapier_set_state(sim_, number(body), x.data());
    }

    void push(std::size_t body, const Vec3& force_W, const Vec3& torque_W) override {
        rapier_push(sim_, number(body), put(force_W * dt_).data(), put(torque_W * dt_).data());
    }

    void advance() override { rapier_step(sim_); }

  private:
    static std::uint32_t number(std::size_t body) {
        return body == kWorld ? kScenery : static_cast<std::uint32_t>(body);
    }

    int iterations_;
    bool fast_;
    double scale_ = 1;
    RapierSim* sim_ = nullptr;
};

}  // namespace

std::unique_ptr<Engine> make_rapier(const World& world, const EngineOptions& options) {
    if (!BodyEngine::can(world)) return nullptr;
    const double iterations = (has_chains(world) ? 8 : 2) * std::max(1.0, options.accuracy);
    return std::make_unique<RapierEngine>(world, options, static_cast<int>(std::lround(iterations)));
}

}  // namespace roboss::bench
