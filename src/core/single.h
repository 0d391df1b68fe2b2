// One robot by itself in floats: the scalar companion of lanes of floats (lanes.h), with the same bits. Every
// number that meets it becomes a float first; beside a plain float C++ would compute in double.
#pragma once

#include "core/lanes.h"

namespace roboss {

struct Single {
    using Mask = bool;
    static constexpr std::size_t kCount = 1;
    float x = 0;

    Single() = default;
    Single(double value) : x(static_cast<float>(value)) {}  // NOLINT: a constant becomes a float
    static Single of(float value) {
        Single s;
        s.x = value;
        return s;
    }

    friend Single operator+(Single a, Single b) { return of(a.x + b.x); }
    friend Single operator-(Single a, Single b) { return of(a.x - b.x); }
    friend Single operator*(Single a, Single b) { return of(a.x * b.x); }
    friend Single operator/(Single a, Single b) { return of(a.x / b.x); }
    friend Single operator-(Single a) { return of(-a.x); }
    Single& operator+=(Single b) { return x += b.x, *this; }
    Single& operator-=(Single b) { return x -= b.x, *this; }
    Single& operator*=(Single b) { return x *= b.x, *this; }
    friend bool operator<(Single a, Single b) { return a.x < b.x; }
    friend bool operator>(Single a, Single b) { return a.x > b.x; }
    friend bool operator<=(Single a, Single b) { return a.x <= b.x; }
    friend bool operator>=(Single a, Single b) { return a.x >= b.x; }
    friend Single select(bool m, Single a, Single b) { return m ? a : b; }
    friend bool equal(Single a, Single b) { return a.x == b.x; }
    friend Single sqrt(Single a) { return of(std::sqrt(a.x)); }
    friend Single floor(Single a) { return of(std::floor(a.x)); }
    friend Single magnitude(Single a) { return of(std::fabs(a.x)); }
};

inline double lane(Single a, std::size_t) {
    return a.x;
}
inline void set_lane(Single& a, std::size_t, double value) {
    a = Single(value);
}

template <>
struct LaneTraits<Single> {
    using Mask = bool;
    static constexpr std::size_t kCount = 1;
    static unsigned bits(bool m) { return m ? 1u : 0u; }
};

}  // namespace roboss
