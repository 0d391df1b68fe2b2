// Planar scissors: parallelograms one upon the other, on hinges.
#pragma once

#include <string>

#include <support/mechanisms.h>

namespace roboss::test {

/// Each loop implies three of its rows.
inline ModelSpec scissors(std::size_t bays, bool free_base) {
    constexpr double kSide = 0.2;
    ModelSpec m;
    m.name = m.canonical_link = "base";
    m.links = {link("base", 2, box_inertia(2, {0.6, 0.3, 0.1}))};
    const auto hinge = [&](const std::string& parent, const std::string& child, const Vec3& at) {
        m.joints.push_back(
            joint(JointSpecKind::kRevolute, parent + "_" + child, parent, child, {at, {}}, {0, 1, 0}));
    };
    if (!free_base) m.joints.push_back(joint(JointSpecKind::kFixed, "stand", "world", "base", {}));
    std::string below = "base";
    for (std::size_t i = 0; i < bays; ++i) {
        const std::string n = std::to_string(i);
        const double lean = i % 2 == 0 ? 0.08 : -0.05;
        const Vec3 foot{i % 2 == 0 ? 0.0 : 0.08, 0, kSide * static_cast<double>(i)};
        const Vec3 far = foot + Vec3{0.4, 0, 0}, up{lean, 0, kSide};
        m.links.push_back(rod_between("left" + n, foot, foot + up));
        m.links.push_back(rod_between("right" + n, far, far + up));
        m.links.push_back(rod_between("top" + n, foot + up, far + up));
        hinge(below, "left" + n, foot), hinge(below, "right" + n, far);
        hinge("left" + n, "top" + n, foot + up), hinge("right" + n, "top" + n, far + up);
        below = "top" + n;
    }
    return m;
}

}  // namespace roboss::test
