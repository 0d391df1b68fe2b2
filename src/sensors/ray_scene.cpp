// Two trees: the scenery, built once, and every robot's shapes, rebuilt at each update. Planes have no box
// and are asked by every ray. A ray asks the scenery first, so that the robots behind a wall are never looked
// at.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/float_env.h"
#include "physics/dynamics/kinematics.h"
#include "sensors/infinity.h"
#include "sensors/ray_shape.h"
#include "sensors/ray_tree.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

struct Item {
    Shape shape;
    Transform X_WS;
    RobotId robot;  // that it belongs to, if any
    LinkId link;
};

struct RayAndItems final : RayTree::Target {
    RayAndItems(const RayScene::Ray& r, std::span<const Item> all) : ray(r), items(all) {}
    double distance(std::uint32_t i) const override {
        const Item& item = items[i];
        if (item.robot.valid() && item.robot == ray.self && item.link == ray.ignore_self_link)
            return kInfinity;
        return ray_distance(item.shape, item.X_WS, ray.origin_W, ray.direction_W);
    }
    const RayScene::Ray& ray;
    std::span<const Item> items;
};

/// Also keeps what it was that was nearest so far.
struct Watching final : RayTree::Target {
    Watching(const RayScene::Ray& ray, std::span<const Item> items, RayScene::Sight& nearest_so_far)
        : target(ray, items), sight(nearest_so_far) {}
    double distance(std::uint32_t i) const override {
        const double distance = target.distance(i);
        if (distance < sight.distance) sight = {distance, target.items[i].robot};
        return distance;
    }
    RayAndItems target;
    RayScene::Sight& sight;
};

/// Counts all that the ray meets before `length`.
struct Counting final : RayTree::Target {
    Counting(const RayScene::Ray& r, std::span<const Item> all, RobotId one, RobotId other)
        : ray(r), items(all), a(one), b(other) {}
    double distance(std::uint32_t i) const override {
        const Item& item = items[i];
        if (item.robot.valid() && (item.robot == a || item.robot == b)) return kInfinity;
        const bool meets = ray_distance(item.shape, item.X_WS, ray.origin_W, ray.direction_W) < ray.max_range;
        if (meets && std::ranges::find(met, i) == met.end()) met.push_back(i);
        return kInfinity;  // so that the tree goes on
    }
    const RayScene::Ray& ray;
    std::span<const Item> items;
    RobotId a, b;
    mutable std::vector<std::uint32_t> met;
};

double nearest_of_all(const RayScene::Ray& ray, std::span<const Item> items, double limit) {
    const RayAndItems target(ray, items);
    for (std::uint32_t i = 0; i < items.size(); ++i) limit = std::fmin(limit, target.distance(i));
    return limit;
}

}  // namespace

struct RayScene::Impl {
    explicit Impl(std::shared_ptr<const Model> m) : model(std::move(m)) {}

    std::shared_ptr<const Model> model;
    RayDevice device;
    RayTree static_tree{device, RayTree::Use::kBuildOnce};
    RayTree robot_tree{device, RayTree::Use::kRebuildOften};
    std::vector<Item> static_items, static_planes;
    std::vector<Item> robot_items, robot_planes;
    std::vector<Aabb> boxes;
    std::vector<Transform> X_WB;

    void add_robot(RobotId robot, const RobotState& state);
    double nearest(const Ray& ray) const;
    Sight look(const Ray& ray) const;
};

void RayScene::Impl::add_robot(RobotId robot, const RobotState& state) {
    const RobotType& type = model->type_of(robot);
    if (type.shapes.empty()) return;
    X_WB.resize(type.bodies.size());
    body_poses(type, state, X_WB);
    const Transform X_WBase = to_transform(base_pose(state));
    for (const BodyShape& part : type.shapes) {
        const Transform& X_WBody = part.body < 0 ? X_WBase : X_WB[static_cast<std::size_t>(part.body)];
        const Item item{part.shape, X_WBody * part.X_BS, robot, part.link};
        if (part.shape.kind == ShapeKind::kPlane) {
            robot_planes.push_back(item);
        } else {
            robot_items.push_back(item);
            boxes.push_back(bounds(item.shape, item.X_WS));
        }
    }
}

double RayScene::Impl::nearest(const Ray& ray) const {
    double limit = std::nextafter(ray.max_range, kInfinity);  // a hit at max_range itself counts
    limit = nearest_of_all(ray, static_planes, limit);
    limit = nearest_of_all(ray, robot_planes, limit);
    limit = static_tree.nearest(ray.origin_W, ray.direction_W, limit, RayAndItems(ray, static_items));
    limit = robot_tree.nearest(ray.origin_W, ray.direction_W, limit, RayAndItems(ray, robot_items));
    return limit <= ray.max_range ? limit : kInfinity;
}

RayScene::Sight RayScene::Impl::look(const Ray& ray) const {
    Sight sight{std::nextafter(ray.max_range, kInfinity), RobotId()};
    for (const std::vector<Item>* planes : {&static_planes, &robot_planes}) {
        const Watching watching(ray, *planes, sight);
        for (std::uint32_t i = 0; i < planes->size(); ++i) (void)watching.distance(i);
    }
    const Watching scenery(ray, static_items, sight), robots(ray, robot_items, sight);
    (void)static_tree.nearest(ray.origin_W, ray.direction_W, sight.distance, scenery);
    (void)robot_tree.nearest(ray.origin_W, ray.direction_W, sight.distance, robots);
    return sight.distance <= ray.max_range ? sight : Sight{kInfinity, RobotId()};
}

std::size_t RayScene::shapes_between(const Vec3& from_W, const Vec3& to_W, RobotId a, RobotId b) const {
    const ExactFloatScope exact;
    const double length = norm(to_W - from_W);
    if (!(length > 0)) return 0;
    const Ray ray{from_W, (to_W - from_W) / length, length, {}, {}};
    const Counting scenery(ray, impl_->static_items, a, b), robots(ray, impl_->robot_items, a, b);
    (void)impl_->static_tree.nearest(ray.origin_W, ray.direction_W, length, scenery);
    (void)impl_->robot_tree.nearest(ray.origin_W, ray.direction_W, length, robots);
    return scenery.met.size() + robots.met.size();
}

RayScene::RayScene(std::shared_ptr<const Model> model) : impl_(std::make_unique<Impl>(std::move(model))) {
    const ExactFloatScope exact;
    for (const StaticShape& fixed : impl_->model->statics) {
        const Item item{fixed.shape, fixed.X_WS, fixed.robot, fixed.link};
        if (fixed.shape.kind == ShapeKind::kPlane) {
            impl_->static_planes.push_back(item);
        } else {
            impl_->static_items.push_back(item);
            impl_->boxes.push_back(bounds(item.shape, item.X_WS));
        }
    }
    impl_->static_tree.build(impl_->boxes);
}

RayScene::~RayScene() = default;

void RayScene::update(std::span<const RobotState* const> states) {
    const ExactFloatScope exact;
    ROBOSS_CHECK(states.size() == impl_->model->robots.size(), "a ray scene needs the state of every robot");
    impl_->robot_items.clear();
    impl_->robot_planes.clear();
    impl_->boxes.clear();
    for (std::size_t i = 0; i < states.size(); ++i) impl_->add_robot(RobotId(i), *states[i]);
    impl_->robot_tree.build(impl_->boxes);
}

void RayScene::cast(std::span<const Ray> rays, std::span<double> distances) {
    const ExactFloatScope exact;
    ROBOSS_CHECK(rays.size() == distances.size(), "as many distances as rays");
    for (std::size_t i = 0; i < rays.size(); ++i) distances[i] = impl_->nearest(rays[i]);
}

void RayScene::look(std::span<const Ray> rays, std::span<Sight> sights) const {
    const ExactFloatScope exact;
    ROBOSS_CHECK(rays.size() == sights.size(), "as many sights as rays");
    for (std::size_t i = 0; i < rays.size(); ++i) sights[i] = impl_->look(rays[i]);
}

}  // namespace roboss
