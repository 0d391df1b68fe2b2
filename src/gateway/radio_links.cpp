// See radio_links.h.
#include "gateway/radio_links.h"

#include "sensors/radio_link.h"

namespace roboss {
namespace {

/// The radio of `robot` that a radio with this spec hears; its first radio if several are on the channel.
std::uint32_t antenna_of(const Model& model, RobotId robot, const RadioSpec& receiver) {
    const RobotType& type = model.type_of(robot);
    for (const std::uint32_t sensor : type.radios)
        if (share_a_channel(*type.sensors[sensor].spec.as<RadioSpec>(), receiver)) return sensor;
    return type.radios.empty() ? 0 : type.radios.front();
}

}  // namespace

void RadioLinks::begin(const Model& model) {
    radios_.clear();
    for (std::size_t i = 0; i < model.robots.size(); ++i) {
        const RobotType& type = model.type_of(RobotId(i));
        for (std::uint32_t k = 0; k < type.radios.size(); ++k)
            radios_.push_back({RobotId(i), type.radios[k], k, -1, 0});
    }
    turn_ = 0;
}

RadioLinks::Look RadioLinks::look(const Model& model, SensorSources& sources, Tick tick, std::uint64_t seed) {
    if (tick_ < 0 || tick < tick_) begin(model);
    tick_ = tick;
    Look look;
    for (Radio& radio : radios_) {
        const std::uint64_t count = sources.state_of(radio.robot).radios[radio.index].count;
        if (count > radio.sent) look.senders.push_back({radio.robot, radio.sensor, count - radio.sent});
        radio.sent = count;
    }
    const auto until = std::chrono::steady_clock::now() + kBudget;
    for (std::size_t k = 0; k < radios_.size(); ++k) {
        if (k > 0 && std::chrono::steady_clock::now() > until) {
            look.is_complete = false;
            break;
        }
        hear(model, radios_[turn_], sources, tick, seed, look);
        turn_ = (turn_ + 1) % radios_.size();
    }
    return look;
}

void RadioLinks::hear(const Model& model, Radio& radio, SensorSources& sources, Tick tick, std::uint64_t seed,
                      Look& look) {
    const Result<std::vector<RadioMessage>> messages = receive(
        {model, radio.robot, radio.sensor, sources.state_of(radio.robot), tick, seed, sources, radio.heard});
    radio.heard = tick;
    if (!messages) return;
    const RadioSpec& spec = *model.type_of(radio.robot).sensors[radio.sensor].spec.as<RadioSpec>();
    std::map<RobotId, RadioLink> links;  // by sender
    for (const RadioMessage& message : messages.value()) {
        RadioLink& link = links[message.from];
        link.from = message.from, link.to = radio.robot, link.sensor = radio.sensor;
        link.antenna = antenna_of(model, message.from, spec);
        ++link.messages;
        link.strength_dBm = message.strength_dBm;
        link.margin_dB = message.strength_dBm - spec.noise_floor;
        link.arrived = message.arrived;
    }
    for (const auto& [from, link] : links) look.links.push_back(link);
}

}  // namespace roboss
