// Two doubles that stand side by side, in one operation of any 64-bit processor: for short inner loops that
// compilers leave one by one. Each of the two gets the bits that it would get alone.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

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

/// Two numbers that stand side by side: of doubles a Pair; lanes have room for no more than one.
template <class T>
struct TwoLanes {
    T first{}, second{};
    const T& operator[](std::size_t i) const { return i == 0 ? first : second; }
    friend TwoLanes operator+(const TwoLanes& a, const TwoLanes& b) {
        return {a.first + b.first, a.second + b.second};
    }
    friend TwoLanes operator*(const TwoLanes& a, const TwoLanes& b) {
        return {a.first * b.first, a.second * b.second};
    }
    TwoLanes& operator+=(const TwoLanes& b) { return first += b.first, second += b.second, *this; }
};
template <class T>
using Two = std::conditional_t<std::is_same_v<T, double>, Pair, TwoLanes<T>>;
template <class T>
Two<T> two_at(const T* x) {
    if constexpr (std::is_same_v<T, double>)
        return pair_at(x);
    else
        return {x[0], x[1]};
}

/// Sums of even products and of odd ones, which do not wait for each other. Lanes hold both twice.
template <class T>
struct Halves {
    Two<T> halves{};
    /// Two products.
    void add(const T* row, const T* x) { halves += two_at(row) * two_at(x); }
    void add_even(const T& part) { add_to<0>(part); }
    void add_odd(const T& part) { add_to<1>(part); }
    T sum() const { return halves[0] + halves[1]; }

  private:
    template <int kHalf>
    void add_to(const T& part) {
        if constexpr (std::is_same_v<T, double>)
            halves[kHalf] += part;
        else if constexpr (kHalf == 0)
            halves.first += part;
        else
            halves.second += part;
    }
};

}  // namespace roboss
