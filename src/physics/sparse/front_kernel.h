// Dense arithmetic of the fronts of BlockLdlt, one implementation for each instruction set. All give the same
// bits: every entry is the same sequence of operations, and what is summed across a vector is summed in one
// order.
#pragma once

#include <cstddef>

namespace roboss {

/// Rows are padded to this many entries.
inline constexpr std::size_t kFrontLanes = 8;
/// The most rows of a panel: they are eliminated together before the rest of the front is updated.
inline constexpr std::size_t kFrontPanel = 16;

struct FrontKernel {
    /// Rows `first` .. `last` - 1 of `matrix`, from their diagonal (and up to a vector before it) to `width`,
    /// a multiple of kFrontLanes: row r -= sum over k of factors[k * stride + r] * pivots[k * stride ...], in
    /// the order of k.
    void (*subtract)(double* matrix, std::size_t stride, std::size_t first, std::size_t last,
                     std::size_t width, const double* pivots, const double* factors, std::size_t count);
    /// Eliminates the `count` rows from `begin` on among themselves, in the columns `first` .. `last` - 1,
    /// multiples of kFrontLanes beyond these rows; on the diagonal stand the reciprocals of the pivots, zero
    /// for rows that others imply. Row k of `factors` has the factors of row begin + k; those of these
    /// columns are written.
    void (*eliminate)(double* matrix, std::size_t stride, std::size_t begin, std::size_t count,
                      std::size_t first, std::size_t last, double* factors);
    /// The scalar product of arrays of a multiple of kFrontLanes entries.
    double (*dot)(const double* a, const double* b, std::size_t count);
};

/// The best that this processor can run.
const FrontKernel& front_kernel();

// One for each instruction set; nullptr if it was built without.
const FrontKernel* any_front_kernel();
const FrontKernel* avx2_front_kernel();
const FrontKernel* avx512_front_kernel();

}  // namespace roboss
