// The radio (<roboss:radio>): what a robot hears of the others' transmissions (docs/radio.md). The order
// Transmit (model/order.h) sends; a reading is what arrived.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// A message as a radio has received it.
struct RadioMessage {
    RobotId from,                       ///< the robot that sent it
        to;                             ///< the robot that it is for; not valid: everybody
    Tick sent = 0,                      ///< tick at which the order to transmit took effect
        arrived = 0;                    ///< first tick at whose beginning it was there
    int channel = 0;                    ///< of both radios
    double strength_dBm = 0;            ///< power at the receiver
    std::uint64_t number = 0;           ///< of the sender's transmissions, from 0
    std::vector<std::uint8_t> payload;  ///< as it was given
    /// Compares all members.
    friend bool operator==(const RadioMessage&, const RadioMessage&) = default;
};

/// Messages that arrived since the observation before this one, by time of arrival.
struct RadioReading {
    std::vector<std::string> senders;   ///< names of the robots
    std::vector<double> sent,           ///< s, when the order to transmit took effect
        arrived,                        ///< s, the first tick at whose beginning it was there
        strengths;                      ///< dBm
    std::vector<std::string> payloads;  ///< bytes in hexadecimal digits
    Tick tick = 0;                      ///< of the measurement

    /// Number of messages.
    std::size_t count() const { return sent.size(); }

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"senders"}, r.senders);
        visit({"sent", "s"}, r.sent);
        visit({"arrived", "s"}, r.arrived);
        visit({"strengths", "dBm"}, r.strengths);
        visit({"payloads"}, r.payloads);
    }
};

/// Radios on the same channel hear each other. Of a link, the bit rate and the power are the sender's, all
/// else is the receiver's. Losses are those of RFComms of Gazebo.
struct RadioSpec {
    using Reading = RadioReading;  ///< what it measures

    int channel = 0;           ///< that it sends and hears on
    std::string broker = "";   ///< of a CommsEndpoint; radios of other brokers do not hear each other
    std::string address = "";  ///< its name for senders, besides that of its robot; "": none
    double bit_rate = 1e6;     ///< bit/s
    double latency = 0;  ///< s, from the end of a transmission to its arrival, besides the speed of light
    double range = std::numeric_limits<double>::infinity();  ///< m; beyond, nothing is heard
    double tx_power = 20,                                    ///< dBm
        noise_floor = -90;                                   ///< dBm
    double l0 = 40,                                          ///< dB, the loss at 1 m
        fading_exponent = 2.5,                               ///< of the loss by distance; 2: free space
        sigma = 0;                                           ///< dB, of a draw for each message and receiver
    double obstacle_loss = 10;                               ///< dB, of each shape between the antennas
    double loss = 0;          ///< probability of a loss that has no cause in this list
    bool collisions = true;   ///< whether transmissions that overlap disturb each other
    double capture = 10;      ///< dB above the sum of the others: the stronger one survives a collision
    bool is_perfect = false;  ///< everything arrives at once (PerfectComms of Gazebo)

    /// Its elements of SDF that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"update_rate", "0", "a radio hears whenever it is asked"},
    };
    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 50,
                                      .name = "radio",
                                      .phrase = "a radio",
                                      .sdf_types = "radio",
                                      .ours = true,
                                      .needs_all_states = true,
                                      .is_never_held = true,
                                      .ignored = kIgnored,
                                      .plugin = {.classes = "CommsEndpoint",
                                                 .files = "comms-endpoint-system",
                                                 .topic = "",
                                                 .usual_topic = "radio"}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"channel", "channel"}, s.channel);
        visit({"address", "address"}, s.address);
        visit({"broker", "broker/bind_service"}, s.broker);
        visit({"bit_rate", "bit_rate", "bit/s"}, s.bit_rate);
        visit({"latency", "latency", "s"}, s.latency);
        visit({"range", "range", "m", true}, s.range);
        visit({"tx_power", "tx_power", "dBm"}, s.tx_power);
        visit({"noise_floor", "noise_floor", "dBm"}, s.noise_floor);
        visit({"l0", "l0", "dB"}, s.l0);
        visit({"fading_exponent", "fading_exponent"}, s.fading_exponent);
        visit({"sigma", "sigma", "dB"}, s.sigma);
        visit({"obstacle_loss", "obstacle_loss", "dB"}, s.obstacle_loss);
        visit({"loss", "loss"}, s.loss);
        visit({"collisions", "collisions"}, s.collisions);
        visit({"capture", "capture", "dB", true}, s.capture);
        visit({"is_perfect", ""}, s.is_perfect);
    }
    /// Compares all members.
    friend bool operator==(const RadioSpec&, const RadioSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        const auto require = [&](bool fine, const char* element, double value, const char* remedy) {
            if (!fine)
                problems.push_back(
                    {"has a <" + std::string(element) + "> of " + std::to_string(value), remedy});
        };
        constexpr double kMostDecibels = 400;
        require(bit_rate >= 1 && bit_rate <= 1e12, "bit_rate", bit_rate, "Write 1 to 1e12 bit/s.");
        require(latency >= 0 && latency <= 0.5, "latency", latency, "Write 0 to 0.5 s.");
        require(range > 0, "range", range, "Write a range in m, above 0; inf: no limit.");
        require(fading_exponent >= 0 && fading_exponent <= 100, "fading_exponent", fading_exponent,
                "Write 0 to 100; 2 is free space.");
        require(sigma >= 0 && sigma <= kMostDecibels, "sigma", sigma, "Write a deviation of 0 to 400 dB.");
        require(obstacle_loss >= 0 && obstacle_loss <= kMostDecibels, "obstacle_loss", obstacle_loss,
                "Write 0 to 400 dB.");
        require(loss >= 0 && loss <= 1, "loss", loss, "Write a probability, 0 to 1.");
        require(capture >= 0, "capture", capture, "Write at least 0 dB; inf: nothing survives a collision.");
        require(std::fabs(tx_power) <= kMostDecibels, "tx_power", tx_power, "Write -400 to 400 dBm.");
        require(std::fabs(noise_floor) <= kMostDecibels, "noise_floor", noise_floor,
                "Write -400 to 400 dBm.");
        require(std::fabs(l0) <= kMostDecibels, "l0", l0, "Write -400 to 400 dB.");
    }
};

}  // namespace roboss
