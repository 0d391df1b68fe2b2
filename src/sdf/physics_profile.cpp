// See physics_profile.h. Solver settings of other engines have no counterpart: they are reported.
#include "sdf/physics_profile.h"

#include <cstring>

#include "sdf/known_children.h"

namespace roboss::sdf_import {
namespace {

constexpr const char* kPhysicsChildren[] = {"max_step_size",   "real_time_factor", "real_time_update_rate",
                                            "max_contacts",    "gravity",          "magnetic_field",
                                            "roboss:accuracy", "roboss:precision", "ode",
                                            "bullet",          "simbody",          "dart"};

std::string names_of(const std::vector<Element>& profiles) {
    std::string all;
    for (const Element& profile : profiles) all += (all.empty() ? "'" : ", '") + profile.name() + "'";
    return all;
}

Element chosen(const std::vector<Element>& profiles, const std::string& wanted, const Element& world,
               const Import& import) {
    if (!wanted.empty()) {
        for (const Element& profile : profiles)
            if (profile.name() == wanted) return profile;
        import.diagnostics().error(
            world.where(), "no-profile", "the world has no physics profile called '" + wanted + "'",
            profiles.empty() ? "It has none: leave out --profile." : "It has: " + names_of(profiles) + ".");
    }
    for (const Element& profile : profiles)
        if (profile.node.attribute("default").as_bool()) return profile;
    return profiles.empty() ? Element{} : profiles.front();
}

void report_engines(const Element& physics, const Import& import) {
    for (const char* engine : {"ode", "bullet", "simbody", "dart"})
        if (const Element block = physics.child(engine))
            import.diagnostics().note(
                block.where(), "engine-settings",
                "<" + std::string(engine) + "> sets up the solver of another engine and has no effect",
                "Write <roboss:accuracy setting=\"fast|standard|high\"/> in <physics> or <world>.");
}

void read_pace(const Element& physics, const Import& import, World& out) {
    const double rate = import.reader.number(physics, "real_time_update_rate", 1.0 / out.dt_s);
    const double factor = import.reader.number(physics, "real_time_factor", rate * out.dt_s);
    out.real_time_factor = factor > 0 ? factor : 0.0;  // 0 and less: as fast as possible
}

}  // namespace

double positive_number(const Element& parent, const char* child, double usual, const Import& import) {
    const double value = import.reader.number(parent, child, usual);
    if (value > 0) return value;
    import.diagnostics().error(
        parent.child(child).where(), "bad-value",
        "<" + std::string(child) + "> is " + std::to_string(value) + "; it must be greater than 0",
        "Write for instance " + std::string(usual < 0.5 ? "0.001." : "1."));
    return usual;
}

AccuracySpec read_accuracy(const Element& element, const Import& import) {
    AccuracySpec spec;
    spec.where = element.where();
    spec.setting = element.node.attribute("setting").value();
    for (const auto node : element.node.children()) {
        if (node.type() != pugi::node_element) continue;
        spec.numbers.push_back({node.name(), import.reader.number(element, node.name(), 0.0)});
    }
    return spec;
}

void read_precision(const Element& parent, const Import& import, World& out) {
    const Element element = parent.child("roboss:precision");
    if (!element) return;
    const std::string text = parent.text("roboss:precision");
    if (text != "float" && text != "double") {
        import.diagnostics().error(element.where(), "bad-value",
                                   "<roboss:precision> is '" + text + "'; it must be float or double",
                                   "Write float, double, or leave it out.");
        return;
    }
    out.precision = text == "float" ? Precision::kFloat : Precision::kDouble;
}

void read_physics(const Element& world, const std::string& wanted, Import& import, World& out) {
    std::vector<Element> profiles;
    for (const auto node : world.node.children("physics")) profiles.push_back({world.source, node});
    if (const Element physics = chosen(profiles, wanted, world, import)) {
        out.profile = physics.name();
        if (profiles.size() > 1 && wanted.empty())
            import.diagnostics().note(
                physics.where(), "physics-profile",
                "of the physics profiles " + names_of(profiles) + " '" + out.profile + "' is used",
                "Choose with --profile.");
        out.dt_s = positive_number(physics, "max_step_size", 0.001, import);
        read_pace(physics, import, out);
        // Gravity and magnetic field stood in <physics> up to SDFormat 1.5.
        out.gravity = import.reader.vector(physics, "gravity", out.gravity);
        out.magnetic_field_T = import.reader.vector(physics, "magnetic_field", out.magnetic_field_T);
        import.max_contacts = import.reader.integer(physics, "max_contacts", -1);
        for (const auto node : physics.node.children("roboss:accuracy"))
            out.accuracy.push_back(read_accuracy({world.source, node}, import));
        read_precision(physics, import, out);
        report_engines(physics, import);
    }
    for (const Element& profile : profiles)
        report_unknown_children(profile, kPhysicsChildren, import.diagnostics());
    out.gravity = import.reader.vector(world, "gravity", out.gravity);
    import.dt_s = out.dt_s;
}

}  // namespace roboss::sdf_import
