// VirtualCluster: a Controller and any number of Simulators, each on a computer of its own, measured on one
// core (virtual_network.h). The role that can go on first is given its turn, as in any discrete-event
// simulation, so the Controller's clock at the end is the time that the run would have taken on so many
// computers. What is measured is the real code at work on real states.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "cluster/virtual_network.h"
#include "roles/controller/controller.h"
#include "roles/simulator/simulator.h"

namespace roboss::bench {

class VirtualCluster {
  public:
    struct Options {
        std::size_t simulators = 1;
        std::size_t lanes = 1;
        bool measure_cpu = true;  // SimulatorOptions
        NetworkCosts network;
        ControllerOptions controller;
    };
    VirtualCluster(std::shared_ptr<const Model> model, const Options& options, StartingPoint start);

    /// Runs until the world rests at this tick. `committed` is called after every window, with the
    /// Controller's clock. Throws std::runtime_error if the run fails.
    void run_until(Tick target, const std::function<void(double time_s)>& committed = {});

    double time_s() const { return 1e-9 * static_cast<double>(network_.clock_ns(0)); }
    /// CPU time of the Controller's own work, messages included.
    double controller_cpu_s() const { return 1e-9 * static_cast<double>(network_.spent_ns(0)); }
    Controller& controller() { return *controller_; }
    const VirtualNetwork& network() const { return network_; }

  private:
    void turn(std::size_t member, std::int64_t start_ns);

    std::shared_ptr<const Model> model_;
    VirtualNetwork network_;
    ThreadPool pool_{1};
    std::unique_ptr<Controller> controller_;
    std::vector<std::unique_ptr<Simulator>> simulators_;  // none: has gone
};

}  // namespace roboss::bench
