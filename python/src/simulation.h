// Simulation: a LocalRun that one thread of Python uses at a time. While it works without the GIL, calls of
// other threads raise instead of reading half a state.
#pragma once

#include <nanobind/nanobind.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "errors.h"
#include "roboss/local/local_run.h"

namespace roboss_python {

class Simulation {
  public:
    Simulation(std::shared_ptr<const roboss::Model> model, std::shared_ptr<roboss::LocalRun> run)
        : model_(std::move(model)), run_(std::move(run)) {}

    const std::shared_ptr<const roboss::Model>& model() const { return model_; }

    /// The run; raises StateError while another thread is inside. The GIL must be held.
    roboss::LocalRun& run() {
        if (!run_)
            raise("StateError", {"robots were spawned or removed since these were asked for",
                                 "ask Simulation.robots() again", "changed-world"});
        if (busy_)
            raise("StateError", {"the simulation is in use by another thread",
                                 "let one thread at a time use it, or give each its own", "busy"});
        return *run_;
    }

    /// The run goes on in another Simulation.
    void retire() { run_.reset(); }

    /// Whether a thread that does not hold the GIL is inside.
    void set_busy(bool busy) { busy_ = busy; }

  private:
    std::shared_ptr<const roboss::Model> model_;
    std::shared_ptr<roboss::LocalRun> run_;
    bool busy_ = false;
};

using Simulations = std::vector<std::shared_ptr<Simulation>>;

/// Calls work() without the GIL, while the simulations are busy, and returns what it returns.
template <class Work>
auto without_gil(const Simulations& simulations, Work work) {
    for (const auto& simulation : simulations) simulation->run();
    for (const auto& simulation : simulations) simulation->set_busy(true);
    const auto idle = [](const Simulations* busy) {
        for (const auto& simulation : *busy) simulation->set_busy(false);
    };
    const std::unique_ptr<const Simulations, decltype(idle)> end(&simulations, idle);  // with the GIL again
    const nanobind::gil_scoped_release release;
    return work();
}

/// How many ticks a call without the GIL makes: parts of about a tenth of a second, so that Ctrl-C is obeyed
/// between them. No bit depends on the parts. step(ticks) is called until all are done.
template <class Step>
void step_in_parts(roboss::Tick ticks, Step step) {
    if (ticks < 0)
        raise("ArgumentError",
              {"a step of " + std::to_string(ticks) + " ticks", "give 0 or more", "bad-ticks"});
    roboss::Tick part = 16;
    while (ticks > 0) {
        const roboss::Tick now = std::min(part, ticks);
        const auto start = std::chrono::steady_clock::now();
        step(now);
        if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
        ticks -= now;
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        if (took.count() < 0.05) part *= 2;
    }
}

}  // namespace roboss_python
