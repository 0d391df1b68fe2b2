// Factorisation of a tree's matrix without fill-in (LTDL, Featherstone 2008, section 6.5), in a fixed order
// of operations. Matrices are packed by paths (DofPaths): A(i, path(i)[k]) stands at row(i) + k.
#pragma once

#include <span>

#include "model/dof_paths.h"

namespace roboss {

/// y = A x for a symmetric matrix.
void tree_times(const DofPaths& paths, std::span<const double> a, const double* x, double* y);
/// A = L^T D L in place: D's reciprocals on the diagonal, L below it.
void tree_factor(const DofPaths& paths, std::span<double> a);
/// x := A^-1 x with the factor of tree_factor.
void tree_solve(const DofPaths& paths, std::span<const double> a, double* x);

/// The same for a matrix that is not symmetric, on the same pattern: `lower` holds A(i, j) and `upper` A(j,
/// i) (the diagonal in `lower`). No pivoting: false if a pivot is not positive.
bool tree_factor_general(const DofPaths& paths, std::span<double> lower, std::span<double> upper);
void tree_solve_general(const DofPaths& paths, std::span<const double> lower, std::span<const double> upper,
                        double* x);

}  // namespace roboss
