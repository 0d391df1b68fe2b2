// DART behind the common interface: generalised coordinates, DART's boxed LCP for contacts and servos, ODE's
// narrow phase (the only one of DART's that knows all shapes well). A servo is a bounded row whose target
// speed leads to the position with the time constant damping / stiffness.
#include <dart/collision/ode/ode.hpp>
#include <dart/dart.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/check.h"
#include "engines/assembly.h"
#include "engines/makers.h"

namespace roboss::bench {
namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::Skeleton;
using dart::dynamics::SkeletonPtr;

Eigen::Vector3d to_dart(const Vec3& v) {
    return {v.x, v.y, v.z};
}
Eigen::Isometry3d to_dart(const Pose& X) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = Eigen::Quaterniond(X.q.w, X.q.x, X.q.y, X.q.z).toRotationMatrix();
    T.translation() = to_dart(X.p);
    return T;
}
Vec3 from_dart(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}
Pose from_dart(const Eigen::Isometry3d& T) {
    const Eigen::Quaterniond q(T.linear());
    return {from_dart(T.translation()), {q.w(), q.x(), q.y(), q.z()}};
}

struct DartServo {
    dart::dynamics::Joint* joint = nullptr;
    std::size_t axis = 0;
    Engine::Servo servo;
};

struct DartInstance {
    Assembly assembly;
    SkeletonPtr skeleton;
    std::vector<BodyNode*> bodies;
    std::vector<dart::dynamics::Joint*> joints;  // by ModelSpec::joints; nullptr: none
    std::vector<std::vector<int>> servos;        // by joint and axis: index into servos_; -1: none
};

class DartEngine final : public Engine {
  public:
    DartEngine(const World& world, const EngineOptions& options)
        : world_(world), dart_(dart::simulation::World::create()) {
        dart_->setTimeStep(options.dt_s);
        dart_->setGravity(to_dart(world.gravity));
        dart_->getConstraintSolver()->setCollisionDetector(dart::collision::OdeCollisionDetector::create());
        auto& collision = dart_->getConstraintSolver()->getCollisionOption();
        collision.maxNumContacts = 20 * world.instances.size() + 1000;
        instances_.resize(world.instances.size());
        for (std::size_t i = 0; i < instances_.size(); ++i) build(i);
    }

    static bool can(const World& world) {
        for (const ModelSpec& model : world.prototypes) {
            for (const PartJoint& joint : assemble(model).joints) {
                const bool rotor = std::any_of(joint.spec->axes.begin(), joint.spec->axes.end(),
                                               [](const AxisSpec& a) { return a.armature > 0; });
                if (joint.closes_loop || joint.reversed || !is_common(joint.spec->kind) || rotor)
                    return false;
            }
            for (const LinkSpec& link : model.links)
                for (const CollisionSpec& c : link.collisions)
                    if (c.geometry.kind > GeometryKind::kCapsule) return false;
        }
        return true;
    }

    std::string name() const override { return std::string("DART ") + DART_VERSION; }
    std::string settings() const override {
        return "double, Featherstone, boxed LCP (Dantzig, then PGS), ODE's narrow phase";
    }

    /// DART ends the process by an assertion once a number is none.
    void stop_if_lost() const {
        constexpr double kFastest = 1e8;  // rad/s, m/s
        for (std::size_t i = 0; i < dart_->getNumSkeletons(); ++i) {
            const Eigen::VectorXd v = dart_->getSkeleton(i)->getVelocities();
            if (v.size() > 0 && !(v.cwiseAbs().maxCoeff() < kFastest))
                throw std::runtime_error("DART: a state is not finite");
        }
    }

    void step(int ticks) override {
        for (int i = 0; i < ticks; ++i) {
            const double dt = dart_->getTimeStep();
            for (const DartServo& s : servos_)
                s.joint->setCommand(s.axis, s.servo.stiffness *
                                                (s.servo.position - s.joint->getPosition(s.axis)) /
                                                (s.servo.stiffness * dt + s.servo.damping));
            dart_->step(false);
            stop_if_lost();
        }
    }

    LinkState link(LinkRef ref) const override {
        const DartInstance& instance = instances_[ref.instance];
        const ModelInstance& spec = world_.instances[ref.instance];
        const int b = instance.assembly.body_of_link[ref.link];
        const Pose& X_BL = instance.assembly.X_BL[ref.link];
        if (b < 0) return {spec.X_WM * X_BL, {}, {}};
        const BodyNode* body = instance.bodies[static_cast<std::size_t>(b)];
        const Vec3& p_LC = world_.prototypes[spec.prototype].links[ref.link].p_LC;
        return {from_dart(body->getWorldTransform()) * X_BL, from_dart(body->getAngularVelocity()),
                from_dart(body->getLinearVelocity(to_dart(X_BL * p_LC)))};
    }

    JointState joint(JointRef ref) const override {
        const dart::dynamics::Joint* joint = joint_of(ref);
        return {joint->getPosition(ref.axis), joint->getVelocity(ref.axis)};
    }

    void set_joint(JointRef ref, JointState state) override {
        joint_of(ref)->setPosition(ref.axis, state.position);
        joint_of(ref)->setVelocity(ref.axis, state.velocity);
    }

    void set_base(std::size_t instance, const Pose& X_WM, const Vec3& angular, const Vec3& linear) override {
        const DartInstance& placed = instances_[instance];
        auto* base = dynamic_cast<dart::dynamics::FreeJoint*>(placed.skeleton->getJoint(0));
        ROBOSS_CHECK(base != nullptr, "a free base");
        const PartBody& part = placed.assembly.bodies[0];
        const Pose X_WB = X_WM * part.X_MB;
        base->setTransform(to_dart(X_WB));
        base->setAngularVelocity(to_dart(angular));
        base->setLinearVelocity(to_dart(linear - cross(angular, rotate(X_WB.q, part.p_BC))));
    }

    void drive_velocity(JointRef ref, double velocity, double max_effort) override {
        make_servo(ref, max_effort)->setCommand(ref.axis, velocity);
    }
    void drive_position(JointRef ref, const Servo& servo) override {
        int& index = instances_[ref.instance].servos[ref.joint][ref.axis];
        if (index < 0) {
            index = static_cast<int>(servos_.size());
            servos_.push_back({make_servo(ref, servo.max_effort), ref.axis, servo});
        }
        servos_[static_cast<std::size_t>(index)].servo = servo;
    }
    void drive_effort(JointRef ref, double effort) override {
        joint_of(ref)->setActuatorType(dart::dynamics::Joint::FORCE);
        joint_of(ref)->setCommand(ref.axis, effort);
    }

  private:
    dart::dynamics::Joint* make_servo(JointRef ref, double max_effort) {
        dart::dynamics::Joint* joint = joint_of(ref);
        if (joint->getActuatorType() != dart::dynamics::Joint::SERVO)
            joint->setActuatorType(dart::dynamics::Joint::SERVO);
        joint->setForceLowerLimit(ref.axis, -max_effort);
        joint->setForceUpperLimit(ref.axis, max_effort);
        return joint;
    }

    dart::dynamics::Joint* joint_of(JointRef ref) const {
        dart::dynamics::Joint* joint = instances_[ref.instance].joints[ref.joint];
        ROBOSS_CHECK(joint != nullptr, "a joint that moves");
        return joint;
    }

    void build(std::size_t i) {
        const ModelInstance& spec = world_.instances[i];
        const ModelSpec& model = world_.prototypes[spec.prototype];
        DartInstance& instance = instances_[i];
        instance.assembly = assemble(model);
        instance.skeleton = Skeleton::create(spec.name);
        instance.joints.assign(model.joints.size(), nullptr);
        for (const JointSpec& joint : model.joints)
            instance.servos.emplace_back(std::max<std::size_t>(joint.axes.size(), 1), -1);
        if (!instance.assembly.scenery.empty()) {
            auto pair = instance.skeleton->createJointAndBodyNodePair<dart::dynamics::WeldJoint>();
            for (const PartShape& shape : instance.assembly.scenery)
                add_shape(*pair.second, {shape.collision, spec.X_WM * shape.X_BS});
        }
        for (const PartBody& part : instance.assembly.bodies) add_body(part, spec.X_WM, model, instance);
        if (model.is_static) instance.skeleton->setMobile(false);
        instance.skeleton->setSelfCollisionCheck(model.self_collide);
        instance.skeleton->setAdjacentBodyCheck(false);
        dart_->addSkeleton(instance.skeleton);
    }

    template <class Joint>
    BodyNode* add_pair(DartInstance& instance, BodyNode* parent,
                       const typename Joint::Properties& properties) {
        typename Joint::Properties named =
            properties;  // DART prints a line for every name that it must make up
        named.mName = "joint_" + std::to_string(instance.bodies.size());
        const BodyNode::AspectProperties body("body_" + std::to_string(instance.bodies.size()));
        return instance.skeleton->createJointAndBodyNodePair<Joint>(parent, named, body).second;
    }

    void add_body(const PartBody& part, const Pose& X_WM, const ModelSpec& model, DartInstance& instance) {
        BodyNode* body = nullptr;
        if (part.joint < 0) {
            body = add_pair<dart::dynamics::FreeJoint>(instance, nullptr, {});
            static_cast<dart::dynamics::FreeJoint*>(body->getParentJoint())
                ->setTransform(to_dart(X_WM * part.X_MB));
        } else {
            const PartJoint& joint = instance.assembly.joints[static_cast<std::size_t>(part.joint)];
            body = add_joint(part, joint, X_WM, instance);
            instance.joints[joint.index] = body->getParentJoint();
            set_axes(model.joints[joint.index], *body->getParentJoint());
        }
        const Mat3& I = part.inertia_C;
        Eigen::Matrix3d inertia;
        inertia << I(0, 0), I(0, 1), I(0, 2), I(1, 0), I(1, 1), I(1, 2), I(2, 0), I(2, 1), I(2, 2);
        body->setInertia(dart::dynamics::Inertia(part.mass, to_dart(part.p_BC), inertia));
        body->setGravityMode(part.gravity);
        for (const PartShape& shape : part.shapes) add_shape(*body, shape);
        instance.bodies.push_back(body);
    }

    BodyNode* add_joint(const PartBody& part, const PartJoint& joint, const Pose& X_WM,
                        DartInstance& instance) {
        const JointSpec& spec = *joint.spec;
        const bool on_world = joint.parent < 0;
        const auto parent = static_cast<std::size_t>(joint.parent);
        BodyNode* parent_body = on_world ? nullptr : instance.bodies[parent];
        dart::dynamics::Joint::Properties places;
        places.mT_ParentBodyToJoint =
            to_dart(on_world ? X_WM * spec.X_MJ : inverse(instance.assembly.bodies[parent].X_MB) * spec.X_MJ);
        places.mT_ChildBodyToJoint = to_dart(inverse(part.X_MB) * spec.X_MJ);
        if (spec.kind == JointSpecKind::kBall) {
            dart::dynamics::BallJoint::Properties ball;
            static_cast<dart::dynamics::Joint::Properties&>(ball) = places;
            return add_pair<dart::dynamics::BallJoint>(instance, parent_body, ball);
        }
        const Eigen::Vector3d axis = to_dart(spec.axes[0].xyz);
        if (spec.kind == JointSpecKind::kPrismatic) {
            dart::dynamics::PrismaticJoint::Properties slide;
            static_cast<dart::dynamics::Joint::Properties&>(slide) = places;
            slide.mAxis = axis;
            return add_pair<dart::dynamics::PrismaticJoint>(instance, parent_body, slide);
        }
        dart::dynamics::RevoluteJoint::Properties hinge;
        static_cast<dart::dynamics::Joint::Properties&>(hinge) = places;
        hinge.mAxis = axis;
        return add_pair<dart::dynamics::RevoluteJoint>(instance, parent_body, hinge);
    }

    static void set_axes(const JointSpec& spec, dart::dynamics::Joint& joint) {
        for (std::size_t a = 0; a < spec.axes.size(); ++a) {
            const AxisSpec& axis = spec.axes[a];
            joint.setDampingCoefficient(a, axis.damping);
            joint.setSpringStiffness(a, axis.spring_stiffness);
            joint.setRestPosition(a, axis.spring_reference);
            joint.setCoulombFriction(a, axis.friction);
            joint.setPosition(a, axis.initial_position);
            if (spec.kind == JointSpecKind::kContinuous || axis.lower < -1e15) continue;
            joint.setPositionLowerLimit(a, axis.lower);
            joint.setPositionUpperLimit(a, axis.upper);
            joint.setLimitEnforcement(true);
        }
    }

    static void add_shape(BodyNode& body, const PartShape& part) {
        const GeometrySpec& g = part.collision->geometry;
        dart::dynamics::ShapePtr shape;
        switch (g.kind) {
            case GeometryKind::kPlane:
                shape = std::make_shared<dart::dynamics::PlaneShape>(Eigen::Vector3d::UnitZ(), 0.0);
                break;
            case GeometryKind::kBox:
                shape = std::make_shared<dart::dynamics::BoxShape>(to_dart(g.size));
                break;
            case GeometryKind::kSphere:
                shape = std::make_shared<dart::dynamics::SphereShape>(g.radius);
                break;
            case GeometryKind::kCylinder:
                shape = std::make_shared<dart::dynamics::CylinderShape>(g.radius, g.length);
                break;
            default:
                shape = std::make_shared<dart::dynamics::CapsuleShape>(g.radius, g.length);
        }
        auto* node =
            body.createShapeNodeWith<dart::dynamics::CollisionAspect, dart::dynamics::DynamicsAspect>(shape);
        node->setRelativeTransform(to_dart(part.X_BS));
        node->getDynamicsAspect()->setFrictionCoeff(part.collision->surface.mu);
        // DART multiplies those of the two: with their roots, equal surfaces get what they have.
        node->getDynamicsAspect()->setRestitutionCoeff(std::sqrt(part.collision->surface.restitution));
    }

    const World& world_;
    dart::simulation::WorldPtr dart_;
    std::vector<DartInstance> instances_;
    std::vector<DartServo> servos_;
};

}  // namespace

std::unique_ptr<Engine> make_dart(const World& world, const EngineOptions& options) {
    const bool cannot = has_belts(world) || options.sleep;
    return !cannot && DartEngine::can(world) ? std::make_unique<DartEngine>(world, options) : nullptr;
}

}  // namespace roboss::bench
