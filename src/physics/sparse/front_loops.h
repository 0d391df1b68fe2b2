// The loops of FrontKernel, for whatever instruction set a file is built for: in an unnamed namespace, so
// that no two files share them.
#pragma once

#include <cstring>

#include "physics/sparse/front_kernel.h"

namespace roboss {
namespace {

typedef double FrontVector __attribute__((vector_size(kFrontLanes * sizeof(double)), aligned(8)));

// Vectors go by reference: how they are passed depends on the instruction set.
inline void load_front(const double* from, FrontVector& x) {
    std::memcpy(&x, from, sizeof x);
}

inline void store_front(const FrontVector& x, double* to) {
    std::memcpy(to, &x, sizeof x);
}

/// `kRows` rows from r on, in the columns from `begin` on.
template <std::size_t kRows>
inline void subtract_rows(double* matrix, std::size_t stride, std::size_t r, std::size_t begin,
                          std::size_t width, const double* pivots, const double* factors, std::size_t count) {
    for (std::size_t j = begin; j < width; j += kFrontLanes) {
        FrontVector x[kRows];
        for (std::size_t i = 0; i < kRows; ++i) load_front(matrix + (r + i) * stride + j, x[i]);
        const double* pivot = pivots + j;
        const double* factor = factors + r;
        for (std::size_t k = 0; k < count; ++k, pivot += stride, factor += stride) {
            FrontVector p;
            load_front(pivot, p);
            for (std::size_t i = 0; i < kRows; ++i) x[i] -= p * factor[i];
        }
        for (std::size_t i = 0; i < kRows; ++i) store_front(x[i], matrix + (r + i) * stride + j);
    }
}

void subtract_front(double* matrix, std::size_t stride, std::size_t first, std::size_t last,
                    std::size_t width, const double* pivots, const double* factors, std::size_t count) {
    constexpr std::size_t kTile = 4;
    std::size_t r = first;
    for (; r + kTile <= last; r += kTile)
        subtract_rows<kTile>(matrix, stride, r, r / kFrontLanes * kFrontLanes, width, pivots, factors, count);
    for (; r < last; ++r)
        subtract_rows<1>(matrix, stride, r, r / kFrontLanes * kFrontLanes, width, pivots, factors, count);
}

void eliminate_front(double* matrix, std::size_t stride, std::size_t begin, std::size_t count,
                     std::size_t first, std::size_t last, double* factors) {
    for (std::size_t j = first; j < last; j += kFrontLanes) {
        FrontVector pivots[kFrontPanel];
        for (std::size_t r = 0; r < count; ++r) {
            double* row = matrix + (begin + r) * stride;
            FrontVector x = {};
            const double inverse = row[begin + r];
            if (inverse != 0) {
                load_front(row + j, x);
                const double* factor = factors + begin + r;
                for (std::size_t k = 0; k < r; ++k, factor += stride) x -= pivots[k] * *factor;
            }
            pivots[r] = x;
            store_front(x, row + j);
            x *= inverse;
            store_front(x, factors + r * stride + j);
        }
    }
}

double dot_front(const double* a, const double* b, std::size_t count) {
    FrontVector sums = {};
    for (std::size_t i = 0; i < count; i += kFrontLanes) {
        FrontVector x, y;
        load_front(a + i, x), load_front(b + i, y);
        sums += x * y;
    }
    return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

const FrontKernel kFrontLoops{&subtract_front, &eliminate_front, &dot_front};

}  // namespace
}  // namespace roboss
