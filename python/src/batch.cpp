// Many simulations, of one world or of several, on one pool of threads.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "simulation.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

struct Batch {
    std::shared_ptr<LocalBatch> runs;
    Simulations simulations;  // one for each run
};

Batch make_batch(const std::vector<std::shared_ptr<const Model>>& models, unsigned threads,
                 std::uint64_t seed) {
    Batch batch;
    batch.runs = value_or_raise(LocalBatch::create(models, {.threads = threads, .seed = seed}), "WorldError");
    for (std::size_t i = 0; i < models.size(); ++i) {
        const std::shared_ptr<LocalRun> run(batch.runs, &batch.runs->run(i));
        batch.simulations.push_back(std::make_shared<Simulation>(models[i], run));
        batch.simulations.back()->set_batch(batch.runs);
    }
    return batch;
}

/// Which simulations stopped before the last tick.
std::vector<bool> step_batch(Batch& batch, Tick ticks) {
    std::vector<bool> stopped(batch.simulations.size());
    step_in_parts(ticks, [&](Tick part) {
        const std::vector<Result<>> results =
            without_gil(batch.simulations, [&] { return batch.runs->step(part); });
        for (std::size_t i = 0; i < results.size(); ++i) stopped[i] = stopped[i] || !results[i].ok();
    });
    return stopped;
}

}  // namespace

void bind_batch(nb::module_& module) {
    nb::class_<Batch>(module, "Batch")
        .def("step", &step_batch, nb::arg("ticks"))
        .def_prop_ro("threads", [](const Batch& batch) { return batch.runs->threads(); })
        .def_ro("simulations", &Batch::simulations);
    module.def("batch", &make_batch, nb::arg("models"), nb::arg("threads"), nb::arg("seed"));
}

}  // namespace roboss_python
