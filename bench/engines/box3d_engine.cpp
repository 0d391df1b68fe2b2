// Box3D behind the common interface: rigid bodies in floats, "soft step" with substeps of one solver and one
// relaxing pass. Its shapes are spheres, capsules and convex hulls: a cylinder is a prism here, a plane a
// box. Its springs know a frequency and no stiffness, so a servo is a bounded motor whose target speed is
// that of an implicit PD.
#include <box3d/box3d.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "engines/body_engine.h"
#include "engines/makers.h"

namespace roboss::bench {
namespace {

constexpr int kSides = 32;             // of a prism
constexpr float kPlaneHalf = 1000;     // m
constexpr double kStiffHertz = 0.125;  // of joints, as a part of the rate of substeps

float to_float(double x) {
    return static_cast<float>(x);
}
b3Vec3 put(const Vec3& v) {
    return {to_float(v.x), to_float(v.y), to_float(v.z)};
}
b3Quat put(const Quat& q) {
    return {{to_float(q.x), to_float(q.y), to_float(q.z)}, to_float(q.w)};
}
b3Transform put(const Pose& X) {
    return {put(X.p), put(X.q)};
}
Vec3 take(const b3Vec3& v) {
    return {v.x, v.y, v.z};
}

struct DestroyHull {
    void operator()(b3HullData* hull) const { b3DestroyHull(hull); }
};

class Box3dEngine final : public BodyEngine {
  public:
    Box3dEngine(const World& world, const EngineOptions& options, int substeps)
        : BodyEngine(world, options), substeps_(substeps), fast_(options.fast_bodies) {
        scale_ = body_scale(world);
        b3SetLengthUnitsPerMeter(to_float(scale_));
        b3WorldDef def = b3DefaultWorldDef();
        def.gravity = put(world.gravity);
        def.enableSleep = options.sleep;
        def.maximumLinearSpeed = 400;
        def.enableContinuous = options.fast_bodies;
        def.restitutionThreshold = 0.01f;
        def.frictionCallback = [](float a, std::uint64_t, float b, std::uint64_t) { return std::min(a, b); };
        def.workerCount = 1;
        box_ = b3CreateWorld(&def);
        b3BodyDef scenery = b3DefaultBodyDef();
        scenery_ = b3CreateBody(box_, &scenery);
        build();
    }
    ~Box3dEngine() override { b3DestroyWorld(box_); }

    std::string name() const override {
        const b3Version v = b3GetVersion();
        return "Box3D " + std::to_string(v.major) + "." + std::to_string(v.minor) + "." +
               std::to_string(v.revision);
    }
    std::string settings() const override {
        return "float, soft step, " + std::to_string(substeps_) + " substeps, lengths in units of " +
               (scale_ < 1 ? "10 cm" : "1 m") + "; cylinders are prisms of " + std::to_string(kSides) +
               " sides; servos are motors";
    }

  protected:
    std::size_t add_body(const PartBody& part) override {
        b3BodyDef def = b3DefaultBodyDef();
        def.type = b3_dynamicBody;
        def.gravityScale = part.gravity ? 1.0f : 0.0f;
        def.allowFastRotation = true;
        def.isBullet = fast_;
        bodies_.push_back(b3CreateBody(box_, &def));
        const Mat3& I = part.inertia_C;
        const auto column = [&](std::size_t c) { return put(Vec3{I(0, c), I(1, c), I(2, c)}); };
        b3Body_SetMassData(bodies_.back(),
                           {to_float(part.mass), put(part.p_BC), {column(0), column(1), column(2)}});
        return bodies_.size() - 1;
    }

    void add_shape(const Shape& shape) override {
        const SurfaceSpec& surface = shape.collision->surface;
        b3ShapeDef def = b3DefaultShapeDef();
        def.updateBodyMass = false;
        def.baseMaterial.friction = to_float(surface.mu);
        def.baseMaterial.restitution = to_float(surface.restitution);
        def.baseMaterial.rollingResistance = to_float(surface.rolling_mu);
        def.baseMaterial.tangentVelocity = put(shape.surface_velocity_W);
        def.filter.categoryBits = surface.collide_bitmask;
        def.filter.maskBits = surface.collide_bitmask;
        if (shape.body != kWorld) def.filter.groupIndex = -1 - static_cast<int>(shape.instance);
        attach(shape.body == kWorld ? scenery_ : bodies_[shape.body], def, shape.collision->geometry,
               shape.X_BS);
    }

    std::size_t add_joint(const Joint& joint) override {
        const b3BodyId parent = joint.parent == kWorld ? scenery_ : bodies_[joint.parent];
        const b3BodyId child = joint.child == kWorld ? scenery_ : bodies_[joint.child];
        const auto fill = [&](b3JointDef& base, const Vec3& own_axis) {
            const Vec3 axis = joint.spec->axes.empty() ? own_axis : joint.spec->axes[0].xyz;
            const Pose turn{{}, turning(own_axis, axis)};
            base.bodyIdA = parent, base.bodyIdB = child;
            base.localFrameA = put(joint.X_PJ * turn), base.localFrameB = put(joint.X_CJ * turn);
            base.constraintHertz = to_float(kStiffHertz * substeps_ / dt_);
        };
        switch (joint.spec->kind) {
            case JointSpecKind::kBall: {
                b3SphericalJointDef def = b3DefaultSphericalJointDef();
                fill(def.base, {0, 0, 1});
                keep(b3CreateSphericalJoint(box_, &def), false);
                break;
            }
            case JointSpecKind::kFixed: {
                b3WeldJointDef def = b3DefaultWeldJointDef();
                fill(def.base, {0, 0, 1});
                keep(b3CreateWeldJoint(box_, &def), false);
                break;
            }
            case JointSpecKind::kPrismatic: {
                b3PrismaticJointDef def = b3DefaultPrismaticJointDef();
                fill(def.base, {1, 0, 0});
                const AxisSpec& axis = joint.spec->axes[0];
                def.enableLimit = axis.lower > -1e6 || axis.upper < 1e6;
                def.lowerTranslation = to_float(std::max(axis.lower, -1e6));
                def.upperTranslation = to_float(std::min(axis.upper, 1e6));
                keep(b3CreatePrismaticJoint(box_, &def), true);
                break;
            }
            default: {
                b3RevoluteJointDef def = b3DefaultRevoluteJointDef();
                fill(def.base, {0, 0, 1});
                const AxisSpec& axis = joint.spec->axes[0];
                const double most = 0.99 * kPi;
                def.enableLimit = joint.spec->kind != JointSpecKind::kContinuous &&
                                  (axis.lower > -most || axis.upper < most);
                def.lowerAngle = to_float(std::max(axis.lower, -most));
                def.upperAngle = to_float(std::min(axis.upper, most));
                keep(b3CreateRevoluteJoint(box_, &def), false);
            }
        }
        return joints_.size() - 1;
    }

    void set_motor(std::size_t joint, const Motor& motor) override {
        OwnJoint& own = joints_[joint];
        own.motor = motor;
        own.is_servo = !motor.holds_velocity;
        if (own.is_servo && !own.listed) servos_.push_back(joint), own.listed = true;
        const float most = to_float(std::min(motor.max_effort, 1e9));
        if (own.slides) {
            b3PrismaticJoint_EnableMotor(own.id, true);
            b3PrismaticJoint_SetMaxMotorForce(own.id, most);
            b3PrismaticJoint_SetMotorSpeed(own.id, to_float(motor.velocity));
        } else {
            b3RevoluteJoint_EnableMotor(own.id, true);
            b3RevoluteJoint_SetMaxMotorTorque(own.id, most);
            b3RevoluteJoint_SetMotorSpeed(own.id, to_float(motor.velocity));
        }
    }

    BodyState body_state(std::size_t body) const override {
        const b3BodyId id = bodies_[body];
        const b3WorldTransform X = b3Body_GetTransform(id);
        const Quat q = normalized(Quat{X.q.s, X.q.v.x, X.q.v.y, X.q.v.z});
        return {{{X.p.x, X.p.y, X.p.z}, q},
                take(b3Body_GetAngularVelocity(id)),
                take(b3Body_GetLinearVelocity(id))};
    }

    void set_body_state(std::size_t body, const BodyState& state) override {
        const b3BodyId id = bodies_[body];
        b3Body_SetTransform(id, put(state.X_WB.p), put(state.X_WB.q));
        b3Body_SetLinearVelocity(id, put(state.v_WC));
        b3Body_SetAngularVelocity(id, put(state.angular));
    }

    void push(std::size_t body, const Vec3& force_W, const Vec3& torque_W) override {
        if (norm_squared(force_W) > 0) b3Body_ApplyForceToCenter(bodies_[body], put(force_W), true);
        if (norm_squared(torque_W) > 0) b3Body_ApplyTorque(bodies_[body], put(torque_W), true);
    }

    void advance() override {
        for (const std::size_t joint : servos_) aim(joints_[joint]);
        b3World_Step(box_, to_float(dt_), substeps_);
    }

  private:
    struct OwnJoint {
        b3JointId id{};
        bool slides = false, is_servo = false, listed = false;
        Motor motor;
    };

    void keep(b3JointId id, bool slides) {
        OwnJoint& joint = joints_.emplace_back();
        joint.id = id, joint.slides = slides;
    }

    /// The speed at which an implicit PD wants the servo at the end of the tick.
    void aim(const OwnJoint& joint) const {
        if (!joint.is_servo) return;
        const Motor& m = joint.motor;
        const double q =
            joint.slides ? b3PrismaticJoint_GetTranslation(joint.id) : b3RevoluteJoint_GetAngle(joint.id);
        const double speed = m.stiffness * (m.position - q) / (m.stiffness * dt_ + m.damping);
        if (joint.slides) {
            b3PrismaticJoint_SetMotorSpeed(joint.id, to_float(speed));
        } else {
            b3RevoluteJoint_SetMotorSpeed(joint.id, to_float(speed));
        }
    }

    void attach(b3BodyId body, const b3ShapeDef& def, const GeometrySpec& g, const Pose& X_BS) {
        const Vec3 along = rotate(X_BS.q, {0, 0, 0.5 * g.length});
        switch (g.kind) {
            case GeometryKind::kSphere: {
                const b3Sphere sphere{put(X_BS.p), to_float(g.radius)};
                b3CreateSphereShape(body, &def, &sphere);
                return;
            }
            case GeometryKind::kCapsule: {
                const b3Capsule capsule{put(X_BS.p - along), put(X_BS.p + along), to_float(g.radius)};
                b3CreateCapsuleShape(body, &def, &capsule);
                return;
            }
            case GeometryKind::kCylinder: {
                b3CreateTransformedHullShape(body, &def, prism(g.radius, g.length), put(X_BS), {1, 1, 1});
                return;
            }
            case GeometryKind::kPlane: {
                const Pose X = X_BS * Pose{{0, 0, -kPlaneHalf}, {}};
                const b3BoxHull hull = b3MakeTransformedBoxHull(kPlaneHalf, kPlaneHalf, kPlaneHalf, put(X));
                b3CreateHullShape(body, &def, &hull.base);
                return;
            }
            default: {
                const Vec3 h = 0.5 * g.size;
                const b3BoxHull hull =
                    b3MakeTransformedBoxHull(to_float(h.x), to_float(h.y), to_float(h.z), put(X_BS));
                b3CreateHullShape(body, &def, &hull.base);
            }
        }
    }

    /// A prism about z, as long as the cylinder; made once for each size.
    const b3HullData* prism(double radius, double length) {
        std::unique_ptr<b3HullData, DestroyHull>& hull = prisms_[{radius, length}];
        if (!hull) {
            std::vector<b3Vec3> points;
            for (int i = 0; i < kSides; ++i) {
                const double angle = 2 * kPi * i / kSides;
                for (const double z : {-0.5 * length, 0.5 * length})
                    points.push_back(put(Vec3{radius * std::cos(angle), radius * std::sin(angle), z}));
            }
            hull.reset(b3CreateHull(points.data(), static_cast<int>(points.size()),
                                    static_cast<int>(points.size())));
        }
        return hull.get();
    }

    int substeps_;
    bool fast_;
    double scale_ = 1;
    b3WorldId box_{};
    b3BodyId scenery_{};
    std::vector<b3BodyId> bodies_;
    std::vector<OwnJoint> joints_;
    std::vector<std::size_t> servos_;
    std::map<std::pair<double, double>, std::unique_ptr<b3HullData, DestroyHull>> prisms_;
};

}  // namespace

std::unique_ptr<Engine> make_box3d(const World& world, const EngineOptions& options) {
    if (!BodyEngine::can(world)) return nullptr;
    const double substeps = (has_chains(world) ? 4 : 2) * std::max(1.0, options.accuracy);
    return std::make_unique<Box3dEngine>(world, options, static_cast<int>(std::lround(substeps)));
}

}  // namespace roboss::bench
