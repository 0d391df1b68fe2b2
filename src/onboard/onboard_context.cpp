// See onboard_context.h.
#include "onboard/onboard_context.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"
#include "model/joint_motion.h"
#include "model/order.h"

namespace roboss {

void OnboardContext::give_command(std::size_t k, std::span<const double> values) {
    const int c = info_->commands[k];
    if (c < 0) return;
    const ChannelInfo& target = type_.channels[static_cast<std::size_t>(c)];
    if (target.channel.is_list || target.channel.values.size() != values.size()) return;
    const auto at = static_cast<std::size_t>(target.index);
    state_.onboard[at] = static_cast<double>(tick_);
    for (std::size_t i = 0; i < values.size(); ++i)
        state_.onboard[at + 1 + i] = std::clamp(values[i], -kCommandMax, kCommandMax);
}

void OnboardContext::drive(std::size_t joint, MotorMode mode, double target, double max_effort) {
    const auto index = static_cast<std::size_t>(info_->axes[joint].motor_index);
    if (scratch_.pushed[index] != 0 || scratch_.out_of_power) return;
    MotorSetpoint& motor = state_.motors[index];
    const double most = mode == MotorMode::kVelocity ? kOrderLimits.speed
                        : mode == MotorMode::kEffort ? kOrderLimits.force
                                                     : kOrderLimits.position;
    if (motor.mode != mode) motor.impulse = motor.load = 0;
    motor.mode = mode, motor.target = std::clamp(target, -most, most);
    motor.max_effort = fixed_min(std::fabs(max_effort), dof(joint).max_effort);
}

void OnboardContext::push_joint(std::size_t joint, double effort) {
    const auto index = static_cast<std::size_t>(info_->axes[joint].motor_index);
    const double before = scratch_.pushed[index] != 0 ? state_.motors[index].target : 0;
    scratch_.pushed[index] = 0;
    drive(joint, MotorMode::kEffort, before + effort);
    scratch_.pushed[index] = 1;
}

void OnboardContext::cut_power() {
    scratch_.out_of_power = true;
    for (MotorSetpoint& motor : state_.motors) motor.mode = MotorMode::kPassive, motor.target = 0;
}

/// Poses and velocities of all bodies, as the step computes them.
void OnboardContext::place_bodies() {
    if (placed_) return;
    placed_ = true;
    const std::vector<double>&q = state_.q, &v = state_.v;
    X_W0_ = to_transform(base_pose(state_));
    scratch_.X_WB.resize(type_.bodies.size()), scratch_.velocity.resize(type_.bodies.size());
    for (std::size_t b = 0; b < type_.bodies.size(); ++b) {
        const Body& body = type_.bodies[b];
        const auto parent = static_cast<std::size_t>(body.parent);
        Transform X_WJ = X_W0_;
        if (body.joint != JointKind::kFree)
            X_WJ = (body.parent < 0 ? X_W0_ : scratch_.X_WB[parent]) * body.X_PJ;
        Transform& X_WB = scratch_.X_WB[b];
        X_WB = joint_motion(body, X_WJ, std::span<const double>(q));
        Spatial axes[6];
        joint_axes(body, X_WJ.R, {X_WB.R, X_WB.p - X_W0_.p}, axes);
        Spatial motion = body.parent < 0 ? Spatial{} : scratch_.velocity[parent];
        for (std::size_t k = 0; k < static_cast<std::size_t>(body.nv); ++k)
            motion += axes[k] * v[static_cast<std::size_t>(body.v_index) + k];
        scratch_.velocity[b] = motion;
    }
}

const Transform& OnboardContext::body_pose(int body) {
    place_bodies();
    return body < 0 ? X_W0_ : scratch_.X_WB[static_cast<std::size_t>(body)];
}

Transform OnboardContext::pose(LinkId link) {
    const Link& l = type_.links[link.index()];
    return body_pose(l.body) * l.X_BL;
}

LinkTwist OnboardContext::twist(LinkId link) {
    const Link& l = type_.links[link.index()];
    if (l.body < 0) return {};
    const Vec3 arm = body_pose(l.body) * l.X_BL.p - X_W0_.p;
    const Spatial& v = scratch_.velocity[static_cast<std::size_t>(l.body)];
    return {v.angular, v.linear + cross(v.angular, arm)};
}

AxisPlace OnboardContext::axis(std::size_t joint) {
    const Body& body = type_.bodies[static_cast<std::size_t>(dof(joint).body)];
    const Transform& X_WB = body_pose(dof(joint).body);
    const bool reversed = type_.joints[info_->axes[joint].joint.index()].reversed;
    return {X_WB.p, X_WB.R * (reversed ? -body.axis_J : body.axis_J)};
}

LinkId OnboardContext::child_of(std::size_t joint) const {
    const JointId id = info_->axes[joint].joint;
    for (std::size_t l = 0; l < type_.links.size(); ++l) {
        const Link& link = type_.links[l];
        if (link.carrier != static_cast<int>(id.index())) continue;
        return type_.joints[id.index()].reversed && link.parent >= 0
                   ? LinkId(static_cast<std::size_t>(link.parent))
                   : LinkId(l);
    }
    return info_->base;
}

LinkId OnboardContext::parent_of(std::size_t joint) const {
    const JointId id = info_->axes[joint].joint;
    for (std::size_t l = 0; l < type_.links.size(); ++l) {
        const Link& link = type_.links[l];
        if (link.carrier != static_cast<int>(id.index())) continue;
        return type_.joints[id.index()].reversed || link.parent < 0
                   ? LinkId(l)
                   : LinkId(static_cast<std::size_t>(link.parent));
    }
    return info_->base;
}

Vec3 OnboardContext::wind() const {
    if (type_.wind_index < 0) return wind_of(model_, type_);
    const auto at = static_cast<std::size_t>(type_.wind_index);
    return {state_.onboard[at], state_.onboard[at + 1], state_.onboard[at + 2]};
}

Vec3 OnboardContext::centre(const RobotType& type, LinkId link) {
    const Link& l = type.links[link.index()];
    return body_pose(l.body) * l.p_BC;
}

void OnboardContext::push(LinkId link, const Vec3& force, const Vec3& torque) {
    const auto bounded = [](Vec3 x, double most) {
        for (std::size_t i = 0; i < 3; ++i) x[i] = std::clamp(x[i], -most, most);
        return x;
    };
    state_.wrenches.push_back(
        {link, bounded(force, kOrderLimits.force), bounded(torque, kOrderLimits.torque), tick_ + 1});
}

void OnboardContext::push_at(LinkId link, const Vec3& force, const Vec3& p_W) {
    push(link, force, cross(p_W - centre(link), force));
}

void OnboardContext::move_base(const Vec3& angular, const Vec3& linear) {
    std::vector<SurfaceMotion>& surfaces = state_.surfaces;
    surfaces.resize(type_.links.size());
    const Transform X_W0 = to_transform(base_pose(state_));
    for (std::size_t l = 0; l < surfaces.size(); ++l) {
        const Transform X_WL = X_W0 * type_.links[l].X_BL;
        surfaces[l] = {};
        surfaces[l].link = LinkId(l);
        surfaces[l].angular_L = transpose_times(X_WL.R, angular);
        surfaces[l].linear_L = transpose_times(X_WL.R, linear + cross(angular, X_WL.p - X_W0.p));
    }
}

void OnboardContext::move_surface(const SurfaceMotion& motion) {
    auto& surfaces = state_.surfaces;
    const auto at = std::ranges::lower_bound(surfaces, motion.link, {}, &SurfaceMotion::link);
    const bool known = at != surfaces.end() && at->link == motion.link;
    const bool still = motion.linear_L == Vec3{} && motion.angular_L == Vec3{} && motion.belt_L == Vec3{};
    if (known && still)
        surfaces.erase(at);
    else if (known)
        *at = motion;
    else if (!still)
        surfaces.insert(at, motion);
}

}  // namespace roboss
