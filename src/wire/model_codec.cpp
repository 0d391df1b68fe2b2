// One description of the Model's fields, used by the encoder and by the decoder. What follows from other
// fields (hashes, trees over scenery, a hull's edges) is not sent but computed again, so it cannot disagree.
#include "wire/model_codec.h"

#include <algorithm>
#include <utility>

#include "core/archive.h"
#include "core/hash.h"
#include "model/seal.h"

namespace roboss {
namespace wire {
namespace {

constexpr std::uint32_t kModelVersion = 12;
constexpr std::uint32_t kWithoutNames = 11;  // the version before, which is still read

/// A Writer and a Reader that know the shared hulls and surfaces, to which shapes point.
struct ModelWriter : Writer {
    explicit ModelWriter(const Model& m) : model(m) {}
    const Model& model;
};
struct ModelReader : Reader {
    ModelReader(std::span<const std::uint8_t> bytes, Model& m) : Reader(bytes), model(m) {}
    Model& model;
};

template <class A, class... Fields>
void fields(A& a, Fields&... values);
template <class T>
void field(ModelWriter& a, const std::vector<T>& values);
template <class T>
void field(ModelReader& a, std::vector<T>& values);

template <class T>
std::uint32_t index_of(const std::vector<std::shared_ptr<const T>>& all, const T* one) {
    if (one == nullptr) return 0;
    const auto found = std::find_if(all.begin(), all.end(), [one](const auto& p) { return p.get() == one; });
    ROBOSS_CHECK(found != all.end(), "a shape points to something that the Model does not own");
    return static_cast<std::uint32_t>(found - all.begin()) + 1;
}

/// A pointer to shared data travels as its index, counted from 1; 0: none.
template <class T>
void pointer(ModelWriter& a, const std::vector<std::shared_ptr<const T>>& all, const T* const& value) {
    a.scalar(index_of(all, value));
}
template <class T>
void pointer(ModelReader& a, const std::vector<std::shared_ptr<const T>>& all, const T*& value) {
    std::uint32_t index = 0;
    a.scalar(index);
    if (index > all.size()) a.fail("a shape points to a mesh that is not there");
    value = index == 0 || a.failed() ? nullptr : all[index - 1].get();
}

/// Which kind of sensor it is; its parameters follow.
void kind(ModelWriter& a, const SensorParameters& parameters) {
    a.scalar(std::visit([](const auto& p) { return p.kKind.number; }, parameters));
}
void kind(ModelReader& a, SensorParameters& parameters) {
    std::uint32_t number = 0;
    a.scalar(number);
    bool known = false;
    parameters = parameters_of_kind([&](const SensorKind& k) {
        known |= k.number == number;
        return k.number == number;
    });
    if (!known) a.fail("a sensor is of no known kind");
}

/// Likewise of an on-board controller.
void kind(ModelWriter& a, const OnboardParameters& parameters) {
    a.scalar(std::visit([](const auto& p) { return p.kKind.number; }, parameters));
}
void kind(ModelReader& a, OnboardParameters& parameters) {
    std::uint32_t number = 0;
    a.scalar(number);
    bool known = false;
    for_each_onboard_kind([&]<class Kind>(std::in_place_type_t<Kind>) {
        if (Kind::kKind.number != number) return;
        parameters.emplace<Kind>();
        known = true;
    });
    if (!known) a.fail("an on-board controller is of no known kind");
}
/// A record of a controller's parameters (onboard_spec.h).
template <class A, class Record>
requires ParameterRecord<std::remove_const_t<Record>>
void field(A& a, Record& record) {
    record.parameters([&a](const Parameter&, auto& value) { field(a, value); }, record);
}

// clang-format off
template <class A> void field(A& a, Of<A, Vec3>& m) { fields(a, m.x, m.y, m.z); }
template <class A> void field(A& a, Of<A, Quat>& m) { fields(a, m.w, m.x, m.y, m.z); }
template <class A> void field(A& a, Of<A, Pose>& m) { fields(a, m.p, m.q); }
template <class A> void field(A& a, Of<A, Mat3>& m) { fields(a, m.r0, m.r1, m.r2); }
template <class A> void field(A& a, Of<A, Transform>& m) { fields(a, m.R, m.p); }
template <class A> void field(A& a, Of<A, std::pair<int, int>>& m) { fields(a, m.first, m.second); }
template <class A> void field(A& a, Of<A, Body>& m) {
    fields(a, m.parent, m.joint, m.X_PJ, m.axis_J, m.pitch, m.reversed_ball, m.q_index, m.v_index, m.nv, m.mass, m.gravity_mass, m.p_BC,
           m.p_BG, m.inertia_C, m.inverse_mass_linear, m.inverse_inertia_angular);
}
template <class A> void field(A& a, Of<A, Dof>& m) {
    fields(a, m.body, m.joint, m.lower, m.upper, m.max_effort, m.max_velocity, m.damping, m.friction, m.spring_stiffness,
           m.spring_reference, m.armature, m.position_gain, m.velocity_gain, m.inverse_inertia, m.limit_stiffness, m.limit_dissipation);
}
template <class A> void field(A& a, Of<A, Link>& m) { fields(a, m.name, m.body, m.X_BL, m.p_BC, m.mass, m.inertia_C, m.gravity, m.carrier, m.parent); }
template <class A> void field(A& a, Of<A, Joint>& m) {
    fields(a, m.name, m.kind, m.body, m.q_index, m.v_index, m.nv, m.reversed, m.loop, m.p_BJ);
}
template <class A> void field(A& a, Of<A, LoopJoint>& m) {
    fields(a, m.joint, m.kind, m.body_a, m.body_b, m.link_a, m.link_b, m.X_AJ, m.X_BJ, m.axis_J, m.axis2_J, m.pitch, m.dofs, m.motor_index, m.inverse_mass,
           m.inverse_inertia);
}
template <class A> void field(A& a, Of<A, CoordinateCoupling>& m) {
    fields(a, m.joint, m.follower, m.leader, m.multiplier, m.offset, m.inverse_inertia, m.reference, m.higher[0], m.higher[1], m.higher[2]);
}
template <class A> void field(A& a, Of<A, Material>& m) {
    fields(a, m.mu, m.mu2, m.direction_S, m.restitution, m.bounce_threshold, m.torsional_mu, m.patch_radius, m.surface_radius, m.rolling,
           m.stiffness, m.damping, m.slop, m.correction_speed, m.contacts_max, m.collide_bitmask, m.category_bitmask);
}
template <class A> void field(A& a, Of<A, Shape>& m) {
    fields(a, m.kind, m.half, m.radius, m.half_length);
    pointer(a, a.model.hulls, m.hull);
    pointer(a, a.model.surfaces, m.surface);
}
template <class A> void field(A& a, Of<A, SurfaceFlow>& m) { fields(a, m.linear, m.angular, m.belt, m.at); }
template <class A> void field(A& a, Of<A, Aabb>& m) { fields(a, m.min, m.max); }
template <class A> void field(A& a, Of<A, BodyShape>& m) {
    fields(a, m.shape, m.body, m.link, m.X_BS, m.material, m.direction_body, m.moves, m.laser_retro);
}
template <class A> void field(A& a, Of<A, LinkDrag>& m) { fields(a, m.link, m.area, m.linear, m.wind, m.carried); }
template <class A> void field(A& a, Of<A, LinkFluid>& m) { fields(a, m.link, m.buoyant, m.added_mass); }
template <class A> void field(A& a, Of<A, FluidLayers>& m) { fields(a, m.heights, m.densities, m.everywhere); }
template <class A> void field(A& a, Of<A, WindRegion>& m) { fields(a, m.lower, m.upper, m.cubic, m.square, m.linear, m.constant); }
template <class A> void field(A& a, Of<A, NoiseSpec>& m) {
    fields(a, m.mean, m.stddev, m.bias_mean, m.bias_stddev, m.precision, m.dynamic_bias_stddev, m.dynamic_bias_correlation_time);
}
template <class A> void field(A& a, Of<A, JointNames>& m) { field(a, static_cast<Of<A, std::vector<std::string>>&>(m)); }
template <class A> void field(A& a, Of<A, SensorInfo>& m) {
    auto& s = m.spec;
    fields(a, m.link, s.name, s.sdf_type, s.X_LS, s.update_rate_hz);
    kind(a, s.parameters);
    visit_parameters(s.parameters, [&a](const Parameter&, auto& value) { field(a, value); });
}
template <class A> void field(A& a, Of<A, LinkNames>& m) { field(a, static_cast<Of<A, std::vector<std::string>>&>(m)); }
template <class A> void field(A& a, Of<A, OnboardInfo>& m) {
    fields(a, m.spec.name, m.base);
    kind(a, m.spec.parameters);
    visit_parameters(m.spec.parameters, [&a](const Parameter&, auto& value) { field(a, value); });
}
template <class A> void field(A& a, Of<A, RobotType>& m) {
    fields(a, m.name, m.free_base, m.is_static, m.kinematic, m.self_collide, m.may_sleep, m.X_RB, m.bodies, m.dofs, m.dof_parent, m.links, m.joints,
           m.loops, m.couplings, m.shapes, m.drags, m.fluids, m.self_pairs, m.sensors, m.onboard, m.initial_q, m.nq, m.nv, m.reach, m.mass, m.scenery);
}
template <class A> void field(A& a, Of<A, Robot>& m) { fields(a, m.name, m.type, m.X_WR, m.family, m.start_q, m.start_v); }
template <class A> void field(A& a, Of<A, StaticShape>& m) {
    fields(a, m.shape, m.X_WS, m.material, m.name, m.robot, m.link, m.flow, m.driven, m.laser_retro);
}
template <class A> void field(A& a, Of<A, Accuracy>& m) {
    fields(a, m.tolerance, m.friction_tolerance, m.newton_max, m.friction_max, m.compliance, m.impact_compliance, m.contact_compliance, m.friction_compliance);
}
template <class A> void field(A& a, Of<A, SphericalCoordinates>& m) {
    fields(a, m.latitude_rad, m.longitude_rad, m.elevation_m, m.heading_rad);
}
template <class A> void field(A& a, Of<A, HullParts>& m) { fields(a, m.vertices, m.loop_sizes, m.face_vertices, m.centroid, m.volume); }
template <class A> void field(A& a, Of<A, MeshSource>& m) { fields(a, m.vertices, m.triangles); }
template <class A> void field(A& a, Of<A, HeightSource>& m) { fields(a, m.columns, m.rows, m.heights, m.size_x, m.size_y); }
/// Everything behind the hulls and surfaces.
template <class A> void field(A& a, Of<A, Model>& m) {
    fields(a, m.name, m.dt_s, m.gravity, m.magnetic_field_T, m.wind, m.wind_regions, m.air_density, m.fluid, m.accuracy, m.precision, m.sleep, m.types, m.robots, m.statics);
}

/// Names of sensors in ROS 2, by type; they stand behind all else.
template <class A, class M> void sensor_names(A& a, M& model) {
    for (auto& type : model.types)
        for (auto& sensor : type.sensors) fields(a, sensor.spec.ros_topic, sensor.spec.ros_frame);
}

/// Does nothing but name every field: a new one breaks the build here, so that it is not forgotten above. (What seal()
/// computes is left out above: hashes, paths, the tree over the scenery; and what a type has of a robot alone.)
[[maybe_unused]] void know_fields(const Body& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15] = m; }
[[maybe_unused]] void know_fields(const Dof& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15] = m; }
[[maybe_unused]] void know_fields(const Link& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7, f8] = m; }
[[maybe_unused]] void know_fields(const Joint& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7, f8] = m; }
[[maybe_unused]] void know_fields(const LoopJoint& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14] = m; }
[[maybe_unused]] void know_fields(const CoordinateCoupling& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7] = m; }
[[maybe_unused]] void know_fields(const Material& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15] = m; }
[[maybe_unused]] void know_fields(const Shape& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5] = m; }
[[maybe_unused]] void know_fields(const BodyShape& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7] = m; }
[[maybe_unused]] void know_fields(const SurfaceFlow& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3] = m; }
[[maybe_unused]] void know_fields(const LinkDrag& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4] = m; }
[[maybe_unused]] void know_fields(const LinkFluid& m) { [[maybe_unused]] const auto& [f0, f1, f2] = m; }
[[maybe_unused]] void know_fields(const WindRegion& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5] = m; }
[[maybe_unused]] void know_fields(const FluidLayers& m) { [[maybe_unused]] const auto& [f0, f1, f2] = m; }
[[maybe_unused]] void know_fields(const SensorSpec& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, topic_stays, ros_topic, ros_frame] = m; }
[[maybe_unused]] void know_fields(const NoiseSpec& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6] = m; }
[[maybe_unused]] void know_fields(const SensorInfo& m) { [[maybe_unused]] const auto& [f0, f1] = m; }
[[maybe_unused]] void know_fields(const RobotType& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18, f19, f20, f21, f22, f23, f24, f25, f26, f27, f28, f29, f30, f31, f32, f33, elimination, radios_of_sensors, shape_groups, reach_sphere, step_hash, like, around] = m; }
[[maybe_unused]] void know_fields(const Robot& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5] = m; }
[[maybe_unused]] void know_fields(const StaticShape& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7, f8] = m; }
[[maybe_unused]] void know_fields(const Accuracy& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7] = m; }
[[maybe_unused]] void know_fields(const Model& m) { [[maybe_unused]] const auto& [f0, f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16, f17, f18] = m; }
// clang-format on

template <class A, class... Fields>
void fields(A& a, Fields&... values) {
    (field(a, values), ...);
}

template <class T>
void field(ModelWriter& a, const std::vector<T>& values) {
    a.count(values.size());
    for (const T& value : values) field(a, value);
}

template <class T>
void field(ModelReader& a, std::vector<T>& values) {
    values.clear();
    const std::size_t n = a.count(1);
    for (std::size_t i = 0; i < n && !a.failed(); ++i) field(a, values.emplace_back());
}

void write_shared(ModelWriter& a) {
    a.count(a.model.hulls.size());
    for (const auto& hull : a.model.hulls) {
        const HullParts parts = parts_of(*hull);
        field(a, parts);
    }
    a.count(a.model.surfaces.size());
    for (const auto& surface : a.model.surfaces) {
        const SurfaceSource source = surface->source();
        a.scalar(static_cast<std::uint8_t>(source.index()));
        std::visit([&a](const auto& s) { field(a, s); }, source);
    }
}

void read_hull(ModelReader& a) {
    HullParts parts;
    field(a, parts);
    if (a.failed()) return;
    Result<ConvexHull> hull = join_hull(std::move(parts));
    if (!hull) return a.fail(hull.error().message.c_str());
    a.model.hulls.push_back(std::make_shared<const ConvexHull>(std::move(hull).value()));
}

void read_surface(ModelReader& a) {
    std::uint8_t kind = 0;
    a.scalar(kind);
    SurfaceSource source;
    if (kind == 1) source.emplace<HeightSource>();
    if (kind > 1) return a.fail("a surface is of an unknown kind");
    std::visit([&a](auto& s) { field(a, s); }, source);
    if (a.failed()) return;
    auto surface = build_surface(source);
    if (!surface) return a.fail(surface.error().message.c_str());
    a.model.surfaces.push_back(std::move(surface).value());
}

void read_shared(ModelReader& a) {
    const std::size_t hulls = a.count(1);
    for (std::size_t i = 0; i < hulls && !a.failed(); ++i) read_hull(a);
    const std::size_t surfaces = a.count(1);
    for (std::size_t i = 0; i < surfaces && !a.failed(); ++i) read_surface(a);
}

}  // namespace
}  // namespace wire

std::vector<std::uint8_t> encode_model(const Model& model) {
    wire::ModelWriter a(model);
    a.scalar(wire::kModelVersion);
    a.scalar(model.hash);
    wire::write_shared(a);
    const bool spherical = model.spherical.has_value();
    wire::fields(a, spherical, model);
    if (spherical) wire::fields(a, *model.spherical);
    wire::sensor_names(a, model);
    return a.take();
}

Result<std::shared_ptr<const Model>> decode_model(std::span<const std::uint8_t> bytes) {
    auto model = std::make_shared<Model>();
    wire::ModelReader a(bytes, *model);
    std::uint32_t version = 0;
    std::uint64_t hash = 0;
    a.scalar(version);
    a.scalar(hash);
    if (!a.failed() && version != wire::kModelVersion && version != wire::kWithoutNames)
        return Error{"a Model of version " + std::to_string(version) + ", this program reads " +
                         std::to_string(wire::kModelVersion),
                     "run the same version of RoBOSS everywhere"};
    wire::read_shared(a);
    bool spherical = false;
    wire::fields(a, spherical, *model);
    if (spherical) wire::fields(a, model->spherical.emplace());
    if (version != wire::kWithoutNames) wire::sensor_names(a, *model);
    if (a.left() > 0) a.fail("bytes are left over behind it");
    std::string broken = a.failure();
    if (broken.empty()) broken = broken_part(*model);
    if (broken.empty()) {
        seal(*model);
        if (model->hash != hash) broken = "its hash is " + to_hex(model->hash) + ", not " + to_hex(hash);
    }
    if (!broken.empty())
        return Error{"a damaged Model of " + std::to_string(bytes.size()) + " bytes: " + broken,
                     "check the network, and that all machines run the same version of RoBOSS"};
    return std::shared_ptr<const Model>(std::move(model));
}

std::uint64_t hash_of_bytes(std::span<const std::uint8_t> bytes) {
    Hash hash;
    hash.add(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    return hash.value();
}

}  // namespace roboss
