// See lane_contacts.h.
#include "physics/lane_contacts.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace roboss {
namespace {

bool same_point(const Contact& a, const Contact& b) {
    return a.shape_a == b.shape_a && a.shape_b == b.shape_b && a.feature == b.feature && a.mu == b.mu;
}

bool is_plain(const Contact& c) {
    return !c.has_friction_axis && c.torsional <= 0 && c.rolling <= 0;
}

unsigned bit(std::size_t lane) {
    return 1u << lane;
}

}  // namespace

LaneContacts::LaneContacts(std::size_t lanes) : works_(lanes), contacts_(lanes) {}
LaneContacts::~LaneContacts() = default;

ShapeWork* LaneContacts::start(const Model& model, std::size_t lane, const LaneRobot& robot) {
    RobotWork& work = works_[lane];
    work.id = robot.id;
    work.type = &model.type_of(robot.id);
    work.state = robot.state;
    work.asleep = false;
    work.shapes.resize(work.type->shapes.size());
    return work.shapes.data();
}

bool LaneContacts::find(const Model& model, std::size_t lane) {
    RobotWork& work = works_[lane];
    work.box = {};
    for (const ShapeWork& shape : work.shapes) {
        if (!std::isfinite(shape.margin)) return false;
        work.box.include(shape.box);
    }
    work.origin = {work.state->q[0], work.state->q[1], work.state->q[2]};
    if (!is_finite(work.origin)) return false;
    if (work.shapes.empty()) work.box.include(work.origin);
    finder_.find(model, {&work, 1}, contacts_[lane]);
    recall_impulses({&work, 1}, contacts_[lane]);
    return true;
}

unsigned LaneContacts::alike(unsigned present) const {
    unsigned best = 0, unseen = present;
    while (std::popcount(unseen) > std::popcount(best)) {
        const auto first = static_cast<std::size_t>(std::countr_zero(unseen));
        unsigned like_first = 0;
        for (std::size_t lane = first; lane < contacts_.size(); ++lane)
            if ((unseen & bit(lane)) != 0 &&
                std::ranges::equal(contacts_[lane], contacts_[first], same_point))
                like_first |= bit(lane);
        unseen &= ~like_first;
        const bool plain = std::ranges::all_of(contacts_[first], is_plain);
        if (plain && std::popcount(like_first) > std::popcount(best)) best = like_first;
    }
    return best;
}

void LaneContacts::remember(const Model& model, std::size_t lane, StepReport& report) {
    remember_impulses({&works_[lane], 1}, contacts_[lane]);
    for (const Contact& c : contacts_[lane]) {
        if (c.impulse <= 0) continue;
        ++report.contacts;
        report.static_contacts += model.statics[c.shape_b].shape.kind != ShapeKind::kPlane ? 1 : 0;
    }
}

}  // namespace roboss
