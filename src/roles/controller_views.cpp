// The Controller and viewers: between two windows it asks the holders of robots to send views. Nothing of
// this is kept, awaited or sent again.
#include <algorithm>

#include "roles/controller.h"
#include "roles/send_views.h"

namespace roboss {

void Controller::take_view_request(Bus& bus, const Address& from, const ViewRequest& request) {
    if (request.model_hash != model_->hash)
        return bus.send(kControllerAddress, from, ModelChanged{model_->hash});
    views_.take(from, request, bus.now_ms());
}

void Controller::serve_views(Bus& bus) {
    if (views_.empty()) return;
    views_.note(tick_, bus.now_ms());
    const std::vector<ViewService::Due> due = views_.take_due(tick_, bus.now_ms());
    if (due.empty()) return;
    ++view_serial_;
    for (const ViewService::Due& d : due) show(bus, d);
}

void Controller::show(Bus& bus, const ViewService::Due& due) {
    std::vector<ViewDue> parts(roster_.size() + 1);  // the last: what is here
    const auto part_of = [&](std::size_t r) -> ViewDue* {
        if (holder_[r] == kAtController) return base_.tick == tick_ ? &parts.back() : nullptr;
        return is_lost(holder_[r]) ? nullptr : &parts[holder_[r]];
    };
    for (std::size_t r = 0; r < holder_.size(); ++r) {
        ViewDue* part = part_of(r);
        if (part == nullptr) continue;
        if (due.view) part->robots.emplace_back(r);
        if (due.exact_all) part->exact.emplace_back(r);
    }
    for (const RobotId robot : due.exact)
        if (!due.exact_all && robot.index() < holder_.size())
            if (ViewDue* part = part_of(robot.index())) part->exact.push_back(robot);
    for (SeatId seat_id = 0; seat_id < parts.size(); ++seat_id) {
        ViewDue& part = parts[seat_id];
        if (part.robots.empty() && part.exact.empty()) continue;
        part.epoch = epoch_;
        part.serial = view_serial_;
        part.tick = tick_;
        part.viewer = due.viewer;
        if (seat_id < roster_.size()) {
            bus.send(kControllerAddress, roster_.address_of(seat_id), std::move(part));
        } else {
            show_here(bus, part);
        }
    }
}

/// Views of states that no Simulator holds: at the beginning, and when one has left.
void Controller::show_here(Bus& bus, const ViewDue& part) {
    if (!view_layout_) view_layout_.emplace(*model_);
    const auto state = [&](RobotId robot) { return &(*base_.states)[robot.index()]; };
    send_views(*model_, *view_layout_, part, state, kControllerAddress, bus);
}

}  // namespace roboss
