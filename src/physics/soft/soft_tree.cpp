// See soft_tree.h.
#include "physics/soft/soft_tree.h"

#include <algorithm>
#include <cmath>

#include "physics/dynamics/tree_factor.h"

namespace roboss::soft {
namespace {

/// The path to a body: none to a fixed base.
std::span<const int> dofs_to(const RobotType& type, int body) {
    if (body < 0) return {};
    const Body& info = type.bodies[static_cast<std::size_t>(body)];
    if (info.v_index + info.nv == 0) return {};
    const auto last = static_cast<std::size_t>(info.v_index + info.nv - 1);
    return {type.paths.path(last), type.paths.length(last)};
}

}  // namespace

bool may_be_tree(const RobotType& type) {
    if (type.dofs.empty() || type.has_equalities() || !type.drags.empty() || type.feels_flow) return false;
    const auto nv = static_cast<std::size_t>(type.nv);
    if (nv > kMostDofs) return false;
    std::size_t longest = 0;
    for (std::size_t i = 0; i < nv; ++i) longest = std::max(longest, type.paths.length(i));
    return longest + (type.self_collide ? longest : 0) + 6 <= kMostColumns;
}

bool factor_tree(RobotWork& robot, std::span<double> root) {
    const DofPaths& paths = robot.type->paths;
    tree_factor(paths, robot.mass_matrix.data());
    for (std::size_t i = 0; i < root.size(); ++i) {
        const double inverse = robot.mass_matrix[paths.diagonal(i)];
        if (!(inverse > 0) || !std::isfinite(inverse)) return false;
        root[i] = std::sqrt(inverse);
    }
    return true;
}

TreePath path_to(const RobotType& type, int body, int other) {
    const std::span<const int> first = dofs_to(type, body), second = dofs_to(type, other);
    TreePath path;
    int* end = std::set_union(first.begin(), first.end(), second.begin(), second.end(), path.dofs);
    path.count = static_cast<int>(end - path.dofs);
    path.within = static_cast<int>(std::lower_bound(path.dofs, end, 6) - path.dofs);
    return path;
}

namespace {

/// A push as a wrench about the robot's origin.
struct Wrench {
    Vec3 moment, force;

    Wrench(const RobotWork& robot, const Push& push, double sign)
        : moment(push.turns ? push.direction * sign
                            : cross(push.point - robot.origin, push.direction * sign)),
          force(push.turns ? Vec3{} : push.direction * sign) {}
    double along(const Spatial& axis) const { return dot(axis.angular, moment) + dot(axis.linear, force); }
};

TreeRow empty_row(const TreePath& path) {
    TreeRow row;
    std::fill_n(row.x, 6 + path.further(), 0.0);
    return row;
}

}  // namespace

/// The path of each entry is what precedes it.
TreeRow row_of(const Tree& tree, const TreePath& path, const Push& push, double sign) {
    const RobotWork& robot = *tree.robot;
    const DofPaths& paths = robot.type->paths;
    const Wrench wrench(robot, push, sign);
    double J[kMostColumns];
    int k = 0;
    if (robot.type->free_base) {
        for (std::size_t i = 0; i < 3; ++i) J[i] = wrench.moment[i], J[3 + i] = wrench.force[i];
        k = 6;
    }
    for (; k < path.count; ++k) J[k] = wrench.along(robot.axes[static_cast<std::size_t>(path.dofs[k])]);
    TreeRow row = empty_row(path);
    for (k = path.count; k-- > 0;) {
        const auto i = static_cast<std::size_t>(path.dofs[k]);
        const double* l = tree.M + paths.row(i);
        const double x = J[k];
        for (int m = 0; m < k; ++m) J[m] -= l[m] * x;
        row.x[path.column(k)] = x * tree.root[i];
    }
    return row;
}

TreeRow row_between(const Tree& tree, const TreePath& path, int body, const Push& push, int other,
                    const Push& back) {
    const RobotWork& robot = *tree.robot;
    const DofPaths& paths = robot.type->paths;
    double J[kMostDofs];  // by degree of freedom
    for (int k = 0; k < path.count; ++k) J[path.dofs[k]] = 0;
    const auto add = [&](int to, const Wrench& wrench) {
        for (const int d : dofs_to(*robot.type, to))
            J[d] += robot.type->free_base && d < 6 ? (d < 3 ? wrench.moment[static_cast<std::size_t>(d)]
                                                            : wrench.force[static_cast<std::size_t>(d - 3)])
                                                   : wrench.along(robot.axes[static_cast<std::size_t>(d)]);
    };
    add(body, Wrench(robot, push, 1)), add(other, Wrench(robot, back, -1));
    TreeRow row = empty_row(path);
    for (int k = path.count; k-- > 0;) {
        const auto i = static_cast<std::size_t>(path.dofs[k]);
        const double* l = tree.M + paths.row(i);
        const int* above = paths.path(i);
        const double x = J[i];
        for (std::size_t m = 0; m + 1 < paths.length(i); ++m) J[above[m]] -= l[m] * x;
        row.x[path.column(k)] = x * tree.root[i];
    }
    return row;
}

void whiten_velocity(const Tree& tree, std::span<const double> v, double* y) {
    const DofPaths& paths = tree.robot->type->paths;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const double* l = tree.M + paths.row(i);
        const int* above = paths.path(i);
        double sum = v[i];
        for (std::size_t m = 0; m + 1 < paths.length(i); ++m)
            sum += l[m] * v[static_cast<std::size_t>(above[m])];
        y[i] = sum / tree.root[i];
    }
}

void whiten_impulse(const Tree& tree, std::span<const double> impulse, double* y) {
    const DofPaths& paths = tree.robot->type->paths;
    std::copy(impulse.begin(), impulse.end(), y);
    for (std::size_t i = impulse.size(); i-- > 0;) {
        const double* l = tree.M + paths.row(i);
        const int* above = paths.path(i);
        const double x = y[i];
        for (std::size_t m = 0; m + 1 < paths.length(i); ++m) y[above[m]] -= l[m] * x;
        y[i] = x * tree.root[i];
    }
}

void add_impulse(const Tree& tree, const double* y, std::span<double> impulse) {
    const DofPaths& paths = tree.robot->type->paths;
    for (std::size_t i = 0; i < impulse.size(); ++i) {
        const double* l = tree.M + paths.row(i);
        const int* above = paths.path(i);
        const double x = y[i] / tree.root[i];
        impulse[i] += x;
        for (std::size_t m = 0; m + 1 < paths.length(i); ++m)
            impulse[static_cast<std::size_t>(above[m])] += l[m] * x;
    }
}

void put_velocity(const Tree& tree, const double* y, double factor, std::span<double> v) {
    const DofPaths& paths = tree.robot->type->paths;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const double* l = tree.M + paths.row(i);
        const int* above = paths.path(i);
        double sum = y[i] * tree.root[i] * factor;
        for (std::size_t m = 0; m + 1 < paths.length(i); ++m)
            sum -= l[m] * v[static_cast<std::size_t>(above[m])];
        v[i] = sum;
    }
}

}  // namespace roboss::soft
