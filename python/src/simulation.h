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
#include "live_array.h"
#include "roboss/local/local_batch.h"
#include "roboss/local_view/local_view.h"

namespace roboss_python {

class Simulation {
  public:
    Simulation(std::shared_ptr<const roboss::Model> model, std::shared_ptr<roboss::LocalRun> run)
        : model_(std::move(model)), run_(std::move(run)), access_(run_) {}

    /// A run elsewhere: only what access() has can be asked.
    Simulation(std::shared_ptr<const roboss::Model> model, std::shared_ptr<roboss::RunAccess> remote)
        : model_(std::move(model)), access_(std::move(remote)) {}

    const std::shared_ptr<const roboss::Model>& model() const { return model_; }

    /// The run, stepped here; raises as access().
    roboss::LocalRun& run() {
        (void)access();
        if (!run_) raise("StateError", {"the run is stepped elsewhere", "load its world here", "remote"});
        return *run_;
    }

    /// What is asked of any run; raises StateError while another thread is inside. The GIL must be held.
    roboss::RunAccess& access() {
        if (!access_)
            raise("StateError", {"robots were spawned or removed since these were asked for",
                                 "ask Simulation.robots() again", "changed-world"});
        if (busy_)
            raise("StateError", {"the simulation is in use by another thread",
                                 "let one thread at a time use it, or give each its own", "busy"});
        return *access_;
    }

    /// The run continues in another Simulation, or without this program.
    void retire() { run_.reset(), access_.reset(); }

    /// Whether a thread that does not hold the GIL is inside.
    void set_busy(bool busy) { busy_ = busy; }
    bool busy() const { return busy_; }

    /// It is run number i of the batch, as the simulations beside it.
    void set_batch(std::shared_ptr<roboss::LocalBatch> batch) { batch_ = std::move(batch); }
    const std::shared_ptr<roboss::LocalBatch>& batch() const { return batch_; }

    /// From now on refresh() brings this part of the array up to date.
    void feed(const std::shared_ptr<LiveArray>& array, std::size_t part) {
        std::erase_if(fed_, [](const Fed& fed) { return fed.array.expired(); });
        fed_.push_back({array, part});
    }
    /// After what changes states: the arrays that Python holds follow. The GIL must be held.
    void refresh() {
        if (!access_ || busy_) return;
        for (const Fed& fed : fed_)
            if (const auto array = fed.array.lock(); array && array->is_held())
                array->update(fed.part, *access_);
    }

    /// From now on `view` shows the run; null: none does.
    void show_in(std::shared_ptr<roboss::LocalView> view, roboss::Looks looks) {
        view_ = std::move(view), looks_ = std::move(looks);
    }
    bool viewed() const { return view_ != nullptr; }
    /// Brings the view up to date. The GIL must be held; nothing happens while a thread is inside.
    void turn_view() {
        if (view_ && run_ && !busy_) view_->turn(*run_, looks_);
    }

  private:
    struct Fed {
        std::weak_ptr<LiveArray> array;
        std::size_t part;
    };

    std::shared_ptr<const roboss::Model> model_;
    std::shared_ptr<roboss::LocalRun> run_;  // null: stepped elsewhere, or retired
    std::shared_ptr<roboss::RunAccess> access_;
    bool busy_ = false;
    std::vector<Fed> fed_;
    std::shared_ptr<roboss::LocalBatch> batch_;  // null: it is alone
    std::shared_ptr<roboss::LocalView> view_;
    roboss::Looks looks_;
};

using Simulations = std::vector<std::shared_ptr<Simulation>>;

/// The state that a run continues from, and the world that it is of.
struct Saved {
    std::shared_ptr<const roboss::Model> model;
    roboss::LocalSave save;
};

/// Calls work() without the GIL, while the simulations are busy, and returns what it returns.
template <class Work>
auto without_gil(const Simulations& simulations, Work work) {
    for (const auto& simulation : simulations) (void)simulation->access();
    for (const auto& simulation : simulations) simulation->set_busy(true);
    const auto idle = [](const Simulations* busy) {
        for (const auto& simulation : *busy) simulation->set_busy(false), simulation->refresh();
        for (const auto& simulation : *busy) simulation->turn_view();
    };
    const std::unique_ptr<const Simulations, decltype(idle)> end(&simulations, idle);  // with the GIL again
    const nanobind::gil_scoped_release release;
    return work();
}

/// Calls work(i, run) for each simulation, those of a batch on its threads; without the GIL, as
/// without_gil(). work() must not throw.
template <class Work>
void for_each_run(const Simulations& simulations, Work work) {
    std::vector<roboss::RunAccess*> runs;
    for (const auto& simulation : simulations) runs.push_back(&simulation->access());
    const std::shared_ptr<roboss::LocalBatch> batch = simulations.front()->batch();
    without_gil(simulations, [&] {
        if (batch && batch->size() == runs.size())
            batch->for_each([&](std::size_t i, roboss::LocalRun&) { work(i, *runs[i]); });
        else
            for (std::size_t i = 0; i < runs.size(); ++i) work(i, *runs[i]);
    });
}

/// About how long a part of a step takes: Ctrl-C is obeyed between two; and while a view shows them.
inline constexpr double kPart_s = 0.1, kViewedPart_s = 0.02;

/// Calls step(ticks) in parts that take about `part_s` each, until all are done. No bit depends on the parts.
template <class Step>
void step_in_parts(roboss::Tick ticks, Step step, double part_s = kPart_s) {
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
        if (took.count() < 0.5 * part_s)
            part *= 2;
        else if (took.count() > part_s && part > 1)
            part /= 2;
    }
}

}  // namespace roboss_python
