// The work of the cluster measurements: a world driven by the orders that its control program gave in a run
// recorded before (Clients take no part in what is measured), with what that run cost in one process and
// where it ended.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "journal/log_entries.h"
#include "model/model.h"
#include "roles/controller.h"

namespace roboss::bench {

struct Work {
    std::string name;
    std::shared_ptr<const Model> model;
    std::vector<SaidOrder> orders;
    Tick settle = 0, ticks = 0;  // measured are the ticks between
    std::uint64_t hash = 0;      // of the world after so many ticks
    double step_cpu_s = 0;       // of the stepping alone
    double process_cpu_s = 0;    // of the Controller and the Simulator in one process, without Clients

    StartingPoint start() const;
};

/// A file with the city of so many cars.
std::string city_file(std::size_t cars);

/// The world of `file`, run for `settle` and then to `ticks`; `driver`: shared library of its control
/// program, or empty. Throws std::runtime_error.
Work record(const std::string& name, const std::string& file, const std::string& driver, Tick settle,
            Tick ticks, std::size_t lanes);
/// The same work with all robots in one island: other costs, the same result.
Work as_one_island(Work work, std::size_t lanes);

}  // namespace roboss::bench
