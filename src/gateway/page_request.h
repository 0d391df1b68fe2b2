// Requests of pages, from JSON to plain data (docs/viewer-protocol.md). Pages are not trusted: what violates
// the protocol is an Error that names it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/result.h"
#include "gateway/camera_picture.h"
#include "model/order.h"

namespace roboss {

struct ControlArguments {
    std::vector<std::string> words;
};
/// A wrench as pages give it: its duration in seconds.
struct PageWrench {
    LinkId link;
    Vec3 force, torque;
    double duration_s = 0.1;
    bool replaces = false;
};
/// A pull as pages give it: its duration in seconds.
struct PagePull {
    Pull pull;
    double duration_s = 0.1;
};
/// A command as pages give it: its channel by name.
struct PageCommand {
    std::string name;
    std::vector<double> values;
};
struct PageOrder {
    RobotId robot;
    std::variant<SetPose, SetVelocity, PageWrench, PagePull, SetJoint, SetJointParameters, SetLinkParameters,
                 SetSurroundings, PageCommand, Attach, Detach>
        action;
};
/// A page sees all numbers of this: one axis of a joint, or a link.
struct NumbersWish {
    RobotId robot;
    JointId joint;  // not valid: of the link
    int axis = 0;
    LinkId link;
};
struct PageWatch {
    std::vector<RobotId> robots;
    bool contacts = false, radio = false, bounds = false, groups = false, profile = false;
    double rate = 30;  // States a second
    std::vector<PictureWish> cameras;
    std::optional<NumbersWish> numbers;
};
struct PageWhole {};
/// About control of the run, among pages (roles.h).
struct PageDesk {
    enum class Kind : std::uint8_t { kAsk, kYield, kKeep };
    Kind kind = Kind::kAsk;
    std::optional<std::uint64_t> page;  // to whom control is yielded, or from whom it is kept
};

struct PageRequest {
    std::int64_t id = 0;  // of words and orders, for the answer
    std::variant<ControlArguments, PageOrder, PageWatch, PageWhole, PageDesk> what;
};

Result<PageRequest> parse_page_request(std::string_view text);

}  // namespace roboss
