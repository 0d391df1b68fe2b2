// See lane_contacts.h.
#include "physics/lanes/lane_contacts.h"

#include <algorithm>
#include <bit>

namespace roboss {
namespace {

/// Where on the shapes they touch is a matter of each lane.
bool same_pair(const Contact& a, const Contact& b) {
    return a.shape_a == b.shape_a && a.shape_b == b.shape_b;
}

unsigned bit(std::size_t lane) {
    return 1u << lane;
}

}  // namespace

LaneContacts::LaneContacts(std::size_t lanes) : works_(lanes), contacts_(lanes), spans_(lanes) {}
LaneContacts::~LaneContacts() = default;

RobotWork& LaneContacts::start(const Model& model, std::size_t lane, const LaneRobot& robot,
                               const Aabb& box) {
    RobotWork& work = works_[lane];
    work.id = robot.id;
    work.take(type_of(model.type_of(robot.id), *robot.state), *robot.state);
    work.asleep = false;
    work.box = box;
    work.shapes.resize(work.type->shapes.size());
    work.bodies.resize(work.type->bodies.size());
    return work;
}

bool LaneContacts::find(const Model& model, std::size_t lane) {
    RobotWork& work = works_[lane];
    finder_.find(model, {&work, 1}, nullptr, false, contacts_[lane]);
    recall_impulses({&work, 1}, 0, 1, contacts_[lane]);
    spans_[lane] = contacts_[lane];
    return finder_.near_misses().empty();
}

std::optional<std::uint32_t> LaneContacts::only_plane(const Model& model, const Aabb& box) {
    model.static_bvh.query(box, scenery_);
    if (scenery_.empty()) return kNothing;
    if (scenery_.size() != 1 || model.statics[scenery_[0]].shape.kind != ShapeKind::kPlane) return {};
    return scenery_[0];
}

bool LaneContacts::is_plain(const Model& model, const BodyShape& shape, std::uint32_t i) {
    if (model.statics[i].may_flow()) return false;
    const Material &a = shape.material, &b = model.statics[i].material;
    const bool directed = (a.direction_S != Vec3{} || b.direction_S != Vec3{}) &&
                          std::min(a.mu, b.mu) != std::min(a.mu2, b.mu2);
    const bool has_patch = std::max({a.patch_radius, b.patch_radius, a.surface_radius, b.surface_radius}) > 0;
    const bool turns_hard = std::min(a.torsional_mu, b.torsional_mu) > 0 && has_patch;
    return !directed && !turns_hard && std::max(a.rolling, b.rolling) <= 0;
}

SurfacePair LaneContacts::plain_surface(const Model& model, const BodyShape& shape, std::uint32_t i) {
    return surface_pair(shape.material, Mat3::identity(), model.statics[i].material, Mat3::identity(), {}, 0);
}

bool LaneContacts::keeps_all_points(const Model& model, const BodyShape& shape, std::uint32_t i) {
    constexpr std::uint32_t kPointsMax = 4;  // as far as lanes know them
    return std::min(shape.material.contacts_max, model.statics[i].material.contacts_max) >= kPointsMax;
}

ContactMemory* LaneContacts::memory_for(std::size_t count, RobotState& state) {
    state.contacts.resize(count);
    return state.contacts.data();
}

unsigned LaneContacts::alike(const Model& model, const RobotType& type, unsigned present) const {
    const auto plain_contact = [&](const Contact& c) {
        return is_plain(model, type.shapes[c.shape_a], c.shape_b);
    };
    unsigned best = 0, unseen = present;
    while (std::popcount(unseen) > std::popcount(best)) {
        const auto first = static_cast<std::size_t>(std::countr_zero(unseen));
        unsigned like_first = 0;
        for (std::size_t lane = first; lane < spans_.size(); ++lane)
            if ((unseen & bit(lane)) != 0 && std::ranges::equal(spans_[lane], spans_[first], same_pair))
                like_first |= bit(lane);
        unseen &= ~like_first;
        const bool plain = std::ranges::all_of(spans_[first], plain_contact);
        if (plain && std::popcount(like_first) > std::popcount(best)) best = like_first;
    }
    return best;
}

void LaneContacts::remember(const Model& model, std::size_t lane, StepReport& report) {
    remember_impulses({&works_[lane], 1}, 0, 1, contacts_[lane]);
    for (const Contact& c : contacts_[lane]) {
        if (c.impulse <= 0) continue;
        ++report.contacts;
        report.static_contacts += model.statics[c.shape_b].shape.kind != ShapeKind::kPlane ? 1 : 0;
    }
}

}  // namespace roboss
