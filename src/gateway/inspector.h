// Inspector: what pages look at closely. From exact states, in the gateway's thread, it computes what a
// Client would: poses, motors and sensors of watched robots, contacts of the world. Pure functions of (Model,
// states), so that looking changes nothing. A sensor with an <update_rate> is read no oftener than that.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/held_samples.h"
#include "gateway/exchange.h"
#include "gateway/radio_links.h"
#include "physics/probe.h"
#include "sensors/readings.h"

namespace roboss {

class Inspector : private SensorSources {
  public:
    void begin(std::shared_ptr<const ShownScene> scene);
    void take(const StateBlock& block);
    /// Its state at tick() is here, and all that its sensors see; in a small world everybody's.
    bool shows(RobotId robot) const;
    Tick tick() const { return tick_; }
    /// All states of tick() are here: lasers and contacts can be had.
    bool complete() const { return known_ == states_.size(); }

    /// All of them, once complete().
    std::vector<RobotState> all_states() const;

    /// The JSON of "robot", of a robot that it shows().
    std::string robot(RobotId robot);
    /// The JSON of "numbers", of a robot that it shows(); empty: it has no such joint axis or link.
    std::string numbers(const NumbersWish& wish);
    /// The JSON of "overlay" with the contacts, once complete().
    std::string contacts();
    /// The JSON of "overlay" with who hears whom by radio, once complete().
    std::string radio();

  private:
    RayScene& ray_scene() override;
    StepProbe& step_probe() override;
    const RobotState& state_of(RobotId robot) override;
    bool is_due(RobotId robot, std::size_t sensor) const;
    /// What it measured last, now if it is due; nullptr: nothing reads it.
    const Sample* sample(RobotId robot, std::size_t sensor);

    std::shared_ptr<const ShownScene> scene_;
    Tick tick_ = -1;
    std::vector<std::optional<RobotState>> states_;  // by RobotId, at tick_
    std::size_t known_ = 0;
    std::unique_ptr<RayScene> rays_;
    Tick rays_tick_ = -1;
    HeldSamples samples_;
    std::unique_ptr<StepProbe> probe_;
    RadioLinks radio_;
};

}  // namespace roboss
