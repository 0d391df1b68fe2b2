// RunMembers: who takes part in a run beside this process, and over which Bus they talk. The run itself is
// the same whoever comes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/run_options.h"
#include "app/simulator_processes.h"
#include "dds/dds_bus.h"
#include "simulation/simulation.h"

namespace roboss {

class RunMembers {
  public:
    /// Opens the network and starts the processes that the options ask for; with neither, there is nobody.
    /// `prepared_ms`: CPU time that the Model took here; a process needs as much for it.
    static Result<std::unique_ptr<RunMembers>> gather(const RunOptions& options, std::int64_t prepared_ms);

    /// Says whom the run waits for and how members are missed.
    void configure(SimulationOptions& options) const;
    /// For Simulation::create(); none: everybody is in this process.
    std::unique_ptr<Bus> take_bus();
    /// Others may take part from their own processes.
    bool reaches_others() const { return open_bus_ != nullptr; }
    /// Starts a process more, if the run has its Simulators in processes of this computer; false: it has not.
    Result<bool> add_simulator();
    /// Ends this process of the run's own, by the name that its Simulator gave, without a word to it.
    Result<> kill(const std::string& name);
    /// To be called now and then. An Error: processes of the run's own died or never joined, and it cannot go
    /// on.
    Result<> look_after(const Controller& controller);
    /// What happened since the last call, one line each.
    std::vector<std::string> take_notices();
    /// Once the Controller has dismissed everybody: sees them off, at most for some seconds; none where they
    /// have failed.
    void await_exit(bool failed);

  private:
    explicit RunMembers(const RunOptions& options) : o_(options) {}
    Result<> open_network();
    Result<> start_process();
    Result<> watch_start(const Controller& controller);

    const RunOptions& o_;
    DdsOptions network_;
    std::unique_ptr<DdsBus> bus_;
    DdsBus* open_bus_ = nullptr;  // the same; the Simulation owns it then
    SimulatorProcesses processes_;
    std::int64_t patience_ms_ = 0;  // with processes that do not join
    std::vector<std::string> notices_;
    int started_again_ = 0;
};

}  // namespace roboss
