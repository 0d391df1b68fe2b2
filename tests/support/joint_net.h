// A square net of plates with a ball joint between neighbours, hanging on two corners.
#pragma once

#include <string>

#include <support/bodies.h>

namespace roboss::test {

inline constexpr double kNetSpacing = 0.1;     // m
inline constexpr double kNetPlateMass = 0.05;  // kg

/// `side` plates in a row and in a column, in a bowl of this depth over half the length; 0: flat. Joints come
/// in the order that makes the tree a comb: the last of a loop is the one that closes it.
inline ModelSpec joint_net(std::size_t side, double bowl) {
    const Vec3 size{0.08, 0.08, 0.02};
    const auto name_of = [](std::size_t row, std::size_t column) {
        return "plate_" + std::to_string(row) + "_" + std::to_string(column);
    };
    const auto place_of = [&](std::size_t row, std::size_t column) {
        const double length = kNetSpacing * static_cast<double>(side - 1);
        const double x = kNetSpacing * static_cast<double>(column),
                     y = kNetSpacing * static_cast<double>(row);
        const auto rise = [&](double d) { return bowl * d * (d - length) / length; };
        return Vec3{x, y, rise(x) + rise(y)};
    };
    ModelSpec model;
    model.name = "net";
    model.canonical_link = name_of(0, 0);
    for (std::size_t r = 0; r < side; ++r)
        for (std::size_t c = 0; c < side; ++c)
            model.links.push_back(
                link(name_of(r, c), kNetPlateMass, box_inertia(kNetPlateMass, size), {place_of(r, c), {}}));
    const auto join = [&](const std::string& parent, const std::string& child, const Vec3& p) {
        model.joints.push_back(joint(JointSpecKind::kBall, parent + "_" + child, parent, child, {p, {}}));
    };
    const auto join_to = [&](std::size_t r, std::size_t c, std::size_t row, std::size_t column) {
        join(name_of(r, c), name_of(row, column), (place_of(r, c) + place_of(row, column)) * 0.5);
    };
    join("world", name_of(0, 0), place_of(0, 0));
    for (std::size_t r = 1; r < side; ++r) join_to(r - 1, 0, r, 0);
    for (std::size_t r = 0; r < side; ++r)
        for (std::size_t c = 1; c < side; ++c) join_to(r, c - 1, r, c);
    for (std::size_t r = 1; r < side; ++r)
        for (std::size_t c = 1; c < side; ++c) join_to(r - 1, c, r, c);
    join("world", name_of(0, side - 1), place_of(0, side - 1));
    return model;
}

}  // namespace roboss::test
