// The Model of a world that a test makes as text.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "sdf/load_world.h"

namespace roboss::test {

/// Compiles the text of a world; each finding, also a warning, fails the test. Null: it does not compile.
inline std::shared_ptr<const Model> compiled_text(const std::string& text, const std::string& name) {
    Diagnostics diagnostics;
    const auto world = load_world_text(text, name, {}, diagnostics);
    auto model = world ? compile(*world, {}, diagnostics) : nullptr;
    for (const Diagnostic& finding : diagnostics.items()) ADD_FAILURE() << to_text(finding);
    return model;
}

}  // namespace roboss::test
