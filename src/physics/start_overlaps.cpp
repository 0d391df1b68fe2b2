// See start_overlaps.h. Robots are placed one by one, and again in pairs where their boxes overlap, so that
// many robots take little room.
#include "physics/start_overlaps.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <variant>

#include "core/float_env.h"
#include "onboard_kinds/breadcrumbs.h"
#include "physics/contact/box_strips.h"
#include "physics/contact/contact.h"
#include "physics/step_failure.h"

namespace roboss {
namespace {

/// One pair of links.
struct LinkOverlap {
    RobotId robot, other;  // `other`: not valid: scenery
    LinkId link, link_in;
    std::uint32_t scenery = 0;
    double depth = 0;
};

/// A breadcrumb that was not dropped yet: it is stored below the world, and nothing touches it.
bool is_stored(const RobotType& type, const RobotState& state) {
    const auto dropped = type.find_channel(CrumbSpec::kDropped);
    if (!dropped) return false;
    const auto is_crumb = [](const OnboardInfo& info) {
        return std::holds_alternative<CrumbSpec>(info.spec.parameters);
    };
    if (std::ranges::none_of(type.onboard, is_crumb)) return false;
    return state.onboard[static_cast<std::size_t>(type.channels[*dropped].index)] < 0;
}

double extent_of(const Shape& shape) {
    return 2 * bounding_radius(shape);
}

class OverlapSearch {
  public:
    OverlapSearch(const Model& model, std::span<const RobotState> states)
        : model_(model), states_(states.begin(), states.end()), works_(2) {
        for (RobotState& state : states_) state.rest = {};
    }

    std::vector<LinkOverlap> find(std::size_t first) {
        const ExactFloatScope exact;
        std::vector<Aabb> boxes;
        for (std::size_t i = 0; i < states_.size(); ++i) {
            place(i, works_[0]);
            const bool placed =
                !body_beyond_numbers(works_[0]) &&
                !is_stored(model_.type_of(RobotId(static_cast<std::uint32_t>(i))), states_[i]);
            boxes.push_back(placed ? works_[0].box : Aabb{});
            if (!placed || i < first || model_.type_of(RobotId(i)).kinematic) continue;
            contacts_.clear();
            finder_.find(model_, std::span(works_).first(1), nullptr, false, contacts_);
            take();
        }
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
        strips_.for_each_overlap(boxes, [&](std::uint32_t i, std::uint32_t j) {
            if (std::max(i, j) >= first) pairs.emplace_back(std::min(i, j), std::max(i, j));
        });
        std::ranges::sort(pairs);
        std::uint32_t placed = RobotId::kNone;
        for (const auto& [i, j] : pairs) {
            if (placed != i) place(i, works_[0]), placed = i;
            place(j, works_[1]);
            contacts_.clear();
            finder_.with_robot(model_, works_, 0, 1, contacts_);
            take();
        }
        return std::move(found_);
    }

  private:
    void place(std::size_t robot, RobotWork& work) {
        work.asleep = false;
        place_robot(model_, RobotId(robot), states_[robot], work);
    }

    const Shape& shape_b(const Contact& c) const {
        if (c.robot_b < 0) return model_.statics[c.shape_b].shape;
        return works_[static_cast<std::size_t>(c.robot_b)].type->shapes[c.shape_b].shape;
    }

    /// Keeps the deepest point of each pair of links.
    void take() {
        for (const Contact& c : contacts_) {
            const RobotWork& a = works_[static_cast<std::size_t>(c.robot_a)];
            const BodyShape& shape = a.type->shapes[c.shape_a];
            const double smaller = std::min(extent_of(shape.shape), extent_of(shape_b(c)));
            if (c.time > 0 || -c.gap <= std::min(kDeepFrom, kDeepShare * smaller)) continue;
            LinkOverlap overlap{a.id, {}, shape.link, {}, 0, -c.gap};
            if (c.robot_b < 0) {
                overlap.scenery = c.shape_b;
            } else {
                const RobotWork& b = works_[static_cast<std::size_t>(c.robot_b)];
                overlap.other = b.id, overlap.link_in = b.type->shapes[c.shape_b].link;
            }
            found_.push_back(overlap);
        }
    }

    const Model& model_;
    std::vector<RobotState> states_;
    std::vector<RobotWork> works_;
    ContactFinder finder_;
    BoxStrips strips_;
    std::vector<Contact> contacts_;
    std::vector<LinkOverlap> found_;
};

/// "model" and "link" of the "model::link::collision" of scenery.
std::pair<std::string, std::string> parts_of(const std::string& scenery) {
    const std::size_t collision = scenery.rfind("::");
    const std::size_t link = collision == std::string::npos ? collision : scenery.rfind("::", collision - 1);
    if (link == std::string::npos) return {scenery, {}};
    return {scenery.substr(0, link), scenery.substr(link + 2, collision - link - 2)};
}

StartOverlap named(const Model& model, const LinkOverlap& o) {
    StartOverlap overlap;
    overlap.robot = o.robot, overlap.link = o.link, overlap.depth = o.depth;
    overlap.is_scenery = !o.other.valid();
    if (overlap.is_scenery) {
        std::tie(overlap.in, overlap.link_in) = parts_of(model.statics[o.scenery].name);
    } else {
        overlap.in = model.robots[o.other.index()].name;
        overlap.link_in = model.type_of(o.other).links[o.link_in.index()].name;
    }
    return overlap;
}

std::string metres(double depth) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.3g m", depth);
    return buffer;
}

std::string text_of(const Model& model, const StartOverlap& o) {
    const std::string& robot = model.robots[o.robot.index()].name;
    const std::string& link = model.type_of(o.robot).links[o.link.index()].name;
    const std::string others =
        o.links > 1 ? " (and " + std::to_string(o.links - 1) + " more of its links)" : "";
    std::string text = o.in == robot ? "links of '" + robot + "' start in each other: '" + link + "' lies " +
                                           metres(o.depth) + " deep in '" + o.link_in + "'" + others
                                     : "'" + robot + "' starts in '" + o.in + "': its link '" + link +
                                           "' lies " + metres(o.depth) + " deep in it" + others;
    if (o.robots > 1) text += "; so do " + std::to_string(o.robots - 1) + " more robots of its type";
    return text + "; it will be pushed out";
}

const char* remedy_of(const Model& model, const StartOverlap& o) {
    if (o.in == model.robots[o.robot.index()].name)
        return "Start its joints elsewhere, or leave <self_collide> out.";
    if (!o.is_scenery) return "Start one of the two elsewhere: <pose>.";
    return model.type_of(o.robot).free_base
               ? "Stand it on the ground with --on-ground, or start it elsewhere: <pose>."
               : "Start it elsewhere: <pose>, or move the joint that fixes it.";
}

void report(const Model& model, const World* world, const std::vector<StartOverlap>& overlaps,
            Diagnostics& diagnostics) {
    for (const StartOverlap& o : overlaps) {
        const std::uint32_t instance = model.robots[o.robot.index()].family;
        SourceLocation where;
        if (world != nullptr && instance < world->instances.size()) where = world->instances[instance].where;
        diagnostics.warning(where, "start-overlap", text_of(model, o), remedy_of(model, o));
    }
}

}  // namespace

std::vector<StartOverlap> find_overlaps(const Model& model, std::span<const RobotState> states,
                                        std::size_t first) {
    // By type, and what it lies in: scenery by its model, robots by their types, itself.
    using Key = std::tuple<std::uint32_t, int, std::string, std::uint32_t>;
    struct Kind {
        StartOverlap worst;
        RobotId worst_other;
        std::set<std::uint32_t> robots;
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<std::uint32_t>>
            links;  // by the two robots
    };
    std::map<Key, Kind> kinds;
    for (const LinkOverlap& o : OverlapSearch(model, states).find(first)) {
        const StartOverlap overlap = named(model, o);
        const std::uint32_t type = model.robots[o.robot.index()].type.value;
        const Key key = overlap.is_scenery   ? Key{type, 0, overlap.in, 0}
                        : o.other == o.robot ? Key{type, 1, {}, 0}
                                             : Key{type, 2, {}, model.robots[o.other.index()].type.value};
        Kind& kind = kinds[key];
        kind.robots.insert(o.robot.value);
        kind.links[{o.robot.value, o.other.value}].insert(o.link.value);
        if (overlap.depth > kind.worst.depth) kind.worst = overlap, kind.worst_other = o.other;
    }
    std::vector<StartOverlap> result;
    for (auto& [key, kind] : kinds) {
        kind.worst.links = kind.links[{kind.worst.robot.value, kind.worst_other.value}].size();
        kind.worst.robots = kind.robots.size();
        result.push_back(kind.worst);
    }
    std::ranges::stable_sort(result, std::ranges::greater{}, &StartOverlap::depth);
    return result;
}

void report_overlaps(const Model& model, const World* world, Diagnostics& diagnostics) {
    std::vector<RobotState> states;
    for (std::size_t i = 0; i < model.robots.size(); ++i) states.push_back(initial_state(model, RobotId(i)));
    report(model, world, find_overlaps(model, states), diagnostics);
}

void report_overlaps(const Model& model, std::span<const RobotState> states, std::size_t first,
                     Diagnostics& diagnostics) {
    report(model, nullptr, find_overlaps(model, states, first), diagnostics);
}

}  // namespace roboss
