// Status of a run as JSON: `status` for people and panels, `groups` and `bounds` for drawings.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/run/run.h"
#include "core/hash.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

const char* standing(const MemberReport& member) {
    if (member.alive) return member.leaving ? "leaving" : "active";
    return member.leaving ? "left" : "lost";
}

Json json_of(const TrafficRate& rate) {
    return {{"in", std::round(rate.messages_in)},
            {"out", std::round(rate.messages_out)},
            {"bytes_in", std::round(rate.bytes_in)},
            {"bytes_out", std::round(rate.bytes_out)}};
}

Json member_json(const MemberReport& member, const TrafficRate& rate) {
    return {{"id", member.number},       {"name", member.name},     {"state", standing(member)},
            {"threads", member.threads}, {"robots", member.robots}, {"islands", member.islands},
            {"step_us", member.step_us}, {"load", member.load},     {"messages", json_of(rate)}};
}

}  // namespace

std::string Run::status() const {
    const Counters& c = simulation_->counters();
    const Controller& controller = simulation_->controller();
    Json o{{"world", o_.world},
           {"time_s", simulation_->time_s()},
           {"tick", simulation_->tick()},
           {"paused", pace_.paused},
           {"speed", pace_.speed > 0 ? fmt::format("{:g}", pace_.speed) : "max"},
           {"simulators", c.simulators},
           {"windows", c.windows},
           {"window_ticks", controller.window_ticks()},
           {"windows_repeated", c.windows_repeated},
           {"islands", c.islands_now},
           {"efficiency", controller.balance()},
           {"step_cpu_s", c.step_cpu_s},
           {"losses", c.losses},
           {"recoveries", c.recoveries},
           {"migrations", c.migrations},
           {"cuts", c.cuts},
           {"messages", json_of(traffic_.total())},
           {"model_hash", to_hex(model_->hash)},
           {"state_hash", to_hex(simulation_->hash())}};
    if (journal_->writes()) {
        o["branch"] = journal_->writer().branch();
        o["journal"] = {{"first_s", static_cast<double>(journal_->first_tick()) * model_->dt_s},
                        {"last_s", simulation_->time_s()}};
    }
    o["members"] = Json::array();
    for (const MemberReport& member : controller.members())
        o["members"].push_back(member_json(member, traffic_.of(member.address)));
    o["robots"] = Json::array();
    for (const Robot& robot : model_->robots) o["robots"].push_back(robot.name);
    return text_of(o, 2);
}

/// By robot: the number of its Simulator (-1: none yet) and of its island, which is its lowest robot's.
std::string Run::groups() const {
    const Controller& controller = simulation_->controller();
    const std::size_t seats = controller.members().size();
    std::vector<std::int64_t> simulator, island(model_->robots.size(), -1);
    for (std::size_t r = 0; r < model_->robots.size(); ++r) {
        const std::uint32_t seat = controller.seat_of(RobotId(r));
        simulator.push_back(seat < seats ? static_cast<std::int64_t>(seat) : -1);
    }
    const Islands& islands = controller.islands();
    for (std::size_t i = 0; i < islands.count(); ++i)
        for (const RobotId robot : islands.of(i)) island[robot.index()] = islands.of(i).front().value;
    return text_of({{"model_hash", to_hex(model_->hash)}, {"simulator", simulator}, {"island", island}}, -1);
}

/// By robot: the box that it swept in the last window, with what contact detection looks at around it, m.
std::string Run::bounds() const {
    Json boxes = Json::array();
    for (const RobotMotion& motion : simulation_->controller().motions())
        boxes.push_back({motion.swept.min[0], motion.swept.min[1], motion.swept.min[2], motion.swept.max[0],
                         motion.swept.max[1], motion.swept.max[2]});
    return text_of({{"model_hash", to_hex(model_->hash)}, {"boxes", boxes}}, -1);
}

}  // namespace roboss
