// Stepping, saving, and contacts.
#include "simulation.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cinttypes>
#include <cstdio>
#include <tuple>

#include "bindings.h"
#include "looks.h"
#include "roboss/math/array_rows.h"
#include "roboss/model/edit.h"
#include "roboss/physics/start_overlaps.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

/// One row of Simulation.contacts; CONTACT of roboss/simulation.py names the same fields.
struct ContactRow {
    std::int32_t robot_a, robot_b, link_a, link_b;
    double position[3], normal[3], gap, force[3], torque[3];
};
static_assert(sizeof(ContactRow) == 16 + 13 * 8);

ContactRow row_of(const ContactReport& contact, double dt_s) {
    const auto index = [](auto id) { return id.valid() ? static_cast<std::int32_t>(id.value) : -1; };
    ContactRow row{index(contact.robot_a),
                   index(contact.robot_b),
                   index(contact.link_a),
                   index(contact.link_b),
                   {},
                   {},
                   contact.gap,
                   {},
                   {}};
    put_row(contact.p_W, row.position);
    put_row(contact.normal, row.normal);
    put_row((contact.normal * contact.impulse + contact.friction) * (1 / dt_s), row.force);
    put_row(contact.moment * (1 / dt_s), row.torque);
    return row;
}

nb::ndarray<nb::numpy, std::uint8_t> contacts(const std::shared_ptr<Simulation>& simulation) {
    RunAccess& run = simulation->access();
    const std::span<const ContactReport> all = without_gil({simulation}, [&] { return run.contacts(); });
    auto rows = std::make_unique<std::vector<ContactRow>>();
    for (const ContactReport& contact : all) rows->push_back(row_of(contact, simulation->model()->dt_s));
    const std::size_t bytes = rows->size() * sizeof(ContactRow);
    auto* const data = reinterpret_cast<std::uint8_t*>(rows->data());
    const nb::capsule owner(rows.release(),
                            [](void* p) noexcept { delete static_cast<std::vector<ContactRow>*>(p); });
    return {data, {bytes}, owner};
}

void step_simulation(const std::shared_ptr<Simulation>& simulation, Tick ticks) {
    LocalRun& run = simulation->run();
    const auto step_part = [&](Tick part) {
        const Result<> stepped = without_gil({simulation}, [&] { return run.step(part); });
        if (!stepped) raise("StateError", stepped.error());
    };
    step_in_parts(ticks, step_part, simulation->viewed() ? kViewedPart_s : kPart_s);
}

std::string hash_of(Simulation& simulation) {
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, simulation.access().hash());
    return text;
}

Attach attach_of(std::uint32_t link, std::uint32_t other, std::uint32_t other_link, double reach,
                 double max_force, double max_torque) {
    return {LinkId(link), RobotId(other), LinkId(other_link), reach, max_force, max_torque};
}

void order(Simulation& simulation, std::uint32_t robot, const Action& action) {
    const Result<> given = simulation.access().order({Order{0, ClientId(0U), 0, RobotId(robot), action}});
    if (!given) raise("OrderError", given.error());
}

/// (the simulation that goes on, its model, by old number of a robot the new one or -1); the old simulation
/// is retired.
using Edited = std::tuple<std::shared_ptr<Simulation>, std::shared_ptr<const Model>, std::vector<long>>;

Edited edited(Simulation& simulation, const Result<ModelEdit>& edit) {
    const ModelEdit change = value_or_raise(edit, "WorldError");
    std::shared_ptr<LocalRun> run = value_or_raise(simulation.run().edited(change), "WorldError");
    std::vector<long> now;
    for (const RobotId id : change.now) now.push_back(id.valid() ? static_cast<long>(id.value) : -1);
    simulation.retire();
    return {std::make_shared<Simulation>(change.model, std::move(run)), change.model, std::move(now)};
}

/// The same, and what is found about the start of the robots that came.
using Spawned =
    std::tuple<std::shared_ptr<Simulation>, std::shared_ptr<const Model>, std::vector<Diagnostic>>;

Spawned spawn(Simulation& simulation, const std::shared_ptr<const Model>& addition,
              const std::vector<std::string>& names, const std::vector<std::array<double, 7>>& poses,
              bool on_ground) {
    std::vector<CopyPlace> places;
    for (std::size_t i = 0; i < names.size(); ++i) places.push_back({names[i], pose_at(poses[i].data())});
    const std::vector<RobotState>& states = simulation.run().states();  // no other thread uses it
    const ModelEdit edit = value_or_raise(with_models(*simulation.model(), *addition, places,
                                                      on_ground ? Standing::kOnGround : Standing::kAsPlaced),
                                          "WorldError");
    Diagnostics found = edit.found;
    report_overlaps(*edit.model, carry_over(edit, states), states.size(), found);
    Edited gone_on = edited(simulation, edit);
    return {std::get<0>(gone_on), std::get<1>(gone_on), found.items()};
}

Edited remove(Simulation& simulation, const std::vector<std::string>& names) {
    simulation.run();
    return edited(simulation, without_robots(*simulation.model(), names));
}

}  // namespace

void bind_simulation(nb::module_& module) {
    nb::class_<Simulation>(module, "Simulation")
        .def(
            "__init__",
            [](Simulation* self, std::shared_ptr<const Model> model, unsigned threads, std::uint64_t seed) {
                std::shared_ptr<LocalRun> run =
                    value_or_raise(LocalRun::create(model, {.threads = threads, .seed = seed}), "WorldError");
                new (self) Simulation(std::move(model), std::move(run));
            },
            nb::arg("model"), nb::arg("threads"), nb::arg("seed"))
        .def("step", &step_simulation, nb::arg("ticks"))
        .def_prop_ro("tick", [](Simulation& s) { return s.run().tick(); })
        .def_prop_ro("time", [](Simulation& s) { return s.run().time_s(); })
        .def_prop_ro("seed", [](Simulation& s) { return s.run().seed(); })
        .def_prop_ro("threads", [](Simulation& s) { return s.run().threads(); })
        .def_prop_ro("hash", &hash_of)
        .def("contacts", &contacts)
        .def("save",
             [](Simulation& s) {
                 return Saved{s.model(), s.run().save()};
             })
        .def(
            "restore",
            [](Simulation& s, const Saved& saved) {
                if (const Result<> restored = s.run().restore(saved.save); !restored)
                    raise("SaveError", restored.error());
                s.refresh();
            },
            nb::arg("save"))
        .def(
            "reset",
            [](Simulation& s, std::optional<std::uint64_t> seed) { s.run().reset(seed), s.refresh(); },
            nb::arg("seed").none())
        .def(
            "show_in",
            [](Simulation& s, std::shared_ptr<LocalView> view, const LooksOf& looks) {
                s.show_in(std::move(view), looks.worlds);
            },
            nb::arg("view").none(), nb::arg("looks"))
        .def(
            "see",
            [](Simulation& s, LooksOf& looks, unsigned threads) {
                s.access().set_visuals(looks.seen(), threads);
            },
            nb::arg("looks"), nb::arg("threads"))
        .def("turn_view", &Simulation::turn_view)
        .def("retire", &Simulation::retire)
        .def("spawn", &spawn, nb::arg("addition"), nb::arg("names"), nb::arg("poses"), nb::arg("on_ground"))
        .def("remove", &remove, nb::arg("names"))
        .def(
            "attach",
            [](Simulation& s, std::uint32_t robot, std::uint32_t link, std::uint32_t other,
               std::uint32_t other_link, double reach, double max_force, double max_torque) {
                order(s, robot, attach_of(link, other, other_link, reach, max_force, max_torque));
            },
            nb::arg("robot"), nb::arg("link"), nb::arg("other"), nb::arg("other_link"), nb::arg("reach"),
            nb::arg("max_force"), nb::arg("max_torque"))
        .def(
            "detach",
            [](Simulation& s, std::uint32_t robot, std::uint32_t other) {
                order(s, robot, Detach{RobotId(other)});
            },
            nb::arg("robot"), nb::arg("other"));
}

}  // namespace roboss_python
