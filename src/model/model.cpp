// Look-ups by name, and the hash of a robot type.
#include "model/model.h"

#include <cmath>
#include <span>

#include "core/hash.h"
#include "model/compile_type.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

template <class Items>
std::optional<std::size_t> find_named(const Items& items, const std::string& name) {
    for (std::size_t i = 0; i < items.size(); ++i)
        if (items[i].name == name) return i;
    return std::nullopt;
}

void add(Hash& hash, const Vec3& v) {
    hash.add(v.x), hash.add(v.y), hash.add(v.z);
}

void add(Hash& hash, const Mat3& m) {
    add(hash, m.r0), add(hash, m.r1), add(hash, m.r2);
}

void add(Hash& hash, const Transform& X) {
    add(hash, X.R), add(hash, X.p);
}

void add(Hash& hash, int value) {
    hash.add(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
}

void add_body(Hash& hash, const Body& body) {
    add(hash, body.parent), add(hash, static_cast<int>(body.joint)), add(hash, body.X_PJ),
        add(hash, body.axis_J);
    add(hash, body.inertia_C), add(hash, body.p_BC), add(hash, body.p_BG);
    for (double x : {body.mass, body.gravity_mass, body.inverse_mass_linear, body.inverse_inertia_angular})
        hash.add(x);
    if (body.pitch != 0) hash.add(body.pitch);
    if (body.reversed_ball) add(hash, 1);
}

/// The part of a type that a hash covers: everything, or what a step reads.
enum class Cover { kAll, kStep };

void add_link(Hash& hash, const Link& link, Cover cover) {
    if (cover == Cover::kAll) hash.add(std::string_view(link.name));
    add(hash, link.body), add(hash, link.X_BL), add(hash, link.p_BC);
    hash.add(link.mass), add(hash, link.inertia_C);
    for (int x : {link.gravity ? 1 : 0, link.carrier, link.parent}) add(hash, x);
}

void add_dof(Hash& hash, const Dof& dof) {
    add(hash, dof.body);
    for (double x : {dof.lower, dof.upper, dof.max_effort, dof.max_velocity, dof.damping, dof.friction,
                     dof.spring_stiffness, dof.spring_reference, dof.armature, dof.position_gain,
                     dof.velocity_gain, dof.inverse_inertia})
        hash.add(x);
    if (std::isfinite(dof.limit_stiffness)) hash.add(dof.limit_stiffness), hash.add(dof.limit_dissipation);
}

void add_loop(Hash& hash, const LoopJoint& loop) {
    for (int x : {static_cast<int>(loop.joint.value), static_cast<int>(loop.kind), loop.body_a, loop.body_b,
                  loop.link_a, loop.link_b})
        add(hash, x);
    add(hash, loop.X_AJ), add(hash, loop.X_BJ), add(hash, loop.axis_J), add(hash, loop.axis2_J);
    for (double x : {loop.pitch, loop.inverse_mass, loop.inverse_inertia}) hash.add(x);
    for (const Dof& dof : loop.dofs) add_dof(hash, dof);
}

void add_coupling(Hash& hash, const CoordinateCoupling& coupling) {
    add(hash, coupling.follower), add(hash, coupling.leader);
    for (double x : {coupling.multiplier, coupling.offset, coupling.inverse_inertia}) hash.add(x);
    if (!coupling.is_curved()) return;
    hash.add(std::string_view("curved")), hash.add(coupling.reference);
    for (double x : coupling.higher) hash.add(x);
}

void add_joint(Hash& hash, const Joint& joint, Cover cover) {
    if (cover == Cover::kAll) hash.add(std::string_view(joint.name));
    add(hash, joint.v_index), add(hash, joint.reversed ? 1 : 0), add(hash, joint.p_BJ);
}

void add_shape(Hash& hash, const BodyShape& s, Cover cover) {
    add(hash, static_cast<int>(s.shape.kind)), add(hash, s.body), add(hash, s.X_BS), add(hash, s.shape.half);
    for (double x : {s.shape.radius, s.shape.half_length}) hash.add(x);
    add_to_hash(hash, s.material);
    if (s.direction_body >= 0) add(hash, s.direction_body);
    if (s.shape.hull != nullptr) hash.add(s.shape.hull->hash);
    if (!s.moves) add(hash, 1);
    if (cover == Cover::kStep)
        add(hash, static_cast<int>(s.link.value));
    else if (s.laser_retro != 0)
        hash.add(std::string_view("retro")), hash.add(s.laser_retro);
}

void add_drag(Hash& hash, const LinkDrag& drag) {
    add(hash, static_cast<int>(drag.link.value)), add(hash, drag.area);
    hash.add(drag.linear), add(hash, drag.wind ? 1 : 0);
    if (drag.carried != 0) hash.add(std::string_view("carried")), hash.add(drag.carried);
}

void add_fluid(Hash& hash, const LinkFluid& fluid) {
    hash.add(std::string_view("fluid"));
    add(hash, static_cast<int>(fluid.link.value)), add(hash, fluid.buoyant ? 1 : 0);
    hash.add(std::span<const double>(fluid.added_mass));
}

std::uint64_t hash_of(const RobotType& type, Cover cover) {
    Hash hash;
    add(hash, type.free_base ? 1 : 0), add(hash, type.self_collide ? 1 : 0),
        add(hash, type.is_static ? 1 : 0), add(hash, type.may_sleep ? 1 : 0), add(hash, type.X_RB);
    for (const Body& body : type.bodies) add_body(hash, body);
    for (const Dof& dof : type.dofs) add_dof(hash, dof);
    for (const BodyShape& shape : type.shapes) add_shape(hash, shape, cover);
    for (const LinkDrag& drag : type.drags) add_drag(hash, drag);
    for (const LinkFluid& fluid : type.fluids) add_fluid(hash, fluid);
    if (cover == Cover::kAll)
        for (const SensorInfo& sensor : type.sensors) add_to_hash(hash, sensor);
    for (const Link& link : type.links) add_link(hash, link, cover);
    for (const Joint& joint : type.joints) add_joint(hash, joint, cover);
    hash.add(std::span<const double>(type.initial_q));
    for (const LoopJoint& loop : type.loops) add_loop(hash, loop);
    for (const CoordinateCoupling& coupling : type.couplings) add_coupling(hash, coupling);
    for (const OnboardInfo& onboard : type.onboard)
        cover == Cover::kAll ? add_to_hash(hash, onboard) : add_to_step_hash(hash, onboard);
    if (type.kinematic) hash.add(std::string_view("kinematic"));
    if (type.self_collide && type.self_pairs != self_pairs_of(type, nullptr)) {
        hash.add(std::string_view("self-pairs"));
        for (const auto& pair : type.self_pairs) add(hash, pair.first), add(hash, pair.second);
    }
    if (!type.scenery.empty()) add(hash, type.scenery.min), add(hash, type.scenery.max);
    return hash.value();
}

}  // namespace

std::uint64_t type_hash(const RobotType& type) {
    return hash_of(type, Cover::kAll);
}

std::uint64_t step_hash(const RobotType& type) {
    return hash_of(type, Cover::kStep);
}

int Joint::axis_offset(int axis) const {
    return reversed && !joint_type(kind).is_isotropic() ? nv - 1 - axis : axis;
}

std::optional<LinkId> RobotType::find_link(const std::string& wanted) const {
    const auto i = find_named(links, wanted);
    return i ? std::optional(LinkId(*i)) : std::nullopt;
}

std::optional<JointId> RobotType::find_joint(const std::string& wanted) const {
    const auto i = find_named(joints, wanted);
    return i ? std::optional(JointId(*i)) : std::nullopt;
}

std::optional<std::size_t> RobotType::find_sensor(const std::string& wanted) const {
    for (std::size_t i = 0; i < sensors.size(); ++i)
        if (sensors[i].spec.name == wanted) return i;
    return std::nullopt;
}

std::optional<std::size_t> RobotType::find_channel(const std::string& wanted) const {
    for (std::size_t i = 0; i < channels.size(); ++i)
        if (channels[i].channel.name == wanted) return i;
    return std::nullopt;
}

std::optional<std::size_t> RobotType::find_command(const std::string& wanted) const {
    if (const auto named = find_channel(wanted)) return named;
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (wanted.empty() || !channels[i].channel.name.ends_with("/" + wanted)) continue;
        if (found) return std::nullopt;
        found = i;
    }
    return found;
}

std::optional<RobotId> Model::find_robot(const std::string& wanted) const {
    const auto i = find_named(robots, wanted);
    return i ? std::optional(RobotId(*i)) : std::nullopt;
}

}  // namespace roboss
