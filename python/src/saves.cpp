// Saved states: files of `roboss run --save`, and bytes of worlds and states for pickle.
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <span>

#include "bindings.h"
#include "roboss/core/hash.h"
#include "roboss/journal/saved_run.h"
#include "roboss/wire/model_codec.h"
#include "simulation.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

nb::bytes to_python(const std::vector<std::uint8_t>& bytes) {
    return nb::bytes(bytes.data(), bytes.size());
}

std::span<const std::uint8_t> view_of(const nb::bytes& bytes) {
    return {reinterpret_cast<const std::uint8_t*>(bytes.c_str()), bytes.size()};
}

/// The orders that wait, as a log has them: all were given before the tick of the save.
std::vector<LoggedOrder> waiting_of(const LocalSave& save) {
    std::vector<LoggedOrder> waiting;
    for (const Order& order : save.orders) waiting.push_back({order, save.tick - 1});
    return waiting;
}

/// A hash of the bytes of states and orders, to notice damage.
std::uint64_t check_of(std::span<const std::uint8_t> states, std::span<const std::uint8_t> orders) {
    Hash hash;
    hash.add(hash_of_bytes(states));
    hash.add(hash_of_bytes(orders));
    return hash.value();
}

/// (model, tick, seed, how many orders were numbered, states, orders, their check): what saved_of() takes.
nb::tuple saved_parts_of(const Saved& saved) {
    const LocalSave& save = saved.save;
    LogBatch waiting;
    waiting.orders = waiting_of(save);
    const std::vector<std::uint8_t> states = encode_states(save.states), orders = encode(waiting);
    return nb::make_tuple(saved.model, save.tick, save.seed, save.given, to_python(states), to_python(orders),
                          check_of(states, orders));
}

Saved saved_of(std::shared_ptr<const Model> model, Tick tick, std::uint64_t seed, std::uint64_t given,
               const nb::bytes& states, const nb::bytes& orders, std::uint64_t check) {
    if (check_of(view_of(states), view_of(orders)) != check)
        raise("SaveError", {"the bytes of a saved state are damaged", "take another copy", "damaged"});
    LocalSave save{model->hash, seed, tick, {}, {}, given};
    save.states = value_or_raise(decode_states(view_of(states), *model), "SaveError");
    const LogBatch waiting = value_or_raise(decode_batch(view_of(orders)), "SaveError");
    for (const LoggedOrder& logged : waiting.orders) {
        if (const Result<> fine = check_order(*model, logged.order); !fine) raise("SaveError", fine.error());
        save.orders.push_back(logged.order);
    }
    return {std::move(model), std::move(save)};
}

/// `world_hash`: of the Model of the world file, which may have had other robots.
void write_save(const Saved& saved, const std::string& path, const std::string& world_file,
                std::uint64_t world_hash) {
    const LocalSave& save = saved.save;
    SavedRun run;
    run.world_file = world_file;
    run.world_hash = world_hash == saved.model->hash ? 0 : world_hash;
    run.seed = save.seed;
    run.tick = run.logged_until = save.tick;
    run.states = save.states;
    run.orders = waiting_of(save);
    const Result<> written = [&] {
        const nb::gil_scoped_release release;
        return save_run(path, *saved.model, run);
    }();
    if (!written) raise("SaveError", written.error());
}

}  // namespace

void bind_saves(nb::module_& module) {
    nb::class_<Saved>(module, "Save")
        .def_prop_ro("tick", [](const Saved& s) { return s.save.tick; })
        .def_prop_ro("seed", [](const Saved& s) { return s.save.seed; })
        .def("parts", &saved_parts_of)
        .def("write", &write_save, nb::arg("path"), nb::arg("world_file"), nb::arg("world_hash"))
        .def("__deepcopy__", [](nb::object self, const nb::dict&) { return self; });
    module.def("save_of", &saved_of, nb::arg("model"), nb::arg("tick"), nb::arg("seed"), nb::arg("given"),
               nb::arg("states"), nb::arg("orders"), nb::arg("check"));
    module.def(
        "may_save_to",
        [](const std::string& path) {
            if (const Result<> may = may_save_to(path); !may) raise("ArgumentError", may.error());
        },
        nb::arg("path"));
    module.def("model_bytes", [](const Model& model) { return to_python(encode_model(model)); });
    module.def("model_of", [](const nb::bytes& bytes) {
        return value_or_raise(decode_model(view_of(bytes)), "WorldError");
    });
}

}  // namespace roboss_python
