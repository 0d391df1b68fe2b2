// A robot with joints as the soft solver sees it: in coordinates in which its mass matrix is the identity.
// With M = L^T D L (tree_factor.h) these are y = D^1/2 L v, and an impulse f along a Jacobian row J changes
// them by D^-1/2 L^-T J^T f. That has entries where J has them, along the path from the base to the body that
// is pushed: so a contact costs a free body's six numbers and one for each joint between. M holds damping and
// springs of joints as the exact solver has them, implicit in the tick.
#pragma once

#include <span>
#include <vector>

#include "physics/dynamics/robot_work.h"
#include "physics/soft/soft_rows.h"

namespace roboss::soft {

/// Degrees of freedom of one robot, at most.
inline constexpr std::size_t kMostDofs = 64;

struct Tree {
    RobotWork* robot = nullptr;
    std::size_t slot = 0;          // of Problem::velocity: its first
    const double* M = nullptr;     // factorised
    std::span<const double> root;  // D^-1/2

    std::size_t nv() const { return static_cast<std::size_t>(robot->type->nv); }
};

/// The number of Motions that hold this number of coordinates.
inline std::size_t motions_of(std::size_t nv) {
    return (nv + 7) / 8;
}

/// Degrees of freedom between the base and one or two bodies, ascending.
struct TreePath {
    int dofs[kMostColumns];
    int count = 0;
    int within = 0;  // of them, among the first six

    int further() const { return count - within; }
    /// Of entry k, as the rows of contacts have them.
    std::size_t column(int k) const {
        return static_cast<std::size_t>(k < within ? dofs[k] : 6 + k - within);
    }
};

/// A row of a contact at one side: as many columns as its path has, or a free body.
struct TreeRow {
    double x[kMostColumns];
};

/// What a row pushes: along a direction at a point, or about it.
struct Push {
    Vec3 direction, point;  // world axes
    bool turns = false;
};

/// True for robots with joints that the soft solver moves.
bool may_be_tree(const RobotType& type);
/// Factorises the mass matrix of a robot that has one. False if it has no root.
bool factor_tree(RobotWork& robot, std::span<double> root);
/// To the body; `other`: of the same robot, too. -1: its fixed base.
TreePath path_to(const RobotType& type, int body, int other = -1);
/// The whitened row of a push on the body that the path leads to.
TreeRow row_of(const Tree& tree, const TreePath& path, const Push& push, double sign);
/// The same of a robot that touches itself: `back` pushes `other` the other way.
TreeRow row_between(const Tree& tree, const TreePath& path, int body, const Push& push, int other,
                    const Push& back);

/// y of a velocity, or of the impulse M v.
void whiten_velocity(const Tree& tree, std::span<const double> v, double* y);
void whiten_impulse(const Tree& tree, std::span<const double> impulse, double* y);
/// Adds M v of y.
void add_impulse(const Tree& tree, const double* y, std::span<double> impulse);
/// v of y, times a factor.
void put_velocity(const Tree& tree, const double* y, double factor, std::span<double> v);

}  // namespace roboss::soft
