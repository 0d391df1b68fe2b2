// Everything that every other number counts into: the hashes, and the tree over the scenery.
#include "model/seal.h"

#include <map>

#include "core/hash.h"
#include "model/accuracy.h"
#include "model/compile_type.h"

namespace roboss {
namespace {

void build_bvh(Model& model) {
    std::vector<Aabb> boxes;
    boxes.reserve(model.statics.size());
    for (const StaticShape& s : model.statics) boxes.push_back(bounds(s.shape, s.X_WS));
    model.static_bvh = Bvh(boxes);
}

std::uint64_t model_hash(const Model& model) {
    Hash hash;
    hash.add(model.dt_s);
    hash.add(model.air_density);
    for (const WindRegion& region : model.wind_regions) {
        hash.add(std::string_view("wind region"));
        for (const Vec3& v : {region.lower, region.upper, region.cubic, region.square, region.linear})
            hash.add(v.x), hash.add(v.y), hash.add(v.z);
        hash.add(region.constant);
    }
    hash.add(static_cast<std::uint64_t>(model.sleep));
    for (const Vec3& v : {model.gravity, model.magnetic_field_T, model.wind})
        hash.add(v.x), hash.add(v.y), hash.add(v.z);
    if (const auto& s = model.spherical)
        for (double x : {s->latitude_rad, s->longitude_rad, s->elevation_m, s->heading_rad}) hash.add(x);
    if (!model.fluid.densities.empty()) {
        hash.add(std::string_view(model.fluid.everywhere ? "fluid everywhere" : "fluid"));
        hash.add(std::span<const double>(model.fluid.heights));
        hash.add(std::span<const double>(model.fluid.densities));
    }
    for (const AccuracyNumber& number : accuracy_numbers()) hash.add(number.get(model.accuracy));
    if (model.precision == Precision::kFloat) hash.add(std::string_view("float"));
    for (const RobotType& type : model.types) hash.add(type.hash);
    for (const Robot& robot : model.robots) {
        hash.add(robot.name);
        hash.add(static_cast<std::uint64_t>(robot.type.value));
        hash.add(static_cast<std::uint64_t>(robot.family));
        const double numbers[] = {robot.X_WR.p.x, robot.X_WR.p.y, robot.X_WR.p.z, robot.X_WR.q.w,
                                  robot.X_WR.q.x, robot.X_WR.q.y, robot.X_WR.q.z};
        hash.add(std::span<const double>(numbers));
        if (!robot.start_q.empty()) hash.add(std::string_view("q")), hash.add(std::span(robot.start_q));
        if (!robot.start_v.empty()) hash.add(std::string_view("v")), hash.add(std::span(robot.start_v));
    }
    for (const StaticShape& s : model.statics) {
        hash.add(static_cast<std::uint64_t>(s.shape.kind));
        const double numbers[] = {s.shape.half.x,      s.shape.half.y, s.shape.half.z, s.shape.radius,
                                  s.shape.half_length, s.X_WS.p.x,     s.X_WS.p.y,     s.X_WS.p.z,
                                  s.X_WS.R.r0.x,       s.X_WS.R.r0.y,  s.X_WS.R.r0.z,  s.X_WS.R.r1.x,
                                  s.X_WS.R.r1.y,       s.X_WS.R.r1.z,  s.X_WS.R.r2.x,  s.X_WS.R.r2.y,
                                  s.X_WS.R.r2.z};
        hash.add(std::span<const double>(numbers));
        add_to_hash(hash, s.material);
        if (s.shape.hull != nullptr) hash.add(s.shape.hull->hash);
        if (s.shape.surface != nullptr) hash.add(s.shape.surface->hash());
        if (s.flow.moves())
            for (const Vec3& v : {s.flow.linear, s.flow.angular, s.flow.belt, s.flow.at})
                hash.add(v.x), hash.add(v.y), hash.add(v.z);
        if (s.laser_retro != 0) hash.add(std::string_view("retro")), hash.add(s.laser_retro);
        if (s.driven)
            hash.add(static_cast<std::uint64_t>(s.robot.value)),
                hash.add(static_cast<std::uint64_t>(s.link.value));
    }
    return hash.value();
}

/// RobotType::step_hash and like, of all types.
void find_alike(Model& model) {
    std::map<std::uint64_t, TypeId> first;
    for (std::size_t i = 0; i < model.types.size(); ++i) {
        RobotType& type = model.types[i];
        type.step_hash = step_hash(type);
        type.like = first.try_emplace(type.step_hash, TypeId(i)).first->second;
    }
}

}  // namespace

void seal(Model& model) {
    for (RobotType& type : model.types) {
        type.paths = DofPaths(type.dof_parent);
        lay_out_onboard(type);
        type.radios.clear();
        for (std::uint32_t i = 0; i < type.sensors.size(); ++i)
            if (type.sensors[i].spec.as<RadioSpec>() != nullptr) type.radios.push_back(i);
        type.shape_groups = ShapeGroups(type);
        type.elimination = joint_elimination(type);
        type.reach_sphere = reach_sphere_of(type);
        type.hash = type_hash(type);
    }
    find_alike(model);
    build_bvh(model);
    model.hash = model_hash(model);
}

}  // namespace roboss
