// For tests of layers that load worlds: a world, with what was found.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "core/diagnostics.h"
#include "world/world.h"

namespace roboss::world_test {

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

}  // namespace roboss::world_test
