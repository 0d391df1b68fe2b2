// Runs on a cluster: joining, stepping, requests to the run.
#include "roboss/remote/remote_run.h"

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "roboss/client/control_text.h"
#include "roboss/gateway/run_json.h"
#include "simulation.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

/// A RemoteRun, and how Robots and Sensors see it.
struct Remote {
    std::shared_ptr<RemoteRun> run;
    std::shared_ptr<Simulation> simulation;

    /// Raises after leave().
    RemoteRun& there() const {
        if (!run) raise("StateError", {"the connection is closed", "connect again", "closed"});
        (void)simulation->access();  // not in use by another thread
        return *run;
    }
};

/// To be called without the GIL: false after Ctrl-C.
bool go_on() {
    const nb::gil_scoped_acquire acquire;
    return PyErr_CheckSignals() == 0;
}

[[noreturn]] void raise_remote(const Error& error) {
    if (error.code == "interrupted") throw nb::python_error();
    const bool is_argument = error.code == "bad-ticks";
    raise(is_argument                     ? "ArgumentError"
          : error.code == "changed-world" ? "StateError"
                                          : "ClusterError",
          error);
}

Remote connect(const RemoteOptions& options) {
    Result<std::unique_ptr<RemoteRun>> made = [&] {
        const nb::gil_scoped_release release;
        return RemoteRun::connect(options, &go_on);
    }();
    if (!made) raise_remote(made.error());
    std::shared_ptr<RemoteRun> run = std::move(made).value();
    return {run, std::make_shared<Simulation>(run->shared_model(), run)};
}

void step(const Remote& remote, Tick ticks) {
    RemoteRun& run = remote.there();
    const Result<> stepped = without_gil({remote.simulation}, [&] { return run.step(ticks, &go_on); });
    if (!stepped) raise_remote(stepped.error());
}

/// What the run answers to the words of `roboss control`.
std::string control(const Remote& remote, const std::vector<std::string>& words) {
    RemoteRun& run = remote.there();
    const ControlAction action = value_or_raise(parse_control(words), "ArgumentError");
    const Result<ControlOutcome> outcome =
        without_gil({remote.simulation}, [&] { return run.control(action, &go_on); });
    if (!outcome) raise_remote(outcome.error());
    if (const auto* refused = std::get_if<ControlRefused>(&outcome.value()))
        raise("ClusterError", refused->error());
    if (const auto* status = std::get_if<RunStatus>(&outcome.value())) return status_json(*status);
    if (const auto* done = std::get_if<ControlDone>(&outcome.value())) return done->text;
    raise("ArgumentError", {"this request has no answer in words", "use `roboss control`", "no-text"});
}

/// Nothing happens while another thread is inside.
void advance(const Remote& remote) {
    if (remote.run && !remote.simulation->busy()) remote.run->advance();
}

void leave(Remote& remote) {
    RemoteRun& run = remote.there();
    without_gil({remote.simulation}, [&] { run.leave(); });
    remote.simulation->retire();
    remote.run.reset();
}

}  // namespace

void bind_remote(nb::module_& module) {
    nb::class_<Remote>(module, "Remote")
        .def("step", &step, nb::arg("ticks"))
        .def("control", &control, nb::arg("words"))
        .def("advance", &advance)
        .def("leave", &leave)
        .def("take_refusals", [](Remote& r) { return r.there().take_refusals(); })
        .def_prop_ro("simulation", [](const Remote& r) { return r.simulation; })
        .def_prop_ro("model", [](const Remote& r) { return r.there().shared_model(); })
        .def_prop_ro("tick", [](const Remote& r) { return r.there().tick(); })
        .def_prop_ro("time", [](const Remote& r) { return r.there().time_s(); })
        .def_prop_ro("seed", [](const Remote& r) { return r.there().seed(); })
        .def_prop_ro("period", [](const Remote& r) { return r.there().period(); });
    module.def(
        "connect",
        [](std::string simulation, std::string name, Tick period, Tick latency, double patience,
           std::string interface, std::uint32_t domain, std::vector<std::string> peers,
           std::string discovery_server) {
            RemoteOptions options;
            options.network.simulation = std::move(simulation);
            options.network.interface = std::move(interface);
            options.network.domain = domain;
            options.network.multicast = peers.empty();
            options.network.peers = std::move(peers);
            options.network.discovery_server = std::move(discovery_server);
            options.name = std::move(name);
            options.period = period;
            options.latency = latency;
            options.patience_s = patience;
            return connect(options);
        },
        nb::arg("simulation"), nb::arg("name"), nb::arg("period"), nb::arg("latency"), nb::arg("patience"),
        nb::arg("interface"), nb::arg("domain"), nb::arg("peers"), nb::arg("discovery_server"));
}

}  // namespace roboss_python
