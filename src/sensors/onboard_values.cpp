// What on-board controllers keep in the robot's state for others to read.
#include "sensors/readings.h"

namespace roboss {
namespace {

/// The controller number `wanted` of those of a kind; nullptr: the robot does not have it.
const OnboardInfo* find_controller(const RobotType& type, std::uint32_t kind, int wanted) {
    for (const OnboardInfo& info : type.onboard)
        if (info.spec.kind().number == kind && wanted-- == 0) return &info;
    return nullptr;
}

Error not_there(const SensorQuery& query) {
    return Error{"sensor '" + query.info().spec.name + "' of robot '" +
                     query.model.robots[query.robot.index()].name +
                     "' reads a controller that this robot does not run",
                 "`roboss check` says why a plugin does not run"};
}

/// The controller's memory; empty: the robot does not have it.
std::span<const double> memory_of(const OnboardInfo* info, const SensorQuery& query) {
    if (info == nullptr) return {};
    return std::span(query.state.onboard)
        .subspan(static_cast<std::size_t>(info->memory_index), info->memory.size());
}

/// The same of the controller number `wanted` of those of Spec.
template <class Spec>
std::span<const double> memory_of(int wanted, const SensorQuery& query) {
    return memory_of(find_controller(query.type(), Spec::kKind.number, wanted), query);
}

}  // namespace

Result<WheelOdometryReading> read(const WheelOdometrySpec& spec, const SensorQuery& query) {
    constexpr std::size_t kValues = 5;
    const OnboardInfo* info =
        find_controller(query.type(), static_cast<std::uint32_t>(spec.controller_kind), spec.controller);
    const std::span<const double> memory = memory_of(info, query);
    if (info == nullptr || info->spec.kind().odometry < 0) return not_there(query);
    const auto at = static_cast<std::size_t>(info->spec.kind().odometry);
    if (at + kValues > memory.size()) return not_there(query);
    return WheelOdometryReading{memory[at],     memory[at + 1], memory[at + 2],
                                memory[at + 3], memory[at + 4], 0};
}

Result<BatteryReading> read(const BatterySensorSpec& spec, const SensorQuery& query) {
    using Battery = LinearBatterySpec;
    const OnboardInfo* info = find_controller(query.type(), Battery::kKind.number, spec.controller);
    if (info == nullptr) return not_there(query);
    const std::span<const double> memory = memory_of(info, query);
    const Battery& battery = std::get<Battery>(info->spec.parameters);
    BatteryReading reading;
    reading.voltage = memory[Battery::kVoltage];
    reading.current = battery.invert_current_sign ? -memory[Battery::kCurrent] : memory[Battery::kCurrent];
    reading.charge = memory[Battery::kCharge], reading.capacity = battery.capacity;
    reading.percentage = 100 * reading.charge / battery.capacity;
    reading.charging = memory[Battery::kCharges] != 0;
    return reading;
}

Result<KineticEnergyReading> read(const KineticEnergySpec& spec, const SensorQuery& query) {
    using Monitor = KineticEnergyMonitorSpec;
    const std::span<const double> memory = memory_of<Monitor>(spec.controller, query);
    if (memory.empty()) return not_there(query);
    return KineticEnergyReading{memory[Monitor::kEnergy], memory[Monitor::kLost], memory[Monitor::kLostAt],
                                memory[Monitor::kLosses], 0};
}

Result<TrajectoryProgressReading> read(const TrajectoryProgressSpec& spec, const SensorQuery& query) {
    using Trajectory = JointTrajectoryControllerSpec;
    const std::span<const double> memory = memory_of<Trajectory>(spec.controller, query);
    if (memory.empty()) return not_there(query);
    return TrajectoryProgressReading{memory[Trajectory::kProgress], memory[Trajectory::kIsActive] != 0, 0};
}

Result<TrackOdometryReading> read(const TrackOdometrySpec& spec, const SensorQuery& query) {
    using Track = TrackControllerSpec;
    const std::span<const double> memory = memory_of<Track>(spec.controller, query);
    if (memory.empty()) return not_there(query);
    return TrackOdometryReading{memory[Track::kWay], memory[Track::kSpeed], 0};
}

}  // namespace roboss
