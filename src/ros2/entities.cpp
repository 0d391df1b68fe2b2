// See entities.h.
#include "ros2/entities.h"

#include <algorithm>
#include <cmath>

#include "geometry/shape.h"
#include "model/topics.h"
#include "ros2/name_filter.h"
#include "ros2/sensor_messages.h"
#include "ros2/stamps.h"

namespace roboss::ros2 {

namespace si = simulation_interfaces;

namespace {

const LinkId kCanonical(std::size_t{0});  // link of a model
constexpr double kUnitWithin = 1e-2;      // a quaternion that is less near to a unit one is an error
constexpr std::size_t kFilterMost = 100;  // categories, or tags: each entity is compared with all

/// Velocity of a point that is fixed to the frame whose velocity it is, `arm` from its origin.
Twist moved(const Twist& twist, const Vec3& arm) {
    return {twist.angular, twist.linear + cross(twist.angular, arm)};
}

bool has_category(const si::EntityInfo& info, const std::vector<si::EntityCategory>& wanted) {
    return wanted.empty() || std::ranges::any_of(wanted, [&](const si::EntityCategory& c) {
               return c.category == info.category.category;
           });
}

/// The region of a filter.
struct Region {
    Aabb box;
    Vec3 centre;
    double radius = -1;  // of a sphere; negative: it is the box

    bool meets(const Aabb& other) const {
        if (other.empty()) return false;
        if (radius < 0) return overlaps(box, other);
        const Vec3 nearest{std::clamp(centre.x, other.min.x, other.max.x),
                           std::clamp(centre.y, other.min.y, other.max.y),
                           std::clamp(centre.z, other.min.z, other.max.z)};
        return norm_squared(nearest - centre) <= radius * radius;
    }
};

/// The region of bounds that are not empty; an Error with the code "unsupported" or "bad-bounds".
Result<Region> region_of(const si::Bounds& bounds) {
    if (bounds.type != si::Bounds::kBox && bounds.type != si::Bounds::kSphere)
        return Error{"bounds of this type are not supported", "give a box or a sphere", "unsupported"};
    const auto points = bounds.points.size() == 2 ? std::optional(bounds.points) : std::nullopt;
    const auto vec = [](const Vector3& v) { return Vec3{v.x, v.y, v.z}; };
    if (!points || !is_finite(vec((*points)[0])) || !std::isfinite((*points)[1].x))
        return Error{"a box or a sphere is given by two points", "give two points of finite numbers",
                     "bad-bounds"};
    Region region;
    if (bounds.type == si::Bounds::kBox) {
        region.box.include(vec((*points)[0]));
        region.box.include(vec((*points)[1]));
    } else {
        region.centre = vec((*points)[0]), region.radius = std::max(0.0, (*points)[1].x);
    }
    return region;
}

}  // namespace

si::Result result_of(std::uint8_t code, std::string text) {
    return {code, std::move(text)};
}

si::Result fine() {
    return {si::Result::kOk, ""};
}

std::vector<RobotId> Entities::all() const {
    std::vector<RobotId> robots;
    if (run_.tick() < 0) return robots;
    for (std::size_t r = 0; r < run_.model().robots.size(); ++r)
        if (board_of(run_.model().type_of(RobotId(r))) == nullptr) robots.push_back(RobotId(r));
    return robots;
}

std::optional<RobotId> Entities::find(const std::string& name) const {
    if (run_.tick() < 0) return {};
    const std::optional<RobotId> robot = run_.model().find_robot(name);
    return robot && board_of(run_.model().type_of(*robot)) == nullptr ? robot : std::nullopt;
}

si::Result Entities::matching(const si::EntityFilters& filters, std::vector<RobotId>& found) const {
    if (filters.categories.size() > kFilterMost || is_too_long(filters.tags))
        return result_of(si::Result::kOperationFailed, "a filter has at most 100 categories and 100 tags");
    const Result<NameFilter> names = NameFilter::of(filters.filter);
    if (!names) return result_of(si::Result::kOperationFailed, names.error().message);
    std::optional<Region> region;
    if (filters.bounds.type != si::Bounds::kEmpty) {
        const Result<Region> given = region_of(filters.bounds);
        if (!given)
            return result_of(given.error().code == "unsupported" ? si::Result::kFeatureUnsupported
                                                                 : si::Result::kOperationFailed,
                             given.error().message);
        region = given.value();
    }
    for (const RobotId robot : all()) {
        if (!names.value().fits(name(robot))) continue;
        const si::EntityInfo about = info(robot);
        if (!has_category(about, filters.categories) || !fits(about.tags, filters.tags)) continue;
        if (region && !region->meets(box(robot, Transform{}))) continue;
        found.push_back(robot);
    }
    return fine();
}

Pose Entities::pose(RobotId robot) const {
    return to_pose(robot_pose(run_.model().type_of(robot), base_pose(run_.states()[robot.index()])));
}

Twist Entities::twist(RobotId robot) const {
    const RobotType& type = run_.model().type_of(robot);
    const RobotState& state = run_.states()[robot.index()];
    if (type.links.empty()) return {};
    const Transform X_WL = link_pose(type, state, kCanonical);
    return moved(link_twist(type, state, kCanonical), pose(robot).p - X_WL.p);
}

si::EntityState Entities::state(RobotId robot) const {
    const Twist velocity = twist(robot);
    const Pose X_WM = pose(robot);
    si::EntityState state;
    state.header = {stamp_of(run_.model(), run_.tick()), "world"};
    state.pose = sensor_messages::pose(X_WM.p, X_WM.q);
    state.twist = {sensor_messages::vector(velocity.linear), sensor_messages::vector(velocity.angular)};
    return state;
}

Aabb Entities::box(RobotId robot, const Transform& X_FW) const {
    const Model& model = run_.model();
    const RobotType& type = model.type_of(robot);
    const RobotState& state = run_.states()[robot.index()];
    std::vector<Transform> X_WB(type.bodies.size());
    body_poses(type, state, X_WB);
    const Transform X_WF0 = to_transform(base_pose(state));
    Aabb box;
    for (const BodyShape& shape : type.shapes) {
        const Transform& X_W = shape.body < 0 ? X_WF0 : X_WB[static_cast<std::size_t>(shape.body)];
        box.include(roboss::bounds(shape.shape, X_FW * X_W * shape.X_BS));
    }
    if (type.is_static)  // its shapes are scenery
        for (const StaticShape& shape : model.statics)
            if (shape.robot == robot) box.include(roboss::bounds(shape.shape, X_FW * shape.X_WS));
    return is_finite(box.min) && is_finite(box.max) ? box : Aabb{};
}

si::Bounds Entities::bounds(RobotId robot) const {
    const RobotType& type = run_.model().type_of(robot);
    si::Bounds bounds;
    if (type.links.empty()) return bounds;
    const Transform X_WL = link_pose(type, run_.states()[robot.index()], kCanonical);
    const Aabb box = this->box(robot, inverse(X_WL));
    if (box.empty()) return bounds;
    bounds.type = si::Bounds::kBox;
    bounds.points = {sensor_messages::vector(box.max), sensor_messages::vector(box.min)};
    return bounds;
}

si::EntityInfo Entities::info(RobotId robot) const {
    if (const auto known = infos_.find(name(robot)); known != infos_.end()) return known->second;
    const RobotType& type = run_.model().type_of(robot);
    si::EntityInfo info;
    const auto is_actor = [](const OnboardInfo& o) {
        return std::holds_alternative<ActorSpec>(o.spec.parameters);
    };
    info.category.category = std::ranges::any_of(type.onboard, is_actor) ? si::EntityCategory::kHuman
                             : type.is_static                            ? si::EntityCategory::kStaticObject
                             : !type.dofs.empty() || !type.sensors.empty() || !type.onboard.empty()
                                 ? si::EntityCategory::kRobot
                                 : si::EntityCategory::kObject;
    return info;
}

Result<Pose> Entities::frame(const std::string& name) const {
    if (name.empty() || name == "world") return Pose{};
    if (const std::optional<RobotId> robot = find(name)) return pose(*robot);
    const std::size_t slash = name.rfind('/');
    const auto robot = slash == std::string::npos ? std::nullopt : find(name.substr(0, slash));
    if (robot) {
        const RobotType& type = run_.model().type_of(*robot);
        if (const auto link = type.find_link(name.substr(slash + 1)))
            return to_pose(link_pose(type, run_.states()[robot->index()], *link));
    }
    return Error{"there is no frame '" + name.substr(0, 100) + "'",
                 "give world, the name of an entity, or ENTITY/LINK", "bad-pose"};
}

Result<Pose> Entities::pose_in_world(const std::string& frame_name, const PoseMessage& pose) const {
    const Result<Pose> X_WF = frame(frame_name);
    if (!X_WF) return X_WF.error();
    const Quaternion& o = pose.orientation;
    const Pose X{{pose.position.x, pose.position.y, pose.position.z}, Quat{o.w, o.x, o.y, o.z}};
    const double length = std::sqrt(o.x * o.x + o.y * o.y + o.z * o.z + o.w * o.w);
    if (!is_finite(X) || std::abs(length - 1) > kUnitWithin)
        return Error{"the pose has numbers that are not finite, or a quaternion that is not of length 1",
                     "correct it", "bad-pose"};
    const Vec3& p = X.p;
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kOrderLimits.position)
        return Error{"the pose is too far away", "give a nearer one", "bad-pose"};
    return X_WF.value() * Pose{X.p, normalized(X.q)};
}

void Entities::set_info(RobotId robot, const si::EntityInfo& info) {
    infos_[name(robot)] = info;
    if (infos_.size() > run_.model().robots.size())
        std::erase_if(infos_, [&](const auto& known) { return !run_.model().find_robot(known.first); });
}

bool is_too_long(const si::TagsFilter& filter) {
    return filter.tags.size() > kFilterMost;
}

bool fits(const std::vector<std::string>& tags, const si::TagsFilter& filter) {
    const auto has = [&](const std::string& tag) { return std::ranges::find(tags, tag) != tags.end(); };
    if (filter.tags.empty()) return true;
    return filter.filter_mode == si::TagsFilter::kAll ? std::ranges::all_of(filter.tags, has)
                                                      : std::ranges::any_of(filter.tags, has);
}

}  // namespace roboss::ros2
