// Worlds: loading and compiling, findings about the file, and what robots consist of.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cinttypes>
#include <cstdio>
#include <map>

#include "bindings.h"
#include "errors.h"
#include "looks.h"
#include "roboss/local/robot_set.h"
#include "roboss/math/array_rows.h"
#include "roboss/model/on_ground.h"
#include "roboss/physics/start_overlaps.h"
#include "roboss/sdf/load_world.h"
#include "roboss/world/bare_model.h"
#include "roboss/world/joint_type.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

/// What load() takes.
struct Wanted {
    std::string source;
    bool is_text = false;
    LoadOptions load;
    BareModelOptions bare;
    CompileOptions compile;
    bool on_ground = false;
};

/// (name, place of its link, pose x y z, quaternion x y z w in the link's frame) of each frame, by robot.
using Frames = std::vector<std::vector<std::tuple<std::string, std::size_t, std::array<double, 7>>>>;

/// A compiled world, all findings, and what no Model has: its frames and its looks; no model: it is refused.
using Loaded = std::tuple<std::shared_ptr<const Model>, std::vector<Diagnostic>, Frames, LooksOf>;

Frames frames_of(const World& world, const Model& model) {
    Frames frames;
    for (const Robot& robot : model.robots) {
        const RobotType& type = model.types[robot.type.index()];
        frames.emplace_back();
        for (const FrameSpec& frame : world.prototypes[world.instances[robot.family].prototype].frames) {
            const auto link = type.find_link(frame.link);
            if (!link) continue;
            std::array<double, 7> pose{};
            put_row(frame.X_LF, pose.data());
            frames.back().push_back({frame.name, link->index(), pose});
        }
    }
    return frames;
}

Loaded load(const Wanted& wanted) {
    Diagnostics diagnostics;
    std::optional<World> world = wanted.is_text
                                     ? load_world_text(wanted.source, "<text>", wanted.load, diagnostics)
                                     : load_world(wanted.source, wanted.load, diagnostics);
    std::shared_ptr<const Model> model;
    if (world && !diagnostics.refuses()) {
        if (const Result<> completed = complete(*world, wanted.bare); !completed)
            diagnostics.error({world->file, 0}, completed.error().code, completed.error().message,
                              completed.error().remedy);
        else
            model = compile(*world, wanted.compile, diagnostics);
    }
    if (model && wanted.on_ground) model = stood_on_ground(*model, {world->file, 0}, diagnostics);
    if (model) report_overlaps(*model, &*world, diagnostics);
    if (diagnostics.refuses()) model = nullptr;
    if (!model) return {nullptr, diagnostics.items(), Frames{}, LooksOf{}};
    Frames frames = frames_of(*world, *model);
    return {model, diagnostics.items(), std::move(frames),
            LooksOf{{std::make_shared<const World>(*std::move(world))}, {}}};
}

std::string hex(std::uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, hash);
    return text;
}

/// One (lower, upper, maximum effort, maximum velocity) for each column of the arrays of joints.
std::vector<std::vector<double>> limits_of(const RobotType& type, const std::vector<JointAxis>& axes) {
    std::vector<std::vector<double>> limits;
    for (const JointAxis& axis : axes) {
        const Dof& dof = type.dof(type.joints[axis.joint.index()], axis.axis);
        limits.push_back({dof.lower, dof.upper, dof.max_effort, dof.max_velocity});
    }
    return limits;
}

/// What each column of the arrays of joints is: "axis", "ball" (a component of a rotation vector), or "loop"
/// (of a joint that closes a loop).
std::vector<std::string> coordinates_of(const RobotType& type, const std::vector<JointAxis>& axes) {
    std::vector<std::string> coordinates;
    for (const JointAxis& axis : axes) {
        const Joint& joint = type.joints[axis.joint.index()];
        coordinates.push_back(joint.loop >= 0                         ? "loop"
                              : joint_type(joint.kind).is_isotropic() ? "ball"
                                                                      : "axis");
    }
    return coordinates;
}

/// "rad" or "m", of the position of each column of the arrays of joints.
std::vector<std::string> units_of(const RobotType& type, const std::vector<JointAxis>& axes) {
    std::vector<std::string> units;
    for (const JointAxis& axis : axes) {
        const std::span<const JointKind> motions = joint_type(type.joints[axis.joint.index()].kind).motions;
        const std::size_t motion = std::min(static_cast<std::size_t>(axis.axis), motions.size() - 1);
        units.push_back(motions[motion] == JointKind::kPrismatic ? "m" : "rad");
    }
    return units;
}

/// (name, kind, rate, its number on the robot of each row) of each sensor.
nb::list sensors_of(const RobotSet& set) {
    nb::list sensors;
    const SharedParts& shared = set.shared();
    for (const SharedPart& part : shared.sensors) {
        const SensorSpec& spec = shared.types[0]->sensors[part.of[0]].spec;
        std::vector<std::size_t> numbers;
        for (const std::uint32_t type : shared.type_of_row) numbers.push_back(part.of[type]);
        sensors.append(nb::make_tuple(part.name, spec.kind().name, spec.update_rate_hz, numbers));
    }
    return sensors;
}

/// (name, its values, whether it is a list, the first robot's own name for it) of each command.
nb::list commands_of(const RobotSet& set) {
    nb::list commands;
    for (const SharedPart& part : set.shared().commands) {
        const Channel& channel = set.shared().types[0]->channels[part.of[0]].channel;
        nb::list values;
        for (const ChannelValue& value : channel.values)
            values.append(nb::make_tuple(value.name, value.unit));
        commands.append(nb::make_tuple(part.name, nb::tuple(values), channel.is_list, channel.name));
    }
    return commands;
}

/// The value that all RobotTypes of the set share; None: they differ.
template <class Of>
nb::object same_of(const RobotSet& set, const Of& of) {
    const auto first = of(0);
    for (std::size_t t = 1; t < set.shared().types.size(); ++t)
        if (of(t) != first) return nb::none();
    return nb::cast(first);
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
    std::vector<std::string> names;
    for (const Named& one : all) names.push_back(one.name);
    return names;
}

/// The facts that the robots, at least one, have in common.
nb::dict facts_of(const std::shared_ptr<const Model>& model, const std::vector<std::uint32_t>& robots) {
    std::vector<RobotId> ids;
    for (const std::uint32_t robot : robots) ids.emplace_back(robot);
    const RobotSet set(model, std::move(ids));
    const SharedParts& shared = set.shared();
    const auto of_axes = [&](const auto& of) {
        return [&](std::size_t t) { return of(*shared.types[t], shared.axes_of_types[t]); };
    };
    std::map<TypeId, std::string> types;
    for (const RobotType* type : shared.types) types.try_emplace(type->like, type->name);
    std::vector<std::string> names;
    for (const auto& [type, name] : types) names.push_back(name);
    nb::dict facts;
    facts["types"] = names;
    facts["free_base"] = same_of(set, [&](std::size_t t) { return shared.types[t]->free_base; });
    facts["links"] = names_of(shared.links);
    facts["axes"] = names_of(shared.axes);
    facts["limits"] = same_of(set, of_axes(limits_of));
    facts["units"] = units_of(*shared.types[0], shared.axes_of_types[0]);
    facts["coordinates"] = coordinates_of(*shared.types[0], shared.axes_of_types[0]);
    facts["sensors"] = sensors_of(set);
    facts["commands"] = commands_of(set);
    return facts;
}

std::vector<std::uint32_t> families_of(const Model& model) {
    std::vector<std::uint32_t> families;
    for (const Robot& robot : model.robots) families.push_back(robot.family);
    return families;
}

std::vector<std::size_t> types_of(const Model& model) {
    std::vector<std::size_t> types;
    for (const Robot& robot : model.robots) types.push_back(robot.type.index());
    return types;
}

}  // namespace

void bind_world(nb::module_& module) {
    nb::class_<Diagnostic>(module, "Diagnostic")
        .def(
            "__init__",
            [](Diagnostic* self, const std::string& severity, std::string file, int line, std::string code,
               std::string message, std::string remedy) {
                const Severity how = severity == "error"     ? Severity::kError
                                     : severity == "warning" ? Severity::kWarning
                                                             : Severity::kNote;
                new (self) Diagnostic{
                    how, {std::move(file), line}, std::move(code), std::move(message), std::move(remedy)};
            },
            nb::arg("severity"), nb::arg("file"), nb::arg("line"), nb::arg("code"), nb::arg("message"),
            nb::arg("remedy"))
        .def_prop_ro("severity", [](const Diagnostic& d) { return std::string(to_text(d.severity)); })
        .def_prop_ro("file", [](const Diagnostic& d) { return d.where.file; })
        .def_prop_ro("line", [](const Diagnostic& d) { return d.where.line; })
        .def_ro("code", &Diagnostic::code)
        .def_ro("message", &Diagnostic::message)
        .def_ro("remedy", &Diagnostic::remedy)
        .def("__str__", [](const Diagnostic& d) { return to_text(d); });

    nb::class_<Model>(module, "Model")
        .def_ro("name", &Model::name)
        .def_ro("dt", &Model::dt_s)
        .def_prop_ro("hash", [](const Model& m) { return hex(m.hash); })
        .def_prop_ro("gravity",
                     [](const Model& m) { return nb::make_tuple(m.gravity.x, m.gravity.y, m.gravity.z); })
        .def_prop_ro("robots", [](const Model& m) { return names_of(m.robots); })
        .def_prop_ro("types", &types_of)
        .def_prop_ro("families", &families_of)
        .def_prop_ro("scenery", [](const Model& m) { return names_of(m.statics); })
        .def("__deepcopy__", [](const std::shared_ptr<const Model>& m, const nb::dict&) { return m; });
    module.def("facts_of", &facts_of, nb::arg("model"), nb::arg("robots"));

    module.def(
        "load",
        [](std::string source, bool is_text, std::vector<std::string> search_paths, std::string profile,
           bool ground, std::vector<std::string> fixed_base, std::optional<double> dt,
           std::optional<bool> sleep, std::string accuracy, std::optional<bool> floats, bool on_ground,
           std::string keyframe) {
            Wanted wanted{std::move(source),
                          is_text,
                          {std::move(search_paths), std::move(profile), false, std::move(keyframe)},
                          {ground, std::move(fixed_base)},
                          {.dt_s = dt, .sleep = sleep}};
            wanted.compile.accuracy.setting = std::move(accuracy);
            wanted.on_ground = on_ground;
            if (floats) wanted.compile.precision = *floats ? Precision::kFloat : Precision::kDouble;
            const nb::gil_scoped_release release;
            return load(wanted);
        },
        nb::arg("source"), nb::arg("is_text"), nb::arg("search_paths"), nb::arg("profile"), nb::arg("ground"),
        nb::arg("fixed_base"), nb::arg("dt").none(), nb::arg("sleep").none(), nb::arg("accuracy"),
        nb::arg("floats").none(), nb::arg("on_ground"), nb::arg("keyframe"));
}

}  // namespace roboss_python
