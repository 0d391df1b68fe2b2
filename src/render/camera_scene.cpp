// See camera_scene.h.
#include "render/camera_scene.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/check.h"
#include "core/float_env.h"
#include "physics/dynamics/kinematics.h"

namespace roboss {

using namespace render;

CameraScene::CameraScene(std::shared_ptr<const Model> model, std::shared_ptr<const VisualWorld> world,
                         unsigned threads)
    : model_(std::move(model)), world_(std::move(world)), pool_(threads) {
    ROBOSS_CHECK(world_->look_of.size() == model_->robots.size(), "a look for each robot");
    const ExactFloatScope exact;
    add_scenery();
    add_robots();
    name_things();
    trace_.items = items_.data();
    trace_.meshes = world_->trace_meshes.data();
    trace_.trees[0] = {still_.nodes.empty() ? nullptr : still_.nodes.data(), still_.order.data(), 0};
}

CameraScene::~CameraScene() = default;

void CameraScene::add_item(const VisualShape& shape) {
    items_.push_back(shape.item);
    shapes_.push_back(&shape);
}

void CameraScene::add_scenery() {
    std::vector<Aabb> boxes;
    for (const VisualShape& shape : world_->scenery.shapes) {
        add_item(shape);
        place(static_cast<std::uint32_t>(items_.size() - 1), Transform{});
        boxes.push_back(box_W(static_cast<std::uint32_t>(items_.size() - 1)));
    }
    still_ = make_box_tree(boxes, 2);
    moving_from_ = static_cast<std::uint32_t>(items_.size());
}

void CameraScene::add_robots() {
    for (std::size_t r = 0; r < model_->robots.size(); ++r) {
        const std::vector<VisualLink>& links = world_->looks[world_->look_of[r]];
        std::vector<std::uint32_t>& starts = link_starts_.emplace_back();
        for (const VisualLink& link : links) {
            starts.push_back(static_cast<std::uint32_t>(items_.size()));
            for (const VisualShape& shape : link.shapes) add_item(shape);
        }
        starts.push_back(static_cast<std::uint32_t>(items_.size()));
    }
    q_.resize(model_->robots.size());
    links_W_.resize(model_->robots.size());
}

/// Labelled things in the order of the items, so scenery comes first.
void CameraScene::name_things() {
    thing_of_.assign(items_.size(), kNoThing);
    std::map<std::string, std::uint32_t> of_model;
    std::map<int, std::uint16_t> count;
    const auto add = [&](std::uint32_t item, const std::string& model, std::optional<RobotId> robot) {
        const VisualShape& shape = *shapes_[item];
        if (shape.label == 0) return;
        const auto next = static_cast<std::uint32_t>(things_.size());
        const std::uint32_t thing =
            shape.labels_model ? of_model.try_emplace(model, next).first->second : next;
        if (thing == next) things_.push_back({shape.label, ++count[shape.label], {}, robot});
        things_[thing].items.push_back(item);
        thing_of_[item] = thing;
    };
    for (std::uint32_t i = 0; i < moving_from_; ++i) add(i, shapes_[i]->model, std::nullopt);
    for (std::size_t r = 0; r < link_starts_.size(); ++r)
        for (std::uint32_t i = link_starts_[r].front(); i < link_starts_[r].back(); ++i)
            add(i, model_->robots[r].name, RobotId(r));
}

CameraScene::Items CameraScene::items_of(RobotId robot, LinkId link) const {
    if (model_->type_of(robot).is_static) return items_of_scenery(model_->robots[robot.index()].name);
    const std::vector<std::uint32_t>& starts = link_starts_[robot.index()];
    if (link.index() + 1 >= starts.size()) return {};
    return {starts[link.index()], starts[link.index() + 1]};
}

CameraScene::Items CameraScene::items_of_scenery(const std::string& model) const {
    Items items;
    while (items.first < moving_from_ && shapes_[items.first]->model != model) ++items.first;
    items.last = items.first;
    while (items.last < moving_from_ && shapes_[items.last]->model == model) ++items.last;
    return items;
}

void CameraScene::place(std::uint32_t number, const Transform& X_WF) {
    const Transform X = X_WF * shapes_[number]->X_FS;
    TraceItem& item = items_[number];
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) item.R_WS[3 * r + c] = X.R(r, c);
        item.p_WS[r] = X.p[r];
    }
}

Aabb CameraScene::box_W(std::uint32_t number) const {
    const TraceItem& item = items_[number];
    const Aabb box = box_of(item, world_->meshes);
    const Vec3 centre = box.centre(), half = (box.max - box.min) * 0.5;
    Vec3 at, reach;
    for (std::size_t r = 0; r < 3; ++r) {
        const double* R = &item.R_WS[3 * r];
        at[r] = item.p_WS[r] + (R[0] * centre.x + R[1] * centre.y + R[2] * centre.z);
        reach[r] = std::fabs(R[0]) * half.x + std::fabs(R[1]) * half.y + std::fabs(R[2]) * half.z;
        // for the rounding of rays, which start at most about as far from the middle of the world
        reach[r] += 1e-6 * (std::fabs(at[r]) + reach[r]) + 1e-5;
    }
    return {at - reach, at + reach};
}

void CameraScene::update(std::span<const RobotState* const> states) {
    ROBOSS_CHECK(states.size() == model_->robots.size(), "a camera scene needs the state of every robot");
    const ExactFloatScope exact;
    bool moved = false;
    std::vector<Transform> X_WB;
    for (std::size_t r = 0; r < states.size(); ++r) {
        if (q_[r] == states[r]->q && !links_W_[r].empty()) continue;
        moved = true;
        q_[r] = states[r]->q;
        const RobotType& type = model_->type_of(RobotId(r));
        X_WB.resize(type.bodies.size());
        body_poses(type, *states[r], X_WB);
        const Transform X_WBase = to_transform(base_pose(*states[r]));
        links_W_[r].resize(std::max<std::size_t>(1, type.links.size()));
        for (std::size_t l = 0; l < type.links.size(); ++l) {
            const Link& link = type.links[l];
            const Transform& X = link.body < 0 ? X_WBase : X_WB[static_cast<std::size_t>(link.body)];
            links_W_[r][l] = X * link.X_BL;
            // of a static model the visuals are scenery, and the range is empty
            for (std::uint32_t i = link_starts_[r][l]; i < link_starts_[r][l + 1]; ++i)
                place(i, links_W_[r][l]);
        }
    }
    if (moved) grow_moving_tree();
    place_lights();
}

void CameraScene::grow_moving_tree() {
    std::vector<Aabb> boxes;
    for (std::uint32_t i = moving_from_; i < items_.size(); ++i) boxes.push_back(box_W(i));
    moving_ = make_box_tree(boxes, 2);
    trace_.trees[1] = {moving_.nodes.empty() ? nullptr : moving_.nodes.data(), moving_.order.data(),
                       moving_from_};
}

void CameraScene::place_lights() {
    lights_.clear();
    const auto add = [&](const VisualLight& light, const Transform& X_WF) {
        const Transform X = X_WF * to_transform(light.X_FL);
        const Vec3 d = X.R * light.spec.direction;
        const double length = norm(d);
        lights_.push_back({light.spec, X.p, length > 0 ? d / length : Vec3{0, 0, -1}});
    };
    for (const VisualLight& light : world_->scenery.lights) add(light, Transform{});
    for (std::size_t r = 0; r < links_W_.size(); ++r) {
        const std::vector<VisualLink>& links = world_->looks[world_->look_of[r]];
        for (std::size_t l = 0; l < links.size(); ++l)
            for (const VisualLight& light : links[l].lights) add(light, links_W_[r][l]);
    }
    if (!lights_.empty()) return;
    LightSpec sun;  // a world without lights
    sun.kind = LightKind::kDirectional;
    sun.cast_shadows = true;
    lights_.push_back({sun, {}, Vec3{-0.4, 0.3, -0.87} / norm(Vec3{-0.4, 0.3, -0.87})});
}

void CameraScene::share_out(std::size_t count, const std::function<void(std::size_t)>& work) const {
    pool_.run(count, [&](std::size_t item, std::size_t) {
        const ExactFloatScope exact;
        work(item);
    });
}

Result<std::unique_ptr<CameraScene>> make_camera_scene(const render::VisualsOf& visuals,
                                                       std::shared_ptr<const Model> model, unsigned threads) {
    Result<std::shared_ptr<const render::VisualWorld>> world = visuals(*model);
    if (!world) return world.error();
    return std::make_unique<CameraScene>(std::move(model), std::move(world).value(), threads);
}

}  // namespace roboss
