// For the tests of this layer: files given as text.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mjcf/load_mjcf.h"
#include "world/test_loaded.h"

namespace roboss::mjcf_test {

using Loaded = world_test::Loaded;

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
