// One model compiled by itself with what was found on the way, for tests of compile().
#pragma once

#include <memory>
#include <string>
#include <utility>

#include <support/bodies.h>

#include "model/model.h"

namespace roboss::test {

struct Compiled {
    std::shared_ptr<const Model> model;
    Diagnostics diagnostics;
    const RobotType& type() const { return model->types.front(); }
};

inline Compiled compile_one(ModelSpec spec, const Pose& X_WM = {}) {
    World world = empty_world(1e-3);
    const std::string name = spec.name;
    place(world, std::move(spec), name, X_WM);
    Compiled c;
    c.model = compile(world, {}, c.diagnostics);
    return c;
}

inline bool has(const Diagnostics& diagnostics, const std::string& code) {
    for (const Diagnostic& d : diagnostics.items())
        if (d.code == code) return true;
    return false;
}

/// Three boxes in a row along x, a meter apart.
inline ModelSpec row_of_three() {
    ModelSpec m;
    m.name = "row";
    m.canonical_link = "a";
    const char* names[] = {"a", "b", "c"};
    for (int i = 0; i < 3; ++i) {
        LinkSpec l = link(names[i], 1.0 + i, box_inertia(1.0 + i, {0.2, 0.2, 0.2}), {{1.0 * i, 0, 0}, {}});
        l.collisions.push_back(box_shape({0.2, 0.2, 0.2}, surface(0.5)));
        m.links.push_back(l);
    }
    return m;
}

inline Pose at_x(double x) {
    return {{x, 0, 0}, {}};
}

}  // namespace roboss::test
