// Twin: a real robot among simulated ones. A free-running Client of a run puts the robot of the same name
// where the device says it is (levels 1 and 2), so that simulated robots see it, touch it and drive round it.
#pragma once

#include <span>

#include "client/bus_client.h"
#include "device/device_client.h"

namespace roboss {

class Twin {
  public:
    /// All stay with the caller. The devices are of the run's Model.
    Twin(BusClient& client, std::span<const Device> devices) : client_(client), devices_(devices) {}

    /// Takes observations, and answers each with where the real robots are now. Never waits.
    void advance(Bus& bus);
    /// From now on robots are placed with zero velocity. Call it when their devices have stopped.
    void stop() { stopped_ = true; }
    /// A robot as the run has it, for programs that ask for the others; null before the first observation.
    const RobotState* state(RobotId robot) const;
    /// How often the twins were put.
    std::uint64_t placed() const { return placed_; }

  private:
    void place(const Device& device);
    const PoseReading* pose_of(RobotId robot) const;

    BusClient& client_;
    std::span<const Device> devices_;
    bool shown_ = false, stopped_ = false;
    std::uint64_t placed_ = 0;
};

/// As Client of a run: free-running, observing every `period_s`.
BusClientOptions twin_options(const Model& model, const std::string& name, double period_s = 0.02);

}  // namespace roboss
