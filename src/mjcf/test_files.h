// For the tests of this layer: files given as text.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "mjcf/load_mjcf.h"

namespace roboss::mjcf_test {

struct Loaded {
    std::optional<World> world;
    Diagnostics diagnostics;

    /// The first finding with this code; nullptr: none.
    const Diagnostic* find(const std::string& code) const {
        const auto at = std::ranges::find(diagnostics.items(), code, &Diagnostic::code);
        return at == diagnostics.items().end() ? nullptr : &*at;
    }
    std::string text() const {
        std::string all;
        for (const Diagnostic& d : diagnostics.items()) all += to_text(d) + "\n";
        return all;
    }
    /// nullptr: no such model.
    const ModelSpec* model(const std::string& name) const {
        if (!world) return nullptr;
        const auto at = std::ranges::find(world->prototypes, name, &ModelSpec::name);
        return at == world->prototypes.end() ? nullptr : &*at;
    }
};

/// Loads a whole file given as text, as `name`.
inline Loaded load_text(const std::string& text, const std::string& name = "robot.xml") {
    Loaded loaded;
    auto file = xml::SourceFile::from_text(name, text, {}, loaded.diagnostics);
    if (file) loaded.world = load_mjcf(std::move(file), {}, loaded.diagnostics);
    return loaded;
}

/// The same of what stands in <worldbody>, and of further sections.
inline Loaded load_bodies(const std::string& bodies, const std::string& sections = "") {
    return load_text("<mujoco model='m'>" + sections + "<worldbody>" + bodies + "</worldbody></mujoco>");
}

}  // namespace roboss::mjcf_test
