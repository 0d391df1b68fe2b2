// Two doubles that stand side by side, in one operation of any 64-bit processor: for short inner loops that
// compilers leave one by one. Each of the two gets the bits that it would get alone.
#pragma once

#include <cstddef>

namespace roboss {

/// At any address of doubles.
using Pair [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;

inline Pair& pair_at(double* x) {
    return *reinterpret_cast<Pair*>(x);
}
inline const Pair& pair_at(const double* x) {
    return *reinterpret_cast<const Pair*>(x);
}
inline Pair both(double x) {
    return Pair{x, x};
}

}  // namespace roboss
