// TouchPlugin: whether a model's links with contact sensors touch a target, from the contacts that states
// remember of the last tick.
#pragma once

#include <span>
#include <vector>

#include "client/client.h"
#include "onboard_kinds/message_board.h"

namespace roboss {

class ContactWatch {
  public:
    ContactWatch(const Model& model, const BoardTouch& touch);

    /// Whether there was such a contact in the tick before the observation.
    bool touches(const Client& client) const;

  private:
    /// Which of a robot's links, or which of the world's static shapes, are on each side of the contact.
    struct Sides {
        std::vector<char> own, target;
    };
    bool is_one(const Sides& a, std::size_t i, const Sides& b, std::size_t k) const {
        return (a.own[i] != 0 && b.target[k] != 0) || (a.target[i] != 0 && b.own[k] != 0);
    }
    bool touches(const Client& client, RobotId robot) const;

    std::vector<Sides> links_;     // by robot, by link
    Sides statics_;                // by static shape
    std::vector<RobotId> robots_;  // with a link on some side
};

}  // namespace roboss
