// Runs on a cluster: joining, stepping, requests to the run.
#include "roboss/remote/remote_run.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <thread>

#include "bindings.h"
#include "roboss/client/control_text.h"
#include "roboss/gateway/run_json.h"
#include "roboss/math/array_rows.h"
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

Remote as_seen(std::shared_ptr<RemoteRun> run) {
    return {run, std::make_shared<Simulation>(run->shared_model(), run)};
}

Remote connect(const RemoteOptions& options) {
    Result<std::unique_ptr<RemoteRun>> made = [&] {
        const nb::gil_scoped_release release;
        return RemoteRun::connect(options, &go_on);
    }();
    if (!made) raise_remote(made.error());
    return as_seen(std::move(made).value());
}

/// Sends a request that changes the world; returns its answer. If robots came or went, the run is another
/// one.
std::string change(Remote& remote, const ControlAction& action) {
    RemoteRun& run = remote.there();
    const Result<std::string> done =
        without_gil({remote.simulation}, [&] { return run.change_run(action, &go_on); });
    if (!done) raise_remote(done.error());
    if (!run.outdated()) return done.value();
    Result<std::unique_ptr<RemoteRun>> renewed =
        without_gil({remote.simulation}, [&] { return run.renewed(&go_on); });
    remote.simulation->retire();
    remote.run.reset();
    if (!renewed) raise_remote(renewed.error());
    remote = as_seen(std::move(renewed).value());
    return done.value();
}

std::string add_models(Remote& remote, const std::string& file, const std::string& content,
                       const std::vector<std::string>& names, const std::vector<std::array<double, 7>>& poses,
                       bool on_ground) {
    AddModels request{file, content, pose_at(poses.front().data()), names.front()};
    for (std::size_t i = 0; names.size() > 1 && i < names.size(); ++i)
        request.copies.push_back({names[i], pose_at(poses[i].data())});
    request.on_ground = on_ground;
    return change(remote, request);
}

void step_remote(const Remote& remote, Tick ticks) {
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
    if (!remote.run || remote.simulation->busy()) return;
    remote.run->advance();
    remote.simulation->refresh();
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
        .def("step", &step_remote, nb::arg("ticks"))
        .def("control", &control, nb::arg("words"))
        .def("add", &add_models, nb::arg("file"), nb::arg("content"), nb::arg("names"), nb::arg("poses"),
             nb::arg("on_ground"))
        .def(
            "remove",
            [](Remote& r, const std::vector<std::string>& names) { return change(r, RemoveRobots{names}); },
            nb::arg("names"))
        .def("reset", [](Remote& r) { return change(r, ResetRun{}); })
        .def("restore", [](Remote& r) { return change(r, ResetRun{ResetRun::To::kLastSave}); })
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
           std::string controller, std::string keys, bool insecure) {
            RemoteOptions options;
            options.network.simulation = std::move(simulation);
            options.network.controller = std::move(controller);
            options.network.keys = std::move(keys);
            options.network.insecure = insecure;
            options.name = std::move(name);
            options.period = period;
            options.latency = latency;
            options.patience_s = patience;
            options.threads = std::max(1u, std::thread::hardware_concurrency());
            return connect(options);
        },
        nb::arg("simulation"), nb::arg("name"), nb::arg("period"), nb::arg("latency"), nb::arg("patience"),
        nb::arg("controller"), nb::arg("keys"), nb::arg("insecure"));
}

}  // namespace roboss_python
