// VirtualCluster: a Controller and any number of Simulators, each on a computer of its own, measured on one core.
// Every role has a clock that runs by the CPU time of its own work; a message arrives when its sender's clock said,
// plus what the way takes. The role that can go on first is given its turn, as in any discrete-event simulation, so
// the Controller's clock at the end is the time that the run would have taken on so many computers. What is measured is
// the real code at work on real states; only the network is a model, of three numbers (NetworkCosts).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "bus/bus.h"
#include "roles/controller.h"
#include "roles/simulator.h"

namespace roboss::bench {

/// Of one message between two computers, beside encoding and decoding, which are measured as they happen.
struct NetworkCosts {
    double send_us = 0;  // CPU time that sending costs the sender
    double way_us = 0;   // from there until the receiver can have it
    double bytes_per_us = 1250;  // 10 Gbit/s
};

/// Bytes and messages since the beginning.
struct Traffic {
    std::uint64_t messages = 0, bytes = 0;
};

class VirtualCluster {
  public:
    struct Options {
        std::size_t simulators = 1;
        std::size_t lanes = 1;
        NetworkCosts network;
        ControllerOptions controller;
    };
    VirtualCluster(std::shared_ptr<const Model> model, const Options& options, StartingPoint start);
    ~VirtualCluster();

    /// Runs until the world rests at this tick. `committed` is called after every window, with the Controller's clock.
    /// Throws std::runtime_error if the run fails.
    void run_until(Tick target, const std::function<void(double time_s)>& committed = {});
    /// The Simulator with the highest number leaves, in good order.
    void send_one_home();

    double time_s() const;  // the Controller's clock
    /// CPU time of the Controller's own work, messages included.
    double controller_cpu_s() const;
    std::size_t simulators() const;
    Controller& controller() { return *controller_; }
    /// From Simulators to the Controller, by message name.
    const std::map<std::string, Traffic>& to_controller() const;

  private:
    class Network;
    void turn(std::size_t member);
    bool go_on();

    std::shared_ptr<const Model> model_;
    std::unique_ptr<Network> network_;
    ThreadPool pool_{1};
    std::unique_ptr<Controller> controller_;
    std::vector<std::unique_ptr<Simulator>> simulators_;  // none: has gone
};

/// CPU time of this thread, ns.
std::int64_t thread_cpu_ns();

}  // namespace roboss::bench
