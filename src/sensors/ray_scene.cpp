// Two trees: the scenery, built once, and every robot's shapes, of which an update moves those of robots that
// moved. Planes have no box and are asked by every ray. A ray asks the scenery first, so that the robots
// behind a wall are never looked at. Large casts are shared out over threads in whole packets.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/float_env.h"
#include "core/thread_pool.h"
#include "physics/dynamics/kinematics.h"
#include "sensors/infinity.h"
#include "sensors/ray_intervals.h"
#include "sensors/ray_shape.h"
#include "sensors/ray_tracer.h"
#include "sensors/ray_tree.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

RayItem item_of(const Shape& shape, const Transform& X_WS, RobotId robot, LinkId link, double retro) {
    RayItem item{shape, X_WS, robot, link, retro, nullptr, 0};
    if (shape.hull != nullptr)
        item.faces = shape.hull->faces.data(), item.face_count = shape.hull->faces.size();
    return item;
}

void set_ray(RayPacket& packet, std::size_t lane, const Vec3& origin, const Vec3& direction, double limit) {
    packet.origin[0][lane] = origin.x, packet.origin[1][lane] = origin.y, packet.origin[2][lane] = origin.z;
    packet.direction[0][lane] = direction.x, packet.direction[1][lane] = direction.y,
    packet.direction[2][lane] = direction.z;
    packet.nearest[lane] = limit;
}

/// Farthest distance that a ray may meet something at, and a bit more: a hit at max_range itself counts.
double limit_of(double max_range) {
    return std::nextafter(max_range, kInfinity);
}

/// Lanes without a ray repeat the last one.
void close(RayPacket& packet, std::size_t count) {
    packet.active = (1u << count) - 1;
    for (std::size_t lane = count; lane < kRays; ++lane)
        for (std::size_t k = 0; k < 3; ++k)
            packet.origin[k][lane] = packet.origin[k][count - 1],
            packet.direction[k][lane] = packet.direction[k][count - 1];
    for (std::size_t lane = count; lane < kRays; ++lane) packet.nearest[lane] = packet.nearest[count - 1];
}

/// As many of these rays, of one carrier, as a packet takes.
std::size_t fill(RayPacket& packet, std::span<const RayScene::Ray> rays) {
    packet.self = rays[0].self, packet.self_link = rays[0].ignore_self_link;
    std::size_t n = 0;
    for (; n < std::min(kRays, rays.size()); ++n) {
        const RayScene::Ray& ray = rays[n];
        if (ray.self != packet.self || ray.ignore_self_link != packet.self_link) break;
        set_ray(packet, n, ray.origin_W, ray.direction_W, limit_of(ray.max_range));
    }
    close(packet, n);
    return n;
}

std::size_t fill(RayPacket& packet, const RayScene::Fan& fan, std::span<const Vec3> directions_S) {
    packet.self = fan.self, packet.self_link = fan.ignore_self_link;
    const double limit = limit_of(fan.max_range);
    const std::size_t n = std::min(kRays, directions_S.size());
    for (std::size_t i = 0; i < n; ++i) set_ray(packet, i, fan.X_WS.p, fan.X_WS.R * directions_S[i], limit);
    close(packet, n);
    return n;
}

/// Whether a line from `origin`, relative to the tree's centre, passes the box of a node within this length.
bool passes(const render::BoxNode& node, const Vec3& origin, const Vec3& direction, double length) {
    ray_shapes::Interval<double> inside{0, length};
    for (std::size_t k = 0; k < 3; ++k) {
        const double low = static_cast<double>(node.min[k]), high = static_cast<double>(node.max[k]);
        inside = intersection(
            inside, ray_shapes::slab(origin[k] - 0.5 * (low + high), direction[k], 0.5 * (high - low)));
    }
    return !inside.empty();
}

/// Calls visit(item) for those of a tree whose boxes the line may pass.
template <class Visit>
void visit_near(const RayTreeView& tree, const RayScene::Ray& ray, const Visit& visit) {
    if (tree.nodes == nullptr) return;
    const Vec3 origin = ray.origin_W - tree.centre;
    std::array<std::uint32_t, render::BoxTree::kDepthMost + 2> stack{};
    std::size_t depth = 1;
    while (depth > 0) {
        const render::BoxNode& node = tree.nodes[stack[--depth]];
        if (!passes(node, origin, ray.direction_W, ray.max_range)) continue;
        if (node.count == 0) {
            stack[depth++] = node.first + 1;
            stack[depth++] = node.first;
        }
        for (std::uint32_t i = 0; i < node.count; ++i) visit(tree.items[tree.order[node.first + i]]);
    }
}

RayScene::Sight sight_of(const RayPacket& packet, std::size_t i) {
    const RayItem* hit = packet.hit[i];
    if (hit == nullptr) return {kInfinity, RobotId(), 0};
    return {packet.nearest[i], hit->robot, hit->retro};
}

}  // namespace

struct RayScene::Impl {
    explicit Impl(std::shared_ptr<const Model> m) : model(std::move(m)) {}

    std::shared_ptr<const Model> model;
    std::vector<RayItem> static_planes, static_items, robot_planes, robot_items;
    RayTree static_tree, robot_tree;
    RayWorld world;
    std::vector<Aabb> boxes;  // of robot_items
    std::vector<Transform> X_WB;
    struct Placed {
        std::size_t item = 0, plane = 0;  // its first ones
        std::vector<double> q;            // where it stands; empty: not placed yet
    };
    std::vector<Placed> placed;  // by RobotId
    bool has_retro = false;
    std::unique_ptr<ThreadPool> pool;  // none: one thread
    bool sharing = false;              // the pool is at work

    void add_scenery();
    void add_robots();
    void place(RobotId robot, const RobotState& state);
    template <class Fill, class Take>
    void trace(std::size_t count, const Fill& fill_from, const Take& take, bool on_all_threads) const;
};

void RayScene::Impl::add_scenery() {
    std::vector<Aabb> fixed_boxes;
    for (const StaticShape& fixed : model->statics) {
        has_retro |= fixed.laser_retro != 0;
        const RayItem item = item_of(fixed.shape, fixed.X_WS, fixed.robot, fixed.link, fixed.laser_retro);
        if (fixed.shape.kind == ShapeKind::kPlane) {
            static_planes.push_back(item);
        } else {
            static_items.push_back(item);
            fixed_boxes.push_back(bounds(item.shape, item.X_WS));
        }
    }
    static_tree.update(fixed_boxes);
    world.planes[0] = static_planes;
    world.trees[0] = static_tree.view(static_items);
}

void RayScene::Impl::add_robots() {
    for (std::size_t r = 0; r < model->robots.size(); ++r) {
        placed.push_back({robot_items.size(), robot_planes.size(), {}});
        for (const BodyShape& part : model->type_of(RobotId(r)).shapes) {
            has_retro |= part.laser_retro != 0;
            auto& items = part.shape.kind == ShapeKind::kPlane ? robot_planes : robot_items;
            items.push_back(item_of(part.shape, {}, RobotId(r), part.link, part.laser_retro));
        }
    }
    boxes.resize(robot_items.size());
}

void RayScene::Impl::place(RobotId robot, const RobotState& state) {
    const RobotType& type = model->type_of(robot);
    Placed& known = placed[robot.index()];
    if (type.shapes.empty() || (!known.q.empty() && known.q == state.q)) return;
    known.q = state.q;
    X_WB.resize(type.bodies.size());
    body_poses(type, state, X_WB);
    const Transform X_WBase = to_transform(base_pose(state));
    std::size_t item = known.item, plane = known.plane;
    for (const BodyShape& part : type.shapes) {
        const Transform& X_WBody = part.body < 0 ? X_WBase : X_WB[static_cast<std::size_t>(part.body)];
        const Transform X_WS = X_WBody * part.X_BS;
        if (part.shape.kind == ShapeKind::kPlane) {
            robot_planes[plane++].X_WS = X_WS;
        } else {
            robot_items[item].X_WS = X_WS;
            boxes[item++] = bounds(part.shape, X_WS);
        }
    }
}

/// Casts rays 0 .. count - 1: fill(packet, first, last) takes the next ones of a piece, take(packet, lane, i)
/// keeps what ray i met.
template <class Fill, class Take>
void RayScene::Impl::trace(std::size_t count, const Fill& fill_from, const Take& take,
                           bool on_all_threads) const {
    constexpr std::size_t kPiece = 64 * kRays,
                          kShared = 4 * kPiece;  // rays of a piece; from which it is shared
    const RayTracer& tracer = best_ray_tracer();
    const auto cast_piece = [&](std::size_t number) {
        const ExactFloatScope exact;
        RayPacket packet;
        const std::size_t last = std::min(count, (number + 1) * kPiece);
        for (std::size_t first = number * kPiece; first < last;) {
            const std::size_t n = fill_from(packet, first, last);
            tracer.trace(world, packet);
            for (std::size_t i = 0; i < n; ++i) take(packet, i, first + i);
            first += n;
        }
    };
    const std::size_t pieces = (count + kPiece - 1) / kPiece;
    if (on_all_threads && pool && !sharing && count >= kShared)
        pool->run(pieces, [&](std::size_t number, std::size_t) { cast_piece(number); });
    else
        for (std::size_t number = 0; number < pieces; ++number) cast_piece(number);
}

std::size_t RayScene::shapes_between(const Vec3& from_W, const Vec3& to_W, RobotId a, RobotId b) const {
    const ExactFloatScope exact;
    const double length = norm(to_W - from_W);
    if (!(length > 0)) return 0;
    const Ray ray{from_W, (to_W - from_W) / length, length, {}, {}};
    std::size_t met = 0;
    for (const RayTreeView& tree : impl_->world.trees)
        visit_near(tree, ray, [&](const RayItem& item) {
            if (item.robot.valid() && (item.robot == a || item.robot == b)) return;
            met += ray_distance(item.shape, item.X_WS, ray.origin_W, ray.direction_W) < length ? 1 : 0;
        });
    return met;
}

RayScene::RayScene(std::shared_ptr<const Model> model) : impl_(std::make_unique<Impl>(std::move(model))) {
    const ExactFloatScope exact;
    impl_->add_scenery();
    impl_->add_robots();
}

RayScene::~RayScene() = default;

void RayScene::update(std::span<const RobotState* const> states) {
    const ExactFloatScope exact;
    Impl& scene = *impl_;
    ROBOSS_CHECK(states.size() == scene.model->robots.size(), "a ray scene needs the state of every robot");
    for (std::size_t i = 0; i < states.size(); ++i) scene.place(RobotId(i), *states[i]);
    scene.robot_tree.update(scene.boxes);
    scene.world.planes[1] = scene.robot_planes;
    scene.world.trees[1] = scene.robot_tree.view(scene.robot_items);
}

void RayScene::set_threads(unsigned threads) {
    if (threads < 2)
        impl_->pool.reset();
    else if (!impl_->pool || impl_->pool->threads() != threads)
        impl_->pool = std::make_unique<ThreadPool>(threads);
}

void RayScene::share_out(std::size_t count, const std::function<void(std::size_t)>& work) {
    if (!impl_->pool || count < impl_->pool->threads()) {
        for (std::size_t i = 0; i < count; ++i) work(i);
        return;
    }
    impl_->sharing = true;
    impl_->pool->run(count, [&](std::size_t item, std::size_t) { work(item); });
    impl_->sharing = false;
}

bool RayScene::has_retro() const {
    return impl_->has_retro;
}

void RayScene::cast(std::span<const Ray> rays, std::span<double> distances) const {
    ROBOSS_CHECK(rays.size() == distances.size(), "as many distances as rays");
    impl_->trace(
        rays.size(),
        [&](RayPacket& packet, std::size_t first, std::size_t last) {
            return fill(packet, rays.subspan(first, last - first));
        },
        [&](const RayPacket& packet, std::size_t lane, std::size_t i) {
            distances[i] = sight_of(packet, lane).distance;
        },
        true);
}

void RayScene::cast(const Fan& fan, std::span<const Vec3> directions_S, std::span<double> distances,
                    std::span<double> retros) const {
    ROBOSS_CHECK(directions_S.size() == distances.size(), "as many distances as rays");
    impl_->trace(
        directions_S.size(),
        [&](RayPacket& packet, std::size_t first, std::size_t last) {
            return fill(packet, fan, directions_S.subspan(first, last - first));
        },
        [&](const RayPacket& packet, std::size_t lane, std::size_t i) {
            const Sight sight = sight_of(packet, lane);
            distances[i] = sight.distance;
            if (!retros.empty()) retros[i] = sight.retro;
        },
        true);
}

void RayScene::look(std::span<const Ray> rays, std::span<Sight> sights) const {
    ROBOSS_CHECK(rays.size() == sights.size(), "as many sights as rays");
    impl_->trace(
        rays.size(),
        [&](RayPacket& packet, std::size_t first, std::size_t last) {
            return fill(packet, rays.subspan(first, last - first));
        },
        [&](const RayPacket& packet, std::size_t lane, std::size_t i) { sights[i] = sight_of(packet, lane); },
        false);
}

}  // namespace roboss
