// The work of the cluster measurements: a world driven by the orders that its control program gave in a run
// recorded before (Clients take no part in what is measured), with where that run ended; and the same in one
// process, for its cost.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "journal/log_entries.h"
#include "model/model.h"
#include "roles/controller/controller.h"
#include "simulation/simulation.h"

namespace roboss::bench {

struct Work {
    std::string name;
    std::shared_ptr<const Model> model;
    std::vector<LoggedOrder> orders;
    Tick settle = 0, ticks = 0;      // measured are the ticks between
    Tick before = 0;                 // of the settling, when nearly all of it was done
    std::vector<RobotState> states;  // at `before`
    std::uint64_t hash = 0;          // of the world after so many ticks

    StartingPoint start() const;
};

/// A file with the city of so many cars.
std::string city_file(std::size_t cars);

/// The world of `file`, run for `settle` and then to `ticks`; `driver`: shared library of its control
/// program, or empty. Throws std::runtime_error.
Work record(const std::string& name, const std::string& file, const std::string& driver, Tick settle,
            Tick ticks, std::size_t lanes);

/// Work stepped in one process from `settle` on (warmed up from `before`), without Clients. Its turns come
/// between those of the cluster that it is compared with, for a machine is not equally fast all the time.
class OneProcess {
  public:
    /// `one_island`: of all robots; the result is the same.
    OneProcess(const Work& work, std::size_t lanes, bool one_island);

    void run_until(Tick tick);
    double step_cpu_s() const { return simulation_->counters().step_cpu_s - warm_s_; }  // stepping alone
    double cpu_s() const { return cpu_s_; }  // of the Controller and the Simulator
    std::uint64_t hash() const { return simulation_->hash(); }

  private:
    std::unique_ptr<Simulation> simulation_;
    double warm_s_ = 0, cpu_s_ = 0;
};

}  // namespace roboss::bench
