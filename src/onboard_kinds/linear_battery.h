// LinearBatteryPlugin of Gazebo: a battery whose voltage falls with its charge and its current.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "onboard_kinds/kind.h"

namespace roboss {

/// The current follows power / voltage with the time constant `smooth_current_tau`; charge falls by current *
/// time; voltage = e0 + e1 (1 - charge / capacity) - resistance * current. Power is drawn from the first tick
/// at which a motor of the robot is given a velocity or an effort, or a draining command comes. Other
/// controllers add their own loads (members `power_load` and `battery` of their parameters). An empty battery
/// switches the robot's motors off.
struct LinearBatterySpec {
    std::string battery_name;                  ///< in the names of commands and of the sensor
    double voltage = 0,                        ///< V, at the start
        constant_coefficient = 0,              ///< e0, V
        linear_coefficient = 0,                ///< e1, V
        initial_charge = -1,                   ///< A h; negative: the capacity
        capacity = 0,                          ///< A h
        resistance = 0,                        ///< ohm
        smooth_current_tau = 1,                ///< s
        power_load = 0;                        ///< W, of the whole robot
    bool enable_recharge = false;              ///< it takes commands to recharge
    double charging_time = 0;                  ///< h, for the whole capacity
    bool start_draining = false;               ///< from the first tick
    bool invert_current_sign = false;          ///< the sensor's current is negative while it discharges
    std::vector<std::string> draining_topics,  ///< a command there starts the draining
        stop_topics;                           ///< a command there stops it

    /// Recharging adds no current beyond this share of the capacity.
    static constexpr double kFull = 0.9;

    /// Its elements of SDF that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"fix_issue_225", "true|1", "the charge always falls by current times time"},
        {"soc_threshold", "", "recharging stops at 0.9 of the capacity, as in Gazebo"},
        {"start_on_motion", "true|1", "power is drawn once a motor is driven, as in Gazebo"},
    };
    /// What this kind states about itself.
    static constexpr OnboardKind kKind{.number = 80,
                                       .name = "battery",
                                       .phrase = "a battery",
                                       .classes = "LinearBatteryPlugin",
                                       .files = "linearbatteryplugin-system",
                                       .ignored = kIgnored};

    /// The numbers of its memory: charge in A h, current in A, voltage in V, whether it drains and is charged
    /// (0 or 1).
    enum Memory { kCharge, kCurrent, kVoltage, kDrains, kCharges, kSize };
    /// Its first commands, if it may be recharged.
    enum Commands { kRechargeStart, kRechargeStop };
    /// The number of its command for the power load; behind it come the draining topics, then the stopping
    /// ones.
    std::size_t power_command() const { return enable_recharge ? 2 : 0; }

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"battery_name", "battery_name"}, s.battery_name);
        visit({"voltage", "voltage", "V"}, s.voltage);
        visit({"open_circuit_voltage_constant_coef", "open_circuit_voltage_constant_coef", "V"},
              s.constant_coefficient);
        visit({"open_circuit_voltage_linear_coef", "open_circuit_voltage_linear_coef", "V"},
              s.linear_coefficient);
        visit({"initial_charge", "initial_charge", "A h"}, s.initial_charge);
        visit({"capacity", "capacity", "A h"}, s.capacity);
        visit({"resistance", "resistance", "ohm"}, s.resistance);
        visit({"smooth_current_tau", "smooth_current_tau", "s"}, s.smooth_current_tau);
        visit({"power_load", "power_load", "W"}, s.power_load);
        visit({"enable_recharge", "enable_recharge"}, s.enable_recharge);
        visit({"charging_time", "charging_time", "h"}, s.charging_time);
        visit({"start_draining", "start_draining"}, s.start_draining);
        visit({"invert_current_sign", "invert_current_sign"}, s.invert_current_sign);
        visit({"power_draining_topic", "power_draining_topic"}, s.draining_topics);
        visit({"stop_power_draining_topic", "stop_power_draining_topic"}, s.stop_topics);
    }
    /// A h, at the start.
    double charge_at_start() const { return initial_charge < 0 ? capacity : initial_charge; }
    /// The commands that it takes.
    std::vector<Channel> channels() const {
        const std::string prefix = "battery/" + battery_name + "/";
        std::vector<Channel> all;
        if (enable_recharge)
            for (const char* name : {"recharge/start", "recharge/stop"})
                all.push_back(channel_of("", prefix + name, {{"data", ""}}));
        all.push_back(channel_of("", prefix + "power_load", {{"power", "W"}}));
        for (const auto* topics : {&draining_topics, &stop_topics})
            for (const std::string& topic : *topics) all.push_back(channel_of(topic, "", {{"data", ""}}));
        return all;
    }
    /// At the start.
    std::vector<double> memory() const {
        return {charge_at_start(), 0, voltage, start_draining ? 1.0 : 0.0, 0};
    }
    /// Whether it would change nothing while its robot is at rest: no current flows.
    static bool rests(std::span<const double> memory) {
        const bool drains = memory[kDrains] != 0 && memory[kCharge] > 0;
        return memory[kCurrent] == 0 && !drains && memory[kCharges] == 0;
    }
    /// Adds why it cannot work, if it cannot.
    void check(std::vector<OnboardProblem>& problems) const {
        if (battery_name.empty() || !(voltage > 0))
            problems.push_back({"has no <battery_name> or no <voltage> above 0", "Write both."});
        if (!(capacity > 0)) problems.push_back({"has no capacity", "Write a <capacity> above 0, in A h."});
        if (initial_charge > capacity)
            problems.push_back({"starts with more than its capacity", "Write a smaller <initial_charge>."});
        if (!(smooth_current_tau > 0))
            problems.push_back({"has a smooth_current_tau of 0 or less", "Write a time above 0, in s."});
        if (enable_recharge && !(charging_time > 0))
            problems.push_back({"is recharged without a time", "Write a <charging_time> above 0, in h."});
        if (!(resistance >= 0) || !(power_load >= 0))
            problems.push_back({"has a negative resistance or power load", "Write values of at least 0."});
    }
    /// Compares all members.
    friend bool operator==(const LinearBatterySpec&, const LinearBatterySpec&) = default;
};

}  // namespace roboss
