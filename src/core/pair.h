// Two doubles that stand side by side, in one operation of any 64-bit processor: for short inner loops that
// compilers leave one by one. Each of the two gets the bits that it would get alone.
#pragma once

#include <cstring>

namespace roboss {

using Pair [[gnu::vector_size(16)]] = double;

/// At any address of doubles.
inline Pair pair_at(const double* x) {
    Pair pair;
    std::memcpy(&pair, x, sizeof pair);
    return pair;
}
inline void put(double* x, const Pair& pair) {
    std::memcpy(x, &pair, sizeof pair);
}
inline Pair both(double x) {
    return Pair{x, x};
}

}  // namespace roboss
