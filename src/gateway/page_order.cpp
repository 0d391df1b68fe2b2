// Pages name commands; orders number them.
#include "gateway/page_order.h"

namespace roboss {
namespace {

/// Gives one action of a page's order.
struct Give {
    Client& client;
    RobotId robot;

    Result<> operator()(const PageWrench& a) const {
        const Result<Tick> ticks = client.ticks_of(a.duration_s);
        if (!ticks) return ticks.error();
        return client.order(robot, ApplyWrench{a.link, a.force, a.torque, ticks.value(), a.replaces});
    }
    Result<> operator()(const PagePull& a) const {
        const Pull& p = a.pull;
        return client.pull(robot, p.link, p.p_L, p.target_W, p.max_force, a.duration_s, p.rate);
    }
    Result<> operator()(const PageCommand& a) const {
        const Model& model = client.model();
        if (robot.index() >= model.robots.size()) return client.order(robot, Command{0, a.values});
        const RobotType& type = model.type_of(robot);
        if (const auto channel = type.find_command(a.name))
            return client.order(robot, Command{static_cast<std::uint32_t>(*channel), a.values});
        std::string known;
        for (const ChannelInfo& info : type.channels)
            known += (known.empty() ? "it has '" : ", '") + info.channel.name + "'";
        return Error{
            "robot '" + model.robots[robot.index()].name + "' has no command '" + a.name.substr(0, 100) + "'",
            known.empty() ? "it takes no commands" : known, "no-command"};
    }
    template <class Action>
    Result<> operator()(const Action& a) const {
        return client.order(robot, a);
    }
};

}  // namespace

Result<> give(Client& client, const PageOrder& order) {
    return std::visit(Give{client, order.robot}, order.action);
}

}  // namespace roboss
