// See onboard_kinds/linear_battery.h.
#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"
#include "onboard/controllers.h"

namespace roboss {
namespace {

constexpr double kSecondsPerHour = 3600;
constexpr double kNoCurrent = 1e-9;  // A
constexpr double kNoVoltage = 1e-3;  // V

/// W, that the robot's other controllers draw from this battery.
double loads_of_others(const LinearBatterySpec& battery, const RobotType& type) {
    double power = 0;
    for (const OnboardInfo& info : type.onboard)
        std::visit(
            [&]<class Kind>(const Kind& other) {
                if constexpr (requires { other.battery == battery.battery_name, other.power_load + 0.0; })
                    if (other.battery == battery.battery_name) power += other.power_load;
            },
            info.spec.parameters);
    return power;
}

bool is_driven(const RobotState& state) {
    return std::ranges::any_of(state.motors, [](const MotorSetpoint& motor) {
        return (motor.mode == MotorMode::kVelocity || motor.mode == MotorMode::kEffort) && motor.target != 0;
    });
}

bool is_commanded_now(const OnboardContext& c, std::size_t first, std::size_t count) {
    for (std::size_t k = first; k < first + count; ++k)
        if (c.commanded_at(k) == c.tick()) return true;
    return false;
}

/// Whether power is drawn and whether the battery is recharged.
void switch_over(const LinearBatterySpec& spec, OnboardContext& c, std::span<double> memory) {
    const std::size_t draining = spec.power_command() + 1, stopping = draining + spec.draining_topics.size();
    if (is_commanded_now(c, stopping, spec.stop_topics.size())) memory[LinearBatterySpec::kDrains] = 0;
    if (is_driven(c.state()) || is_commanded_now(c, draining, spec.draining_topics.size()))
        memory[LinearBatterySpec::kDrains] = 1;
    const bool charges = spec.enable_recharge && c.commanded_at(LinearBatterySpec::kRechargeStart) >
                                                     c.commanded_at(LinearBatterySpec::kRechargeStop);
    memory[LinearBatterySpec::kCharges] = charges ? 1 : 0;
}

/// A, that the loads and the charger ask for.
double wanted_current(const LinearBatterySpec& spec, OnboardContext& c, std::span<const double> memory) {
    const std::size_t k = spec.power_command();
    const double own = c.is_commanded(k) ? fixed_max(c.command(k)[0], 0) : spec.power_load;
    double current = 0;
    if (memory[LinearBatterySpec::kDrains] != 0 && memory[LinearBatterySpec::kVoltage] > kNoVoltage)
        current = (own + loads_of_others(spec, c.type())) / memory[LinearBatterySpec::kVoltage];
    if (memory[LinearBatterySpec::kCharges] != 0 &&
        memory[LinearBatterySpec::kCharge] < LinearBatterySpec::kFull * spec.capacity)
        current -= spec.capacity / spec.charging_time;
    return current;
}

}  // namespace

bool is_out_of_power(OnboardContext& c) {
    for (const OnboardInfo& info : c.type().onboard)
        if (std::holds_alternative<LinearBatterySpec>(info.spec.parameters) &&
            c.state().onboard[static_cast<std::size_t>(info.memory_index) + LinearBatterySpec::kCharge] <= 0)
            return true;
    return false;
}

void run(const LinearBatterySpec& spec, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    switch_over(spec, c, memory);
    double &charge = memory[LinearBatterySpec::kCharge], &current = memory[LinearBatterySpec::kCurrent];
    if (charge <= 0 && memory[LinearBatterySpec::kCharges] == 0) {
        charge = current = 0;
    } else {
        const double wanted = wanted_current(spec, c, memory);
        current += fixed_min(c.dt() / spec.smooth_current_tau, 1.0) * (wanted - current);
        if (wanted == 0 && std::fabs(current) < kNoCurrent) current = 0;
        charge = std::clamp(charge - current * c.dt() / kSecondsPerHour, 0.0, spec.capacity);
        if (current != 0 || wanted != 0)
            memory[LinearBatterySpec::kVoltage] = spec.constant_coefficient +
                                                  spec.linear_coefficient * (1 - charge / spec.capacity) -
                                                  spec.resistance * current;
    }
    if (charge <= 0) c.cut_power();
}

}  // namespace roboss
