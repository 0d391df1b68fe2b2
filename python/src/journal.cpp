// Journals: what a file has recorded, and simulations at any of its times.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cinttypes>
#include <cstdio>

#include "bindings.h"
#include "roboss/core/output_check.h"
#include "roboss/journal/journal.h"
#include "simulation.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

std::string hex(std::uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, hash);
    return text;
}

/// What a LocalRun continues from: the states of the checkpoint, and the orders that the branch has from
/// there on.
LocalSave save_of(const Model& model, const SavedRun& run) {
    LocalSave save{model.hash, run.seed, run.tick, run.states, {}, 0};
    for (const LoggedOrder& logged : run.orders) save.orders.push_back(logged.order);
    std::ranges::stable_sort(save.orders, comes_before);
    for (const Order& order : save.orders)  // orders of this program follow its earlier ones
        if (order.client == ClientId(0U)) save.given = std::max(save.given, order.sequence + 1);
    return save;
}

/// The simulation at a tick of the branch, with its later orders waiting if `follow`: those that apply before
/// `until`, where another branch may go on.
Result<std::shared_ptr<LocalRun>> run_at(const Journal& journal, const Branch& branch,
                                         const std::shared_ptr<const Model>& model, Tick tick, Tick until,
                                         bool follow, unsigned threads) {
    const CheckpointEntry* before = journal.checkpoint_before(branch, tick);
    if (before == nullptr)
        return Error{"there is no checkpoint before tick " + std::to_string(tick), "give a later time",
                     "no-such-time"};
    Result<SavedRun> saved = journal.run_from(branch, *before, *model, std::max(tick, until));
    if (!saved) return saved.error();
    Result<std::unique_ptr<LocalRun>> run =
        LocalRun::create(model, {.threads = threads, .seed = saved.value().seed});
    if (!run) return run.error();
    LocalSave save = save_of(*model, saved.value());
    if (!follow) std::erase_if(save.orders, [&](const Order& order) { return order.apply_at >= tick; });
    if (Result<> done = run.value()->restore(save); !done) return done.error();
    if (Result<> done = run.value()->step(tick - run.value()->tick()); !done) return done.error();
    return std::shared_ptr<LocalRun>(std::move(run).value());
}

std::shared_ptr<Simulation> at(const Journal& journal, BranchId id, const std::shared_ptr<const Model>& model,
                               Tick tick, Tick until, bool follow, unsigned threads) {
    const Branch branch = value_or_raise(journal.branch(id), "JournalError");
    Result<std::shared_ptr<LocalRun>> run = [&] {
        const nb::gil_scoped_release release;
        return run_at(journal, branch, model, tick, until, follow, threads);
    }();
    return std::make_shared<Simulation>(model, value_or_raise(std::move(run), "JournalError"));
}

/// (branch, from, until) of each part of the lineage. The last ends where the branch is committed.
nb::list parts_of(const Journal& journal, BranchId id) {
    const Branch branch = value_or_raise(journal.branch(id), "JournalError");
    const Lineage lineage = journal.lineage(branch);
    nb::list all;
    for (const Lineage::Part& part : lineage.parts())
        all.append(nb::make_tuple(part.branch, part.from, part.branch == id ? branch.committed : part.until));
    return all;
}

/// The branch of the lineage that holds the tick.
BranchId holder(const Journal& journal, BranchId id, Tick tick, double dt_s) {
    const Branch branch = value_or_raise(journal.branch(id), "JournalError");
    return value_or_raise(journal.holder(journal.lineage(branch), tick, dt_s), "JournalError").id;
}

nb::list checkpoints(const Journal& journal, BranchId id) {
    nb::list all;
    for (const CheckpointEntry& entry :
         journal.checkpoints(value_or_raise(journal.branch(id), "JournalError")))
        all.append(nb::make_tuple(entry.tick, hex(entry.hash)));
    return all;
}

}  // namespace

void bind_journal(nb::module_& module) {
    nb::class_<Branch>(module, "Branch")
        .def_ro("id", &Branch::id)
        .def_ro("parent", &Branch::parent)
        .def_ro("seed", &Branch::seed)
        .def_ro("reason", &Branch::reason)
        .def_ro("world_file", &Branch::world_file)
        .def_ro("first_tick", &Branch::first)
        .def_ro("last_tick", &Branch::committed)
        .def_prop_ro("last_hash", [](const Branch& b) { return b.hash == 0 ? std::string() : hex(b.hash); });

    nb::class_<Journal>(module, "Journal")
        .def_prop_ro("branches", [](const Journal& j) { return j.branches(); })
        .def(
            "model",
            [](const Journal& j, BranchId id) {
                return value_or_raise(j.model(value_or_raise(j.branch(id), "JournalError")), "JournalError");
            },
            nb::arg("branch"))
        .def(
            "world_hash",
            [](const Journal& j, BranchId id) {
                return hex(j.world_hash(value_or_raise(j.branch(id), "JournalError")));
            },
            nb::arg("branch"))
        .def("checkpoints", &checkpoints, nb::arg("branch"))
        .def("at", &at, nb::arg("branch"), nb::arg("model"), nb::arg("tick"), nb::arg("until"),
             nb::arg("follow"), nb::arg("threads"))
        .def("lineage", &parts_of, nb::arg("branch"))
        .def("holder", &holder, nb::arg("branch"), nb::arg("tick"), nb::arg("dt"));
    module.def(
        "check_output",
        [](const std::string& path, const std::string& kind, const std::vector<std::string>& reads) {
            OutputCheck check;
            for (const std::string& read : reads) check.reads(read);
            check.writes("the output", path, kind);
            if (const Result<> fine = check.check(); !fine) raise("ArgumentError", fine.error());
        },
        nb::arg("path"), nb::arg("kind"), nb::arg("reads"));
    module.def(
        "open_journal",
        [](const std::string& path) {
            return std::make_shared<Journal>(value_or_raise(Journal::open(path), "JournalError"));
        },
        nb::arg("path"));
}

}  // namespace roboss_python
