// Field names of the JSON texts.
#include "gateway/run_json.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/hash.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

const char* name_of(MemberState state) {
    switch (state) {
        case MemberState::kActive:
            return "active";
        case MemberState::kLeaving:
            return "leaving";
        case MemberState::kLeft:
            return "left";
        case MemberState::kLost:
            break;
    }
    return "lost";
}

std::string speed_text(double speed) {
    if (!(speed > 0)) return "max";
    char text[32];
    std::snprintf(text, sizeof text, "%g", speed);
    return text;
}

Json json_of(const MessageRate& rate) {
    return {{"in", std::round(rate.messages_in)},
            {"out", std::round(rate.messages_out)},
            {"bytes_in", std::round(rate.bytes_in)},
            {"bytes_out", std::round(rate.bytes_out)}};
}

Json json_of(const MemberStatus& member) {
    return {{"id", member.id},
            {"name", member.name},
            {"state", name_of(member.state)},
            {"threads", member.threads},
            {"robots", member.robots},
            {"islands", member.islands},
            {"step_us", member.step_us},
            {"load", member.load},
            {"messages", json_of(member.messages)},
            {"own_process", member.own_process}};
}

void append(Json& o, const RunStatus& s) {
    o.update({{"world", s.world},
              {"time_s", s.time_s},
              {"tick", s.tick},
              {"paused", s.paused},
              {"over", s.over},
              {"speed", speed_text(s.speed)}});
    std::size_t active = 0;
    for (const MemberStatus& member : s.members)
        active += member.state == MemberState::kActive || member.state == MemberState::kLeaving ? 1 : 0;
    o.update({{"simulators", active},
              {"windows", s.windows},
              {"window_ticks", s.window},
              {"windows_repeated", s.repeated},
              {"islands", s.islands},
              {"efficiency", s.efficiency},
              {"step_cpu_s", s.step_cpu_s},
              {"losses", s.losses},
              {"recoveries", s.recoveries},
              {"migrations", s.migrations},
              {"cuts", s.cuts},
              {"messages", json_of(s.messages)},
              {"model_hash", to_hex(s.model_hash)},
              {"state_hash", to_hex(s.state_hash)},
              {"robot_count", s.robot_count}});
    if (s.branch > 0) {
        o["branch"] = s.branch;
        o["journal"] = {{"first_s", s.first_s},
                        {"last_s", s.time_s},
                        {"bytes", s.journal_bytes},
                        {"mb_per_min", std::round(1e3 * s.journal_mb_per_min) / 1e3}};
        o["timeline"] = s.timeline;
    }
    if (s.replay) o["replay"] = true;
    o["members"] = Json::array();
    for (const MemberStatus& member : s.members) o["members"].push_back(json_of(member));
}

void append(Json& o, const RunProfile& p) {
    const auto ratio = [](auto part, auto all) {
        return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : 0.0;
    };
    Json stages = Json::array();
    for (const StageTime& stage : p.stages)
        stages.push_back({{"name", stage.name}, {"seconds", stage.seconds}});
    o.update({{"ticks", p.ticks},
              {"stages", std::move(stages)},
              {"largest_island_robots", p.largest_island},
              {"most_contacts", p.most_contacts},
              {"largest_part_robots", p.largest_part},
              {"iterations_per_tick_mean", ratio(p.iterations, p.ticks)},
              {"iterations_per_island_mean", ratio(p.iterations, p.islands)},
              {"iterations_per_island_most", p.iterations_most},
              {"residual_worst", p.residual},
              {"friction_solves", p.friction_solves},
              {"friction_missed_share", ratio(p.friction_misses, p.friction_solves)},
              {"friction_error_worst", p.friction_error},
              {"friction_tolerance", p.friction_tolerance}});
}

void append(Json& o, const RunTimeline& timeline) {
    o["serial"] = timeline.serial;
    o["branch"] = timeline.branch;
    o["branches"] = Json::array();
    for (const TimelineBranch& b : timeline.branches)
        o["branches"].push_back({{"id", b.id},
                                 {"parent", b.parent},
                                 {"begin_s", b.begin_s},
                                 {"first_s", b.first_s},
                                 {"end_s", b.end_s},
                                 {"reason", b.reason}});
    o["bookmarks"] = Json::array();
    for (const TimelineBookmark& mark : timeline.bookmarks)
        o["bookmarks"].push_back(
            {{"id", mark.id}, {"branch", mark.branch}, {"time_s", mark.time_s}, {"name", mark.name}});
}

Json json_of(const RunPreview& preview) {
    return {{"branch", preview.branch}, {"tick", preview.tick}, {"time_s", preview.time_s},
            {"exact", preview.exact},   {"gone", preview.gone}, {"absent", preview.absent}};
}

/// To a millionth: floats have many digits, and nobody sees them.
Json json_of(const std::array<float, 3>& v) {
    Json list = Json::array();
    for (const float x : v) list.push_back(std::isfinite(x) ? std::round(1e6 * double{x}) / 1e6 : 0.0);
    return list;
}

}  // namespace

std::string status_json(const RunStatus& status) {
    Json o = Json::object();
    append(o, status);
    if (!status.robots.empty() || status.robot_count == 0) o["robots"] = status.robots;
    return text_of(o, 2);
}

std::string status_line(const RunStatus& status, double real_time_factor) {
    Json o{{"type", "status"}};
    append(o, status);
    o["rtf"] = std::round(1e3 * real_time_factor) / 1e3;
    return text_of(o, -1);
}

std::string over_line(const RunOver& over) {
    return text_of({{"type", "over"}, {"reason", over.reason}, {"failed", over.failed}}, -1);
}

std::string extras_line(const ViewExtras& extras, Tick tick, std::uint32_t scene) {
    Json surfaces = Json::array(), bonds = Json::array();
    for (const ViewSurface& s : extras.surfaces)
        surfaces.push_back({{"robot", s.robot.value},
                            {"link", s.link.value},
                            {"linear", json_of(s.linear_L)},
                            {"angular", json_of(s.angular_L)},
                            {"belt", json_of(s.belt_L)}});
    for (const ViewBond& b : extras.bonds)
        bonds.push_back({{"robot", b.holder.value},
                         {"link", b.link.value},
                         {"other", b.other.valid() ? static_cast<std::int64_t>(b.other.value) : -1},
                         {"other_link", b.other.valid() ? b.other_link.value : 0},
                         {"point", json_of(b.p_L)}});
    return text_of({{"type", "extras"},
                    {"scene", scene},
                    {"tick", tick},
                    {"surfaces", std::move(surfaces)},
                    {"bonds", std::move(bonds)}},
                   -1);
}

std::string groups_json(const RobotGroups& groups) {
    return text_of({{"model_hash", to_hex(groups.model_hash)},
                    {"simulator", groups.simulator},
                    {"island", groups.island}},
                   -1);
}

std::string profile_json(const RunProfile& profile) {
    Json o = Json::object();
    append(o, profile);
    return text_of(o, 2);
}

std::string profile_line(const RunProfile& profile) {
    Json o{{"type", "profile"}};
    append(o, profile);
    return text_of(o, -1);
}

std::string profile_line(const Error& refusal) {
    return text_of({{"type", "profile"}, {"ticks", 0}, {"why", refusal.text()}}, -1);
}

std::string timeline_json(const RunTimeline& timeline) {
    Json o = Json::object();
    append(o, timeline);
    return text_of(o, 2);
}

std::string timeline_line(const RunTimeline& timeline) {
    Json o{{"type", "timeline"}};
    append(o, timeline);
    return text_of(o, -1);
}

std::string preview_json(const RunPreview& preview) {
    return text_of(json_of(preview), 2);
}

std::string preview_line(const RunPreview& preview, std::int64_t id) {
    return text_of(
        {{"type", "answer"}, {"id", id}, {"done", true}, {"text", ""}, {"preview", json_of(preview)}}, -1);
}

std::string bounds_json(const RobotBounds& bounds) {
    Json boxes = Json::array();
    for (const Box32& box : bounds.boxes)
        boxes.push_back({box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]});
    return text_of({{"model_hash", to_hex(bounds.model_hash)}, {"boxes", boxes}}, -1);
}

}  // namespace roboss
