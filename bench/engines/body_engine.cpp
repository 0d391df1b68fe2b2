// See body_engine.h.
#include "engines/body_engine.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace roboss::bench {
namespace {

bool slides(const JointSpec& joint) {
    return joint.kind == JointSpecKind::kPrismatic;
}

bool can_joint(const JointSpec& joint) {
    return is_common(joint.kind) && std::all_of(joint.axes.begin(), joint.axes.end(),
                                                [](const AxisSpec& axis) { return axis.armature == 0; });
}

}  // namespace

bool BodyEngine::can(const World& world) {
    for (const ModelSpec& model : world.prototypes) {
        if (!std::all_of(model.joints.begin(), model.joints.end(), can_joint)) return false;
        for (const LinkSpec& link : model.links)
            for (const CollisionSpec& c : link.collisions)
                if (c.geometry.kind > GeometryKind::kCapsule) return false;
    }
    return true;
}

Quat BodyEngine::turning(const Vec3& from, const Vec3& to) {
    const Vec3 axis = cross(from, to);
    const double sine = norm(axis), angle = std::atan2(sine, dot(from, to));
    if (sine > 1e-12) return axis_angle(axis / sine, angle);
    if (angle < 1) return {};
    const Vec3 aside = cross(from, std::fabs(from.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
    return axis_angle(aside / norm(aside), kPi);
}

void BodyEngine::build() {
    instances_.resize(world_.instances.size());
    for (std::size_t i = 0; i < instances_.size(); ++i) build(i);
}

void BodyEngine::build(std::size_t i) {
    const ModelInstance& spec = world_.instances[i];
    const ModelSpec& model = world_.prototypes[spec.prototype];
    Instance& instance = instances_[i];
    instance.assembly = assemble(model);
    instance.start = start_state(model, spec.X_WM);
    instance.joints.resize(model.joints.size());
    add_shapes(instance.assembly.scenery, i, kWorld);
    for (const PartBody& part : instance.assembly.bodies) {
        instance.bodies.push_back(add_body(part));
        ROBOSS_CHECK(instance.bodies.back() == centres_.size(), "bodies are numbered in order");
        centres_.push_back(part.p_BC);
        set_body_state(instance.bodies.back(), {spec.X_WM * part.X_MB, {}, {}});
        add_shapes(part.shapes, i, instance.bodies.back());
    }
    for (const PartJoint& part : instance.assembly.joints) {
        const auto body = [&](int b) {
            return b < 0 ? kWorld : instance.bodies[static_cast<std::size_t>(b)];
        };
        const auto frame = [&](int b) {
            if (b < 0) return spec.X_WM * part.spec->X_MJ;
            return inverse(instance.assembly.bodies[static_cast<std::size_t>(b)].X_MB) * part.spec->X_MJ;
        };
        const int parent = part.reversed ? part.child : part.parent;
        const int child = part.reversed ? part.parent : part.child;
        Driven& driven = *(instance.joints[part.index] = std::make_unique<Driven>());
        driven.joint = {part.spec, body(parent), body(child), frame(parent), frame(child)};
        driven.id = add_joint(driven.joint);
        if (part.spec->axes.empty() || part.spec->kind == JointSpecKind::kBall) continue;
        const AxisSpec& axis = part.spec->axes[0];
        if (axis.friction > 0) set_motor(driven.id, {.max_effort = axis.friction, .holds_velocity = true});
        if (axis.damping > 0 || axis.spring_stiffness > 0) pushed_.push_back(&driven);
    }
}

void BodyEngine::add_shapes(const std::vector<PartShape>& shapes, std::size_t i, std::size_t body) {
    const ModelInstance& spec = world_.instances[i];
    const Assembly& assembly = instances_[i].assembly;
    const bool filter = std::any_of(assembly.joints.begin(), assembly.joints.end(),
                                    [](const PartJoint& joint) { return joint.closes_loop; });
    const Vec3 belt = surface_velocity(world_.prototypes[spec.prototype], spec.X_WM);
    for (const PartShape& part : shapes) {
        const Pose X_BS = body == kWorld ? spec.X_WM * part.X_BS : part.X_BS;
        add_shape({part.collision, body, X_BS, i, belt, filter});
    }
}

void BodyEngine::start() {
    started_ = true;
    for (Instance& instance : instances_) {
        const std::vector<BodyState> states = forward_kinematics(instance.assembly, instance.start);
        for (std::size_t b = 0; b < states.size(); ++b) set_body_state(instance.bodies[b], states[b]);
    }
}

void BodyEngine::step(int ticks) {
    if (!started_) start();
    for (int i = 0; i < ticks; ++i) {
        for (const Driven* joint : pushed_) push_effort(*joint);
        advance();
    }
}

void BodyEngine::push_effort(const Driven& driven) {
    const AxisSpec& axis = driven.joint.spec->axes[0];
    double effort = driven.effort;
    if (axis.damping > 0 || axis.spring_stiffness > 0) {
        const JointState state = state_of(driven.joint);
        effort -=
            axis.damping * state.velocity + axis.spring_stiffness * (state.position - axis.spring_reference);
    }
    if (effort == 0) return;
    const Joint& joint = driven.joint;
    const Pose X_WJ = joint.child == kWorld ? joint.X_CJ : body_state(joint.child).X_WB * joint.X_CJ;
    const Vec3 along = rotate(X_WJ.q, axis.xyz) * effort;
    const Vec3 force = slides(*joint.spec) ? along : Vec3{}, torque = slides(*joint.spec) ? Vec3{} : along;
    if (joint.child != kWorld) push(joint.child, force, torque);
    if (joint.parent != kWorld) push(joint.parent, -force, -torque);
}

LinkState BodyEngine::link(LinkRef ref) const {
    const Instance& instance = instances_[ref.instance];
    const ModelInstance& spec = world_.instances[ref.instance];
    const int b = instance.assembly.body_of_link[ref.link];
    const Pose& X_BL = instance.assembly.X_BL[ref.link];
    if (b < 0) return {spec.X_WM * X_BL, {}, {}};
    const auto body = static_cast<std::size_t>(b);
    return link_of_body(body_state(instance.bodies[body]), instance.assembly.bodies[body].p_BC, X_BL,
                        world_.prototypes[spec.prototype].links[ref.link].p_LC);
}

JointState BodyEngine::state_of(const Joint& joint) const {
    const BodyState parent = joint.parent == kWorld ? BodyState{} : body_state(joint.parent);
    const BodyState child = joint.child == kWorld ? BodyState{} : body_state(joint.child);
    const Pose X_WP = joint.parent == kWorld ? joint.X_PJ : parent.X_WB * joint.X_PJ;
    const Pose X_WC = joint.child == kWorld ? joint.X_CJ : child.X_WB * joint.X_CJ;
    const Vec3& axis = joint.spec->axes[0].xyz;
    const Vec3 axis_W = rotate(X_WP.q, axis);
    if (!slides(*joint.spec)) {
        const Quat turn = conjugate(X_WP.q) * X_WC.q;
        const double half = std::atan2(dot(Vec3{turn.x, turn.y, turn.z}, axis), turn.w);
        return {std::remainder(2 * half, 2 * kPi), dot(child.angular - parent.angular, axis_W)};
    }
    // Velocities of a joint's origin as points of the two bodies; v_WC is that of a centre of mass.
    const auto velocity_at = [&](std::size_t body, const BodyState& state, const Vec3& p_W) {
        if (body == kWorld) return Vec3{};
        return state.v_WC + cross(state.angular, p_W - centre_of(body, state));
    };
    const Vec3 apart = velocity_at(joint.child, child, X_WC.p) - velocity_at(joint.parent, parent, X_WC.p);
    return {dot(X_WC.p - X_WP.p, axis_W), dot(apart, axis_W)};
}

Vec3 BodyEngine::centre_of(std::size_t body, const BodyState& state) const {
    return state.X_WB * centres_[body];
}

JointState BodyEngine::joint(JointRef ref) const {
    const Instance& instance = instances_[ref.instance];
    if (!started_) return instance.start.joints[ref.joint][ref.axis];
    return state_of(instance.joints[ref.joint]->joint);
}

void BodyEngine::set_joint(JointRef ref, JointState state) {
    ROBOSS_CHECK(!started_, "before the first step");
    instances_[ref.instance].start.joints[ref.joint][ref.axis] = state;
}

void BodyEngine::set_base(std::size_t instance, const Pose& X_WM, const Vec3& angular, const Vec3& linear) {
    ROBOSS_CHECK(!started_, "before the first step");
    StartState& start = instances_[instance].start;
    start.X_WM = X_WM, start.angular = angular, start.linear = linear;
}

BodyEngine::Driven& BodyEngine::driven(JointRef ref) {
    return *instances_[ref.instance].joints[ref.joint];
}

void BodyEngine::drive_velocity(JointRef ref, double velocity, double max_effort) {
    set_motor(driven(ref).id, {.velocity = velocity, .max_effort = max_effort, .holds_velocity = true});
}

void BodyEngine::drive_position(JointRef ref, const Servo& servo) {
    set_motor(driven(ref).id, {.stiffness = servo.stiffness,
                               .position = servo.position,
                               .damping = servo.damping,
                               .max_effort = servo.max_effort});
}

void BodyEngine::drive_effort(JointRef ref, double effort) {
    Driven& joint = driven(ref);
    joint.effort = effort;
    if (std::find(pushed_.begin(), pushed_.end(), &joint) == pushed_.end()) pushed_.push_back(&joint);
}

}  // namespace roboss::bench
