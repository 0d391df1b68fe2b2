// The controllers of all cells of a world as a control program: `roboss run worlds/arm_cell.sdf --client
// roboss_arm_cell.so --client roboss_arm_feeder.so` (docs/arm-cell.md). It reads sensors and joint encoders,
// and orders motors; it looks at no pose of any box.
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <roboss/client/control_program.h>
#include "../result_file.h"
#include "cell.h"
#include "reporting.h"

namespace arm_cell {
namespace {

constexpr double kFingerSpeed = 0.2;  // m/s
constexpr double kFingerMotor = 50;   // N, on both fingers: each pad presses with half of it
constexpr const char* kBeltCommand = "link/belt/track_cmd_vel";
constexpr const char* kResult = "ROBOSS_CELLS_RESULT";

/// The ids of a cell in the world.
struct Devices {
    roboss::RobotId arm, feed;
    std::size_t barrier = 0, scanner = 0, eye = 0;
};

class CellProgram final : public roboss::ControlProgram {
  public:
    ~CellProgram() override {
        if (const auto time_s = reports_.at_end()) report_at_end([&] { report_all(*time_s); });
    }
    roboss::ControlOptions options() const override { return {kPeriod, -1, true}; }
    void start(roboss::Client& client) override;
    void control(roboss::Client& client) override;
    std::string memory() const override;
    void restore(const std::string& memory) override;

  private:
    void control_cell(roboss::Client& client, const Devices& devices, Cell& cell) const;
    Readings read(roboss::Client& client, const Devices& devices, const Cell& cell) const;
    bool touched(roboss::Client& client, const Devices& devices) const;
    void obey(roboss::Client& client, const Devices& devices, Cell& cell, const Orders& orders) const;
    void report_all(double time_s) const;

    Gripper gripper_ = Gripper::kFingers;
    std::vector<Devices> devices_;
    std::vector<Cell> cells_;
    Reports reports_;
};

void CellProgram::start(roboss::Client& client) {
    devices_.clear();
    cells_.clear();
    reports_.start();
    examples::check_result_file(kResult);
    const roboss::Model& model = client.model();
    for (int number = 0; model.find_robot(arm_name(number)) && model.find_robot(feed_name(number));
         ++number) {
        Devices devices{client.robot(arm_name(number)), client.robot(feed_name(number))};
        devices.barrier = client.sensor(devices.feed, "barrier");
        devices.scanner = client.sensor(devices.feed, "scanner");
        devices.eye = client.sensor(devices.arm, "eye");
        Joints q{};
        for (std::size_t i = 0; i < q.size(); ++i) q[i] = client.joint(devices.arm, kJoints[i]).position;
        gripper_ = client.type(devices.arm).find_joint("fingers") ? Gripper::kFingers : Gripper::kSuction;
        devices_.push_back(devices);
        cells_.emplace_back(gripper_, q);
    }
    if (devices_.empty())
        throw std::runtime_error(
            "this world has no \"arm_0\" and \"feed_0\"\n"
            "  remedy: make a world with `roboss-world cells -o cells.sdf`");
}

Readings CellProgram::read(roboss::Client& client, const Devices& devices, const Cell& cell) const {
    Readings readings;
    readings.time_s = client.time_s();
    // Only sensors that are needed are read: without any, no scene for rays is built.
    if (cell.wants_barrier())
        readings.barrier_broken = std::isfinite(client.laser(devices.feed, devices.barrier).ranges[0]);
    if (cell.closes()) readings.eye = client.reading<roboss::InfraredReading>(devices.arm, devices.eye).range;
    if (gripper_ == Gripper::kFingers) readings.opening = client.joint(devices.arm, "fingers").position;
    for (std::size_t i = 0; i < readings.q.size(); ++i)
        readings.q[i] = client.joint(devices.arm, kJoints[i]).position;
    return readings;
}

bool CellProgram::touched(roboss::Client& client, const Devices& devices) const {
    const roboss::RobotType& type = client.type(devices.arm);
    for (std::size_t i = 0; i < type.sensors.size(); ++i)
        if (type.sensors[i].spec.as<roboss::ContactSpec>() != nullptr &&
            client.reading<roboss::ContactReading>(devices.arm, i).count() == 0)
            return false;
    return true;
}

/// Refused only if the Model changed under us; the next period tries again.
void CellProgram::obey(roboss::Client& client, const Devices& devices, Cell& cell,
                       const Orders& orders) const {
    for (std::size_t i = 0; i < orders.velocity.size(); ++i)
        (void)client.set_joint(devices.arm, kJoints[i], roboss::MotorMode::kVelocity, orders.velocity[i]);
    if (cell.state.belt_ordered != orders.belt_runs) {
        cell.state.belt_ordered = orders.belt_runs;
        (void)client.command(devices.feed, kBeltCommand, {orders.belt_runs ? kFeedSpeed : 0.0});
    }
    if (cell.state.hand_ordered == orders.hand_closes) return;
    cell.state.hand_ordered = orders.hand_closes;
    if (gripper_ == Gripper::kSuction)
        (void)client.command(devices.arm, "cup/grip", {orders.hand_closes ? 1.0 : 0.0});
    else
        (void)client.set_joint(devices.arm, "fingers", roboss::MotorMode::kVelocity,
                               orders.hand_closes ? -kFingerSpeed : kFingerSpeed, kFingerMotor);
}

void CellProgram::control_cell(roboss::Client& client, const Devices& devices, Cell& cell) const {
    const Readings readings = read(client, devices, cell);
    std::optional<SeenBox> seen;
    if (cell.wants_scan(readings.time_s)) seen = find_box(client.laser(devices.feed, devices.scanner).ranges);
    const bool felt = !cell.wants_touch(readings.time_s) || touched(client, devices);
    obey(client, devices, cell, cell.step(readings, seen, felt));
}

void CellProgram::report_all(double time_s) const {
    std::string line = "{\"time_s\": " + whole_seconds(time_s) + ", \"cells\": [";
    for (const Cell& cell : cells_)
        line += (&cell == cells_.data() ? "{" : ", {") + summary(cell.state) + "}";
    report(line + "]}", kResult);
}

void CellProgram::control(roboss::Client& client) {
    for (std::size_t i = 0; i < cells_.size(); ++i) control_cell(client, devices_[i], cells_[i]);
    if (reports_.is_due(client.time_s())) report_all(client.time_s());
}

std::string CellProgram::memory() const {
    std::string text = exact(reports_.last_s);
    const auto write = [&](const auto& value) { text += ' ' + exact(static_cast<double>(value)); };
    for (const Cell& cell : cells_) CellState::fields(write, cell.state);
    return text;
}

void CellProgram::restore(const std::string& memory) {
    std::istringstream text(memory);
    text >> reports_.last_s;
    const auto read = [&](auto& value) {
        double number = 0;
        text >> number;
        value = static_cast<std::remove_reference_t<decltype(value)>>(number);
    };
    for (Cell& cell : cells_) CellState::fields(read, cell.state);
}

}  // namespace
}  // namespace arm_cell

ROBOSS_CONTROL_PROGRAM(arm_cell::CellProgram)
