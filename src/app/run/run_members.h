// RunMembers: the other members of a run, and the Bus that connects them. The run itself does not depend on
// who its members are.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/processes/companion.h"
#include "app/processes/simulator_processes.h"
#include "app/run/run_options.h"
#include "net/stream_bus.h"
#include "simulation/simulation.h"

namespace roboss {

class RunMembers {
  public:
    /// Opens the network and starts the processes that the options ask for; with neither, there are no other
    /// members. `prepared_ms`: CPU time that the Model took here; a process needs as much for it.
    static Result<std::unique_ptr<RunMembers>> gather(const RunOptions& options, std::int64_t prepared_ms);

    /// Sets the members that the run waits for, and the time after which a silent one counts as lost.
    void configure(SimulationOptions& options) const;
    /// For Simulation::create(); null: all members are in this process.
    std::unique_ptr<Bus> take_bus();
    /// Others may take part from their own processes.
    bool reaches_others() const { return open_bus_ != nullptr; }
    /// Starts a process more, if the run has its Simulators in processes of this computer; false: it has not.
    Result<bool> add_simulator();
    /// True for a Simulator of this name in a process that this run started.
    bool owns(const std::string& name) const { return processes_.has(name); }
    /// Kills a process that this run started, by the name of its Simulator.
    Result<> kill(const std::string& name);
    /// To be called now and then. An Error: processes of the run's own died or never joined, and it cannot go
    /// on.
    Result<> look_after(const Simulation& simulation);
    /// What happened since the last call, one line each.
    std::vector<std::string> take_notices();
    /// Says why the run is over to all who are connected, and waits some seconds for the processes to end;
    /// not if they are `abandoned`.
    void end(const RunOver& over, bool abandoned);

  private:
    explicit RunMembers(const RunOptions& options) : o_(options) {}
    Result<> open_network();
    Result<> start_process();
    Result<> start_companion(const char* what, std::vector<std::string> words);
    Result<> watch_start(const Simulation& simulation);

    const RunOptions& o_;
    NetOptions network_;
    std::unique_ptr<StreamBus> bus_;
    StreamBus* open_bus_ = nullptr;  // the same; the Simulation owns it then
    SimulatorProcesses processes_;
    std::vector<Companion> companions_;  // speak to ROS 2 nodes, and to Foxglove
    std::int64_t patience_ms_ = 0;       // with processes that do not join
    std::vector<std::string> notices_;
    std::int64_t looked_ms_ = 0;
    int started_again_ = 0;
};

}  // namespace roboss
