// See contact_watch.h.
#include "client/triggers/contact_watch.h"

#include <algorithm>
#include <optional>

namespace roboss {
namespace {

/// Whether a link, or a collision of it, has `target` in its name.
bool is_target(const std::string& link, const std::string& target) {
    return link.find(target) != std::string::npos || target.starts_with(link + "::");
}

bool is_own(const BoardTouch& touch, const std::string& model, const std::string& link) {
    const bool named =
        std::ranges::any_of(touch.links, [&](const BoardWord& word) { return word.text == link; });
    // Parts of a model that no joint connects are robots "model::link".
    return named && (model == touch.model || model == touch.model + "::" + link);
}

}  // namespace

ContactWatch::ContactWatch(const Model& model, const BoardTouch& touch) {
    for (std::size_t r = 0; r < model.robots.size(); ++r) {
        const std::string& name = model.robots[r].name;
        Sides sides;
        bool any = false;
        for (const Link& link : model.type_of(RobotId(r)).links) {
            sides.own.push_back(is_own(touch, name, link.name) ? 1 : 0);
            sides.target.push_back(is_target(name + "::" + link.name, touch.target) ? 1 : 0);
            any |= sides.own.back() != 0 || sides.target.back() != 0;
        }
        links_.push_back(std::move(sides));
        if (any) robots_.emplace_back(r);
    }
    for (const StaticShape& shape : model.statics) {
        const bool own = std::ranges::any_of(touch.links, [&](const BoardWord& link) {
            return shape.name.starts_with(touch.model + "::" + link.text + "::");
        });
        statics_.own.push_back(own ? 1 : 0);
        statics_.target.push_back(shape.name.find(touch.target) != std::string::npos ? 1 : 0);
    }
}

bool ContactWatch::touches(const Client& client) const {
    return std::ranges::any_of(robots_, [&](RobotId robot) { return touches(client, robot); });
}

bool ContactWatch::touches(const Client& client, RobotId robot) const {
    const Model& model = client.model();
    const auto link_of = [&](RobotId of, std::uint32_t shape) -> std::optional<std::size_t> {
        if (of.index() >= model.robots.size() || shape >= model.type_of(of).shapes.size()) return {};
        return model.type_of(of).shapes[shape].link.index();
    };
    const Sides& here = links_[robot.index()];
    return std::ranges::any_of(client.state(robot).contacts, [&](const ContactMemory& contact) {
        const auto link = link_of(robot, contact.shape);
        if (!link) return false;
        if (contact.other_robot == RobotId::kNone)
            return contact.other_shape < statics_.own.size() &&
                   is_one(here, *link, statics_, contact.other_shape);
        const RobotId other(contact.other_robot);
        const auto there = link_of(other, contact.other_shape);
        return there && is_one(here, *link, links_[other.index()], *there);
    });
}

}  // namespace roboss
