// ODE behind the common interface: rigid bodies in maximal coordinates, joints with ODE's own bounded motors.
// A servo is such a motor too: with target speed and softness (CFM) chosen so that its row is an implicit PD
// (ODE manual, "soft constraints").
#define dIDEDOUBLE
#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/check.h"
#include "engines/assembly.h"
#include "engines/makers.h"

namespace roboss::bench {
namespace {

constexpr int kContactsMax = 8;  // of a pair of shapes
constexpr double kInfinity = dInfinity;

void put(const Quat& q, dQuaternion out) {
    out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
}

/// A joint's axis: what drives it and what it feels by itself.
struct AxisDrive {
    enum class Kind { kPassive, kVelocity, kServo, kEffort } kind = Kind::kPassive;
    double velocity = 0, max_effort = 0, effort = 0;
    Engine::Servo servo;
};

struct OdeJoint {
    dJointID id = nullptr;
    const JointSpec* spec = nullptr;
    std::vector<AxisDrive> drives;
    bool needs_care = false;  // has springs, damping, servos or efforts: visited in every step
};

struct OdeInstance {
    Assembly assembly;
    std::vector<dBodyID> bodies;
    std::vector<OdeJoint> joints;  // by ModelSpec::joints
    dSpaceID space = nullptr;
    StartState start;
};

class OdeEngine final : public Engine {
  public:
    OdeEngine(const World& world, const EngineOptions& options, bool quick, int iterations)
        : world_(world), dt_(options.dt_s), quick_(quick), iterations_(iterations) {
        dInitODE2(0);
        dAllocateODEDataForThread(dAllocateMaskAll);
        ode_ = dWorldCreate();
        dWorldSetGravity(ode_, world.gravity.x, world.gravity.y, world.gravity.z);
        dWorldSetERP(ode_, 0.2);
        dWorldSetCFM(ode_, 1e-9);
        dWorldSetQuickStepNumIterations(ode_, iterations);
        dWorldSetContactSurfaceLayer(ode_, 1e-5);
        dWorldSetContactMaxCorrectingVel(ode_, 1.0);
        dWorldSetAutoDisableFlag(ode_, options.sleep ? 1 : 0);
        space_ = dHashSpaceCreate(nullptr);
        contacts_ = dJointGroupCreate(0);
        instances_.resize(world.instances.size());
        for (std::size_t i = 0; i < instances_.size(); ++i) build(i);
    }
    ~OdeEngine() override {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space_);
        dWorldDestroy(ode_);
        dCloseODE();
    }

    static bool can(const World& world) {
        for (const ModelSpec& model : world.prototypes) {
            for (const JointSpec& joint : model.joints) {
                const bool rotor = std::any_of(joint.axes.begin(), joint.axes.end(),
                                               [](const AxisSpec& a) { return a.armature > 0; });
                if (!is_common(joint.kind) || rotor) return false;
            }
            for (const LinkSpec& link : model.links)
                for (const CollisionSpec& c : link.collisions)
                    if (c.geometry.kind > GeometryKind::kCapsule) return false;
        }
        return true;
    }

    std::string name() const override { return std::string("ODE ") + dODE_VERSION; }
    std::string settings() const override {
        return std::string("double, ") +
               (quick_ ? "dWorldQuickStep, " + std::to_string(iterations_) + " iterations" : "dWorldStep") +
               ", a space a robot in a hash space";
    }

    void step(int ticks) override {
        if (!started_) start();
        for (int i = 0; i < ticks; ++i) {
            for (OdeJoint* joint : cared_) care_for(*joint);
            dSpaceCollide(space_, this, &near);
            if (quick_) {
                dWorldQuickStep(ode_, dt_);
            } else {
                dWorldStep(ode_, dt_);
            }
            dJointGroupEmpty(contacts_);
        }
    }

    LinkState link(LinkRef ref) const override {
        const OdeInstance& instance = instances_[ref.instance];
        const ModelInstance& spec = world_.instances[ref.instance];
        const int b = instance.assembly.body_of_link[ref.link];
        const Pose& X_BL = instance.assembly.X_BL[ref.link];
        if (b < 0) return {spec.X_WM * X_BL, {}, {}};
        const dBodyID body = instance.bodies[static_cast<std::size_t>(b)];
        const dReal *p = dBodyGetPosition(body), *q = dBodyGetQuaternion(body);
        const dReal *v = dBodyGetLinearVel(body), *w = dBodyGetAngularVel(body);
        const Vec3& p_BC = instance.assembly.bodies[static_cast<std::size_t>(b)].p_BC;
        BodyState state{{{}, {q[0], q[1], q[2], q[3]}}, {w[0], w[1], w[2]}, {v[0], v[1], v[2]}};
        state.X_WB.p = Vec3{p[0], p[1], p[2]} - rotate(state.X_WB.q, p_BC);
        return link_of_body(state, p_BC, X_BL, world_.prototypes[spec.prototype].links[ref.link].p_LC);
    }

    JointState joint(JointRef ref) const override {
        const OdeJoint& joint = instances_[ref.instance].joints[ref.joint];
        if (!started_) return instances_[ref.instance].start.joints[ref.joint][ref.axis];
        return state_of(joint);
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
        AxisDrive& drive = drive_of(ref);
        drive.kind = AxisDrive::Kind::kVelocity;
        const OdeJoint& joint = instances_[ref.instance].joints[ref.joint];
        set_param(joint, dParamVel, velocity);
        set_param(joint, dParamFMax, max_effort);
        set_param(joint, dParamCFM, 1e-9);
    }
    void drive_position(JointRef ref, const Servo& servo) override {
        AxisDrive& drive = drive_of(ref);
        const OdeJoint& joint = instances_[ref.instance].joints[ref.joint];
        if (drive.kind != AxisDrive::Kind::kServo || drive.servo.stiffness != servo.stiffness ||
            drive.servo.damping != servo.damping) {
            set_param(joint, dParamFMax, servo.max_effort);
            set_param(joint, dParamCFM, 1.0 / (servo.stiffness * dt_ + servo.damping));
        }
        drive.kind = AxisDrive::Kind::kServo;
        drive.servo = servo;
        care(ref);
    }
    void drive_effort(JointRef ref, double effort) override {
        AxisDrive& drive = drive_of(ref);
        drive.kind = AxisDrive::Kind::kEffort;
        drive.effort = effort;
        care(ref);
    }

  private:
    void build(std::size_t i) {
        const ModelInstance& spec = world_.instances[i];
        const ModelSpec& model = world_.prototypes[spec.prototype];
        OdeInstance& instance = instances_[i];
        instance.assembly = assemble(model);
        instance.start = start_state(model, spec.X_WM);
        const bool one_shape =
            instance.assembly.bodies.size() == 1 && instance.assembly.bodies[0].shapes.size() == 1;
        instance.space = model.is_static || one_shape ? space_ : dSimpleSpaceCreate(space_);
        const Vec3 belt = surface_velocity(model, spec.X_WM);
        for (const PartShape& shape : instance.assembly.scenery) add_scenery(shape, spec.X_WM, belt);
        for (const PartBody& part : instance.assembly.bodies)
            instance.bodies.push_back(add_body(part, instance.space, spec.X_WM));
        for (const JointSpec& joint : model.joints)
            instance.joints.push_back({nullptr, &joint, std::vector<AxisDrive>(joint.axes.size()), false});
        for (const PartJoint& joint : instance.assembly.joints) add_joint(joint, instance, spec.X_WM);
    }

    static dGeomID geometry(const GeometrySpec& g, dSpaceID space) {
        switch (g.kind) {
            case GeometryKind::kBox:
                return dCreateBox(space, g.size.x, g.size.y, g.size.z);
            case GeometryKind::kSphere:
                return dCreateSphere(space, g.radius);
            case GeometryKind::kCylinder:
                return dCreateCylinder(space, g.radius, g.length);
            default:
                return dCreateCapsule(space, g.radius, g.length);
        }
    }

    void finish(dGeomID geom, const CollisionSpec& collision, const Vec3& belt = {}) {
        dGeomSetData(geom, const_cast<SurfaceSpec*>(&collision.surface));
        if (norm_squared(belt) > 0) belts_[geom] = belt;
        dGeomSetCategoryBits(geom, collision.surface.collide_bitmask);
        dGeomSetCollideBits(geom, collision.surface.collide_bitmask);
    }

    void add_scenery(const PartShape& shape, const Pose& X_WM, const Vec3& belt) {
        const Pose X_WS = X_WM * shape.X_BS;
        dGeomID geom = nullptr;
        if (shape.collision->geometry.kind == GeometryKind::kPlane) {
            const Vec3 n = rotate(X_WS.q, {0, 0, 1});
            geom = dCreatePlane(space_, n.x, n.y, n.z, dot(n, X_WS.p));
        } else {
            geom = geometry(shape.collision->geometry, space_);
            dQuaternion q;
            put(X_WS.q, q);
            dGeomSetPosition(geom, X_WS.p.x, X_WS.p.y, X_WS.p.z);
            dGeomSetQuaternion(geom, q);
        }
        finish(geom, *shape.collision, belt);
    }

    dBodyID add_body(const PartBody& part, dSpaceID space, const Pose& X_WM) {
        const dBodyID body = dBodyCreate(ode_);
        dMass mass;
        const Mat3& I = part.inertia_C;
        dMassSetParameters(&mass, part.mass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
        dBodySetMass(body, &mass);
        dBodySetGravityMode(body, part.gravity ? 1 : 0);
        const Pose X_WB = X_WM * part.X_MB;
        move(body, {X_WB, {}, {}}, part.p_BC);
        for (const PartShape& shape : part.shapes) {
            const dGeomID geom = geometry(shape.collision->geometry, space);
            dGeomSetBody(geom, body);
            const Vec3 p = shape.X_BS.p - part.p_BC;
            dQuaternion q;
            put(shape.X_BS.q, q);
            if (norm(p) > 0) dGeomSetOffsetPosition(geom, p.x, p.y, p.z);
            if (std::fabs(shape.X_BS.q.w) < 1) dGeomSetOffsetQuaternion(geom, q);
            finish(geom, *shape.collision);
        }
        return body;
    }

    static void move(dBodyID body, const BodyState& state, const Vec3& p_BC) {
        const Vec3 p = state.X_WB * p_BC;
        dQuaternion q;
        put(state.X_WB.q, q);
        dBodySetPosition(body, p.x, p.y, p.z);
        dBodySetQuaternion(body, q);
        dBodySetLinearVel(body, state.v_WC.x, state.v_WC.y, state.v_WC.z);
        dBodySetAngularVel(body, state.angular.x, state.angular.y, state.angular.z);
    }

    void add_joint(const PartJoint& part, OdeInstance& instance, const Pose& X_WM) {
        const JointSpec& spec = *part.spec;
        OdeJoint& joint = instance.joints[part.index];
        const auto body = [&](int b) {
            return b < 0 ? nullptr : instance.bodies[static_cast<std::size_t>(b)];
        };
        // Of the file's direction: ODE measures the first body against the second.
        const dBodyID child = body(part.reversed ? part.parent : part.child);
        const dBodyID parent = body(part.reversed ? part.child : part.parent);
        const Pose X_WJ = X_WM * spec.X_MJ;
        const Vec3 d = spec.axes.empty() ? Vec3{} : rotate(X_WJ.q, spec.axes[0].xyz);
        switch (spec.kind) {
            case JointSpecKind::kBall:
                joint.id = dJointCreateBall(ode_, nullptr);
                dJointAttach(joint.id, child, parent);
                return dJointSetBallAnchor(joint.id, X_WJ.p.x, X_WJ.p.y, X_WJ.p.z);
            case JointSpecKind::kFixed:
                joint.id = dJointCreateFixed(ode_, nullptr);
                dJointAttach(joint.id, child, parent);
                return dJointSetFixed(joint.id);
            case JointSpecKind::kPrismatic:
                joint.id = dJointCreateSlider(ode_, nullptr);
                dJointAttach(joint.id, child, parent);
                dJointSetSliderAxis(joint.id, d.x, d.y, d.z);
                break;
            default:
                joint.id = dJointCreateHinge(ode_, nullptr);
                dJointAttach(joint.id, child, parent);
                dJointSetHingeAnchor(joint.id, X_WJ.p.x, X_WJ.p.y, X_WJ.p.z);
                dJointSetHingeAxis(joint.id, d.x, d.y, d.z);
        }
        set_limits(joint);
    }

    void set_limits(OdeJoint& joint) {
        const AxisSpec& axis = joint.spec->axes[0];
        const double most = joint.spec->kind == JointSpecKind::kPrismatic ? 1e15 : std::numbers::pi;
        if (joint.spec->kind != JointSpecKind::kContinuous) {  // ODE takes hinge stops within half a turn
            if (axis.lower > -most) set_param(joint, dParamLoStop, axis.lower);
            if (axis.upper < most) set_param(joint, dParamHiStop, axis.upper);
        }
        if (axis.friction > 0) set_param(joint, dParamVel, 0), set_param(joint, dParamFMax, axis.friction);
        if (axis.damping > 0 || axis.spring_stiffness > 0) joint.needs_care = true;
    }

    static void set_param(const OdeJoint& joint, int parameter, double value) {
        if (joint.spec->kind == JointSpecKind::kPrismatic) {
            dJointSetSliderParam(joint.id, parameter, value);
        } else {
            dJointSetHingeParam(joint.id, parameter, value);
        }
    }

    static JointState state_of(const OdeJoint& joint) {
        if (joint.spec->kind == JointSpecKind::kPrismatic)
            return {dJointGetSliderPosition(joint.id), dJointGetSliderPositionRate(joint.id)};
        return {dJointGetHingeAngle(joint.id), dJointGetHingeAngleRate(joint.id)};
    }

    static void push(const OdeJoint& joint, double effort) {
        if (joint.spec->kind == JointSpecKind::kPrismatic) {
            dJointAddSliderForce(joint.id, effort);
        } else {
            dJointAddHingeTorque(joint.id, effort);
        }
    }

    AxisDrive& drive_of(JointRef ref) { return instances_[ref.instance].joints[ref.joint].drives[ref.axis]; }
    void care(JointRef ref) {
        OdeJoint& joint = instances_[ref.instance].joints[ref.joint];
        if (started_ && !joint.needs_care) cared_.push_back(&joint);
        joint.needs_care = true;
    }

    void care_for(const OdeJoint& joint) {
        const AxisSpec& axis = joint.spec->axes[0];
        const AxisDrive& drive = joint.drives[0];
        const JointState state = state_of(joint);
        const double own =
            -axis.damping * state.velocity - axis.spring_stiffness * (state.position - axis.spring_reference);
        if (drive.kind == AxisDrive::Kind::kServo) {
            const Servo& s = drive.servo;
            set_param(joint, dParamVel,
                      s.stiffness * (s.position - state.position) / (s.stiffness * dt_ + s.damping));
        }
        const double effort = own + (drive.kind == AxisDrive::Kind::kEffort ? drive.effort : 0);
        if (effort != 0) push(joint, effort);
    }

    void start() {
        started_ = true;
        for (OdeInstance& instance : instances_) {
            const std::vector<BodyState> states = forward_kinematics(instance.assembly, instance.start);
            for (std::size_t b = 0; b < states.size(); ++b)
                move(instance.bodies[b], states[b], instance.assembly.bodies[b].p_BC);
            for (OdeJoint& joint : instance.joints)
                if (joint.needs_care && joint.id != nullptr) cared_.push_back(&joint);
        }
    }

    static void near(void* data, dGeomID a, dGeomID b) {
        if (dGeomIsSpace(a) || dGeomIsSpace(b)) return dSpaceCollide2(a, b, data, &near);
        auto& engine = *static_cast<OdeEngine*>(data);
        const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
        if (body_a == nullptr && body_b == nullptr) return;
        std::array<dContact, kContactsMax> contacts;
        const int count = dCollide(a, b, kContactsMax, &contacts[0].geom, sizeof(dContact));
        if (count == 0) return;
        const auto& A = *static_cast<const SurfaceSpec*>(dGeomGetData(a));
        const auto& B = *static_cast<const SurfaceSpec*>(dGeomGetData(b));
        for (int i = 0; i < count; ++i) {
            dContact& contact = contacts[static_cast<std::size_t>(i)];
            contact.surface = {};
            contact.surface.mode = dContactApprox1;
            contact.surface.mu = std::min(A.mu, B.mu);
            if (std::max(A.restitution, B.restitution) > 0) {
                contact.surface.mode |= dContactBounce;
                contact.surface.bounce = std::max(A.restitution, B.restitution);
                contact.surface.bounce_vel = std::max(A.bounce_threshold, B.bounce_threshold);
            }
            if (std::max(A.rolling_mu, B.rolling_mu) > 0) {
                contact.surface.mode |= dContactRolling;
                contact.surface.rho = std::max(A.rolling_mu, B.rolling_mu);
            }
            if (!engine.belts_.empty()) engine.move_along(contact, a, b);
            dJointAttach(dJointCreateContact(engine.ode_, engine.contacts_, &contact), body_a, body_b);
        }
    }

    /// ODE moves the body that is not part of the scenery along the first friction direction.
    void move_along(dContact& contact, dGeomID a, dGeomID b) const {
        for (const dGeomID geom : {a, b}) {
            const auto belt = belts_.find(geom);
            if (belt == belts_.end()) continue;
            const Vec3 n{contact.geom.normal[0], contact.geom.normal[1], contact.geom.normal[2]};
            const Vec3 along = belt->second - n * dot(belt->second, n);
            const double speed = norm(along);
            if (speed < 1e-9) continue;
            contact.surface.mode |= dContactFDir1 | dContactMotion1;
            contact.surface.motion1 = speed;
            contact.fdir1[0] = along.x / speed, contact.fdir1[1] = along.y / speed,
            contact.fdir1[2] = along.z / speed;
        }
    }

    const World& world_;
    std::map<dGeomID, Vec3> belts_;  // m/s, world axes
    double dt_;
    bool quick_;
    int iterations_;
    dWorldID ode_ = nullptr;
    dSpaceID space_ = nullptr;
    dJointGroupID contacts_ = nullptr;
    std::vector<OdeInstance> instances_;
    std::vector<OdeJoint*> cared_;
    bool started_ = false;
};

}  // namespace

std::unique_ptr<Engine> make_ode(const World& world, const EngineOptions& options) {
    if (!OdeEngine::can(world)) return nullptr;
    // dWorldStep (exact, Dantzig) was measured too: right as well, but 1.3 times slower on single cars and
    // more on crowds. 20 iterations is ODE's default; legs and arms sag with it.
    const bool quick = true;
    const double rounds = (has_chains(world) ? 40 : 20) * std::max(1.0, options.accuracy);
    const int iterations = static_cast<int>(std::lround(rounds));
    return std::make_unique<OdeEngine>(world, options, quick, iterations);
}

}  // namespace roboss::bench
