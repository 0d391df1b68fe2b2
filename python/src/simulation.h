// Simulation: a LocalRun that one thread of Python uses at a time. While it works without the GIL, calls of
// other threads raise instead of reading half a state.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>

#include "errors.h"
#include "roboss/local/local_run.h"

namespace roboss_python {

class Simulation {
  public:
    Simulation(std::shared_ptr<const roboss::Model> model, const roboss::LocalRunOptions& options)
        : model_(std::move(model)),
          run_(value_or_raise(roboss::LocalRun::create(model_, options), "WorldError")) {}

    const std::shared_ptr<const roboss::Model>& model() const { return model_; }

    /// The run; raises StateError while another thread is inside. The GIL must be held.
    roboss::LocalRun& run() {
        if (busy_)
            raise("StateError", {"the simulation is in use by another thread",
                                 "let one thread at a time use it, or give each its own", "busy"});
        return *run_;
    }

    /// Calls work(run) without the GIL, and returns what it returns.
    template <class Work>
    auto without_gil(Work work) {
        roboss::LocalRun& run = this->run();
        busy_ = true;
        const auto idle = [](bool* busy) { *busy = false; };
        const std::unique_ptr<bool, decltype(idle)> end(&busy_, idle);  // with the GIL again
        const nanobind::gil_scoped_release release;
        return work(run);
    }

  private:
    std::shared_ptr<const roboss::Model> model_;
    std::unique_ptr<roboss::LocalRun> run_;
    bool busy_ = false;
};

}  // namespace roboss_python
