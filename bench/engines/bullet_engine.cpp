// Bullet behind the common interface: rigid bodies in double precision, hinges with Bullet's own bounded
// motors, sequential impulses. Bullet's hinge motor has no softness, so a servo is a motor whose target speed
// leads to the position with the time constant damping / stiffness.
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "engines/assembly.h"
#include "engines/makers.h"

namespace roboss::bench {
namespace {

btVector3 to_bullet(const Vec3& v) {
    return {v.x, v.y, v.z};
}
btTransform to_bullet(const Pose& X) {
    return btTransform(btQuaternion(X.q.x, X.q.y, X.q.z, X.q.w), to_bullet(X.p));
}
Vec3 from_bullet(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}
Pose from_bullet(const btTransform& X) {
    const btQuaternion q = X.getRotation();
    return {from_bullet(X.getOrigin()), {q.w(), q.x(), q.y(), q.z()}};
}

/// What a Bullet object is of; behind its user pointer.
struct Owner {
    std::size_t instance = 0;
    bool self_collide = false, is_static = false;
    const SurfaceSpec* surface = nullptr;
};

const Owner& owner_of(const btCollisionObject* object) {
    return *static_cast<const Owner*>(object->getUserPointer());
}

/// The smaller friction of two surfaces and the larger restitution, as everywhere here.
btScalar least_friction(const btCollisionObject* a, const btCollisionObject* b) {
    return std::min(owner_of(a).surface->mu, owner_of(b).surface->mu);
}
btScalar most_restitution(const btCollisionObject* a, const btCollisionObject* b) {
    return std::max(owner_of(a).surface->restitution, owner_of(b).surface->restitution);
}

/// Bodies of one model do not meet, unless it says so; nor do surfaces without a common bit.
struct PairFilter final : btOverlapFilterCallback {
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
        const Owner& A = owner_of(static_cast<btCollisionObject*>(a->m_clientObject));
        const Owner& B = owner_of(static_cast<btCollisionObject*>(b->m_clientObject));
        if (A.is_static && B.is_static) return false;
        if (A.instance == B.instance && !A.self_collide) return false;
        return (A.surface->collide_bitmask & B.surface->collide_bitmask) != 0;
    }
};

struct BulletBody {
    std::unique_ptr<btRigidBody> body;
    Pose X_BF;  // Bullet's frame (centre of mass, principal axes) in the body's
};

struct BulletJoint {
    std::unique_ptr<btTypedConstraint> constraint;
    btHingeConstraint* hinge = nullptr;
    const JointSpec* spec = nullptr;
    const btRigidBody *child = nullptr, *parent = nullptr;  // no parent: the world
    Vec3 axis_F;                                            // in the child's Bullet frame
    bool servo_on = false;
    Engine::Servo servo;
    double effort = 0;
};

struct BulletInstance {
    Assembly assembly;
    std::vector<BulletBody> bodies;
    std::vector<BulletJoint> joints;
    StartState start;
};

class BulletEngine final : public Engine {
  public:
    BulletEngine(const World& world, const EngineOptions& options)
        : world_(world),
          dt_(options.dt_s),
          sleep_(options.sleep),
          iterations_(static_cast<int>((has_chains(world) ? 60 : 20) * std::max(1.0, options.accuracy))) {
        gCalculateCombinedFrictionCallback = [](auto* a, auto* b) { return least_friction(a, b); };
        gCalculateCombinedRestitutionCallback = [](auto* a, auto* b) { return most_restitution(a, b); };
        gContactBreakingThreshold = 0.005;  // the default of 2 cm suits bodies of a metre
        broadphase_.getOverlappingPairCache()->setOverlapFilterCallback(&filter_);
        bullet_.setGravity(to_bullet(world.gravity));
        bullet_.getSolverInfo().m_numIterations = iterations_;
        bullet_.getSolverInfo().m_restitutionVelocityThreshold = 0.01;
        bullet_.getSolverInfo().m_minimumSolverBatchSize = 1;
        bullet_.setForceUpdateAllAabbs(false);
        instances_.resize(world.instances.size());
        owners_.reserve(10 * instances_.size() + 1000);
        for (std::size_t i = 0; i < instances_.size(); ++i) build(i);
    }
    ~BulletEngine() override {
        for (BulletInstance& instance : instances_) {
            for (BulletJoint& joint : instance.joints)
                if (joint.constraint) bullet_.removeConstraint(joint.constraint.get());
            for (BulletBody& body : instance.bodies) bullet_.removeRigidBody(body.body.get());
        }
        for (auto& body : scenery_) bullet_.removeRigidBody(body.get());
    }

    static bool can(const World& world) {
        for (const ModelSpec& model : world.prototypes) {
            for (const JointSpec& joint : model.joints) {
                const bool known =
                    joint.kind == JointSpecKind::kFixed || joint.kind == JointSpecKind::kRevolute ||
                    joint.kind == JointSpecKind::kContinuous || joint.kind == JointSpecKind::kBall;
                const bool rotor = std::any_of(joint.axes.begin(), joint.axes.end(),
                                               [](const AxisSpec& a) { return a.armature > 0; });
                if (!known || rotor) return false;
            }
            for (const LinkSpec& link : model.links)
                for (const CollisionSpec& c : link.collisions)
                    if (c.geometry.kind > GeometryKind::kCapsule) return false;
        }
        return true;
    }

    std::string name() const override {
        return "Bullet " + std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100);
    }
    std::string settings() const override {
        return "double, rigid bodies and hinges, sequential impulses, " + std::to_string(iterations_) +
               " iterations, split impulse";
    }

    void step(int ticks) override {
        if (!started_) start();
        for (int i = 0; i < ticks; ++i) {
            for (BulletInstance& instance : instances_)
                for (BulletJoint& joint : instance.joints) care_for(joint);
            bullet_.stepSimulation(dt_, 0);
        }
    }

    LinkState link(LinkRef ref) const override {
        const BulletInstance& instance = instances_[ref.instance];
        const ModelInstance& spec = world_.instances[ref.instance];
        const int b = instance.assembly.body_of_link[ref.link];
        const Pose& X_BL = instance.assembly.X_BL[ref.link];
        if (b < 0) return {spec.X_WM * X_BL, {}, {}};
        const BulletBody& body = instance.bodies[static_cast<std::size_t>(b)];
        const BodyState state{from_bullet(body.body->getWorldTransform()) * inverse(body.X_BF),
                              from_bullet(body.body->getAngularVelocity()),
                              from_bullet(body.body->getLinearVelocity())};
        return link_of_body(state, body.X_BF.p, X_BL, world_.prototypes[spec.prototype].links[ref.link].p_LC);
    }

    JointState joint(JointRef ref) const override {
        const BulletJoint& joint = instances_[ref.instance].joints[ref.joint];
        if (!started_) return instances_[ref.instance].start.joints[ref.joint][ref.axis];
        return {joint.hinge->getHingeAngle(), speed_of(joint)};
    }

    void set_joint(JointRef ref, JointState state) override {
        ROBOSS_CHECK(!started_, "before the first step");
        instances_[ref.instance].start.joints[ref.joint][ref.axis] = state;
    }

    void set_base(std::size_t instance, const Pose& X_WM, const Vec3& angular, const Vec3& linear) override {
        ROBOSS_CHECK(!started_, "before the first step");
        StartState& start = instances_[instance].start;
        start.X_WM = X_WM, start.angular = angular, start.linear = linear;
    }

    void drive_velocity(JointRef ref, double velocity, double max_effort) override {
        BulletJoint& joint = joint_of(ref);
        joint.servo_on = false;
        joint.hinge->enableAngularMotor(true, velocity, max_effort * dt_);
    }
    void drive_position(JointRef ref, const Servo& servo) override {
        BulletJoint& joint = joint_of(ref);
        joint.servo_on = true;
        joint.servo = servo;
        joint.hinge->enableAngularMotor(true, 0, servo.max_effort * dt_);
    }
    void drive_effort(JointRef ref, double effort) override {
        BulletJoint& joint = joint_of(ref);
        joint.hinge->enableMotor(false);
        joint.servo_on = false;
        joint.effort = effort;
    }

  private:
    void build(std::size_t i) {
        const ModelInstance& spec = world_.instances[i];
        const ModelSpec& model = world_.prototypes[spec.prototype];
        BulletInstance& instance = instances_[i];
        instance.assembly = assemble(model);
        instance.start = start_state(model, spec.X_WM);
        for (const PartShape& shape : instance.assembly.scenery) add_scenery(shape, i);
        for (const PartBody& part : instance.assembly.bodies) {
            instance.bodies.push_back(make_body(part, spec.X_WM, i, model.self_collide));
            bullet_.addRigidBody(instance.bodies.back().body.get());
            if (!part.gravity) instance.bodies.back().body->setGravity({0, 0, 0});
        }
        for (const JointSpec& joint : model.joints) {
            instance.joints.emplace_back();
            instance.joints.back().spec = &joint;
        }
        for (const PartJoint& joint : instance.assembly.joints) add_joint(joint, instance, spec.X_WM);
    }

    btCollisionShape* shape_of(const GeometrySpec& g) {
        switch (g.kind) {
            case GeometryKind::kPlane:
                shapes_.push_back(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0));
                break;
            case GeometryKind::kBox:
                shapes_.push_back(std::make_unique<btBoxShape>(to_bullet(g.size * 0.5)));
                break;
            case GeometryKind::kSphere:
                shapes_.push_back(std::make_unique<btSphereShape>(g.radius));
                break;
            case GeometryKind::kCylinder:
                shapes_.push_back(
                    std::make_unique<btCylinderShapeZ>(btVector3(g.radius, g.radius, 0.5 * g.length)));
                break;
            default:
                shapes_.push_back(std::make_unique<btCapsuleShapeZ>(g.radius, g.length));
        }
        return shapes_.back().get();
    }

    /// All shapes of a body, in Bullet's frame.
    btCollisionShape* shape_of(const PartBody& part, const Pose& X_BF) {
        if (part.shapes.empty()) {
            shapes_.push_back(std::make_unique<btEmptyShape>());
            return shapes_.back().get();
        }
        const Pose X_FS = inverse(X_BF) * part.shapes[0].X_BS;
        const bool in_place = norm(X_FS.p) < 1e-12 && std::fabs(X_FS.q.w) > 1 - 1e-12;
        if (part.shapes.size() == 1 && in_place) return shape_of(part.shapes[0].collision->geometry);
        auto compound = std::make_unique<btCompoundShape>(part.shapes.size() > 4);
        for (const PartShape& shape : part.shapes)
            compound->addChildShape(to_bullet(inverse(X_BF) * shape.X_BS),
                                    shape_of(shape.collision->geometry));
        shapes_.push_back(std::move(compound));
        return shapes_.back().get();
    }

    void label(btRigidBody& body, Owner owner) {
        static const SurfaceSpec bare;
        if (owner.surface == nullptr) owner.surface = &bare;
        owners_.push_back(std::make_unique<Owner>(owner));
        body.setUserPointer(owners_.back().get());
        body.setFriction(owner.surface->mu);
        body.setRestitution(owner.surface->restitution);
        body.setRollingFriction(owner.surface->rolling_mu);
        if (!sleep_) body.setActivationState(DISABLE_DEACTIVATION);
    }

    void add_scenery(const PartShape& shape, std::size_t i) {
        btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shape_of(shape.collision->geometry));
        info.m_startWorldTransform = to_bullet(world_.instances[i].X_WM * shape.X_BS);
        scenery_.push_back(std::make_unique<btRigidBody>(info));
        label(*scenery_.back(), {i, false, true, &shape.collision->surface});
        bullet_.addRigidBody(scenery_.back().get());
    }

    BulletBody make_body(const PartBody& part, const Pose& X_WM, std::size_t i, bool self_collide) {
        const PrincipalAxes axes = principal_axes(part.inertia_C);
        BulletBody made;
        made.X_BF = {part.p_BC, to_quat(axes.R)};
        btRigidBody::btRigidBodyConstructionInfo info(part.mass, nullptr, shape_of(part, made.X_BF),
                                                      to_bullet(axes.moments));
        info.m_startWorldTransform = to_bullet(X_WM * part.X_MB * made.X_BF);
        made.body = std::make_unique<btRigidBody>(info);
        made.body->setFlags(BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
        label(*made.body,
              {i, self_collide, false, part.shapes.empty() ? nullptr : &part.shapes[0].collision->surface});
        return made;
    }

    /// Joints are made where the model stands at zero, so that their angles count from there.
    void add_joint(const PartJoint& part, BulletInstance& instance, const Pose& X_WM) {
        BulletJoint& joint = instance.joints[part.index];
        const auto body = [&](int b) {
            return b < 0 ? nullptr : instance.bodies[static_cast<std::size_t>(b)].body.get();
        };
        btRigidBody* child = body(part.reversed ? part.parent : part.child);
        btRigidBody* parent = body(part.reversed ? part.child : part.parent);
        ROBOSS_CHECK(child != nullptr, "a joint's child is a link");
        // Bullet's hinges turn about z of their frames.
        const JointSpec& spec = *part.spec;
        Pose X_WJ = X_WM * spec.X_MJ;
        if (!spec.axes.empty()) X_WJ = X_WJ * Pose{{}, z_along(spec.axes[0].xyz)};
        const btTransform X_W = to_bullet(X_WJ);
        btRigidBody& base = parent != nullptr ? *parent : btTypedConstraint::getFixedBody();
        const btTransform in_base = base.getWorldTransform().inverse() * X_W;
        const btTransform in_child = child->getWorldTransform().inverse() * X_W;
        if (spec.kind == JointSpecKind::kBall) {
            joint.constraint = std::make_unique<btPoint2PointConstraint>(base, *child, in_base.getOrigin(),
                                                                         in_child.getOrigin());
        } else if (spec.kind == JointSpecKind::kFixed) {
            joint.constraint = std::make_unique<btFixedConstraint>(base, *child, in_base, in_child);
        } else {
            auto hinge = std::make_unique<btHingeConstraint>(base, *child, in_base, in_child, true);
            joint.hinge = hinge.get();
            joint.constraint = std::move(hinge);
            joint.axis_F = from_bullet(in_child.getBasis().getColumn(2));
            const AxisSpec& axis = spec.axes[0];
            const bool limited = spec.kind == JointSpecKind::kRevolute && axis.lower > -std::numbers::pi &&
                                 axis.upper < std::numbers::pi;
            if (limited) joint.hinge->setLimit(axis.lower, axis.upper);
            if (axis.friction > 0) joint.hinge->enableAngularMotor(true, 0, axis.friction * dt_);
        }
        joint.child = child, joint.parent = parent;
        bullet_.addConstraint(joint.constraint.get(), true);
    }

    static Quat z_along(const Vec3& axis) {
        Vec3 x, y;
        tangents(axis, x, y);
        return to_quat(transpose(Mat3{x, y, axis}));
    }

    double speed_of(const BulletJoint& joint) const {
        const btVector3 axis = joint.child->getWorldTransform().getBasis() * to_bullet(joint.axis_F);
        btVector3 relative = joint.child->getAngularVelocity();
        if (joint.parent != nullptr) relative -= joint.parent->getAngularVelocity();
        return axis.dot(relative);
    }

    BulletJoint& joint_of(JointRef ref) {
        BulletJoint& joint = instances_[ref.instance].joints[ref.joint];
        ROBOSS_CHECK(joint.hinge != nullptr, "a hinge");
        return joint;
    }

    void care_for(BulletJoint& joint) const {
        if (joint.hinge == nullptr) return;
        if (joint.servo_on) {
            const Servo& s = joint.servo;
            joint.hinge->setMotorTargetVelocity(s.stiffness * (s.position - joint.hinge->getHingeAngle()) /
                                                (s.stiffness * dt_ + s.damping));
        }
        const AxisSpec& axis = joint.spec->axes[0];
        if (joint.effort == 0 && axis.damping == 0 && axis.spring_stiffness == 0) return;
        const double spring = axis.spring_stiffness * (axis.spring_reference - joint.hinge->getHingeAngle());
        const btVector3 torque = joint.child->getWorldTransform().getBasis() * to_bullet(joint.axis_F) *
                                 (joint.effort + spring - axis.damping * speed_of(joint));
        const_cast<btRigidBody*>(joint.child)->applyTorque(torque);
        if (joint.parent != nullptr) const_cast<btRigidBody*>(joint.parent)->applyTorque(-torque);
    }

    void start() {
        started_ = true;
        for (BulletInstance& instance : instances_) {
            const std::vector<BodyState> states = forward_kinematics(instance.assembly, instance.start);
            for (std::size_t b = 0; b < states.size(); ++b) {
                btRigidBody& body = *instance.bodies[b].body;
                const btTransform X_WF = to_bullet(states[b].X_WB * instance.bodies[b].X_BF);
                body.setWorldTransform(X_WF);
                body.setInterpolationWorldTransform(X_WF);
                body.setLinearVelocity(to_bullet(states[b].v_WC));
                body.setAngularVelocity(to_bullet(states[b].angular));
                body.updateInertiaTensor();
            }
        }
    }

    const World& world_;
    double dt_;
    bool sleep_;
    int iterations_;
    PairFilter filter_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld bullet_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<Owner>> owners_;
    std::vector<std::unique_ptr<btRigidBody>> scenery_;
    std::vector<BulletInstance> instances_;
    bool started_ = false;
};

}  // namespace

std::unique_ptr<Engine> make_bullet(const World& world, const EngineOptions& options) {
    return !has_belts(world) && BulletEngine::can(world) ? std::make_unique<BulletEngine>(world, options)
                                                         : nullptr;
}

}  // namespace roboss::bench
