// Lanes in several registers, each like the one before it (Twice). Doubles beside floats are such: as many
// lanes of doubles as there are lanes of floats. What has to keep its digits (places in the world, the state
// itself) stays in these.
#pragma once

#include "core/single.h"

namespace roboss {

template <class Half>
struct TwiceMask {
    MaskOf<Half> a{}, b{};

    TwiceMask() = default;
    TwiceMask(const MaskOf<Half>& low, const MaskOf<Half>& high) : a(low), b(high) {}
    TwiceMask(bool all) : a(all), b(all) {}  // NOLINT: a bool serves all lanes
    friend TwiceMask operator&(const TwiceMask& x, const TwiceMask& y) { return {x.a & y.a, x.b & y.b}; }
    friend TwiceMask operator|(const TwiceMask& x, const TwiceMask& y) { return {x.a | y.a, x.b | y.b}; }
    friend TwiceMask operator!(const TwiceMask& x) { return {!x.a, !x.b}; }
    unsigned bits() const { return a.bits() | b.bits() << Half::kCount; }
};

/// Twice as many lanes as a register has.
template <class Half>
struct Twice {
    using Mask = TwiceMask<Half>;
    static constexpr std::size_t kCount = 2 * Half::kCount;
    Half a{}, b{};

    Twice() = default;
    Twice(const Half& low, const Half& high) : a(low), b(high) {}
    Twice(double all) : a(all), b(all) {}  // NOLINT: a constant serves all lanes
    double operator[](std::size_t i) const { return i < Half::kCount ? a[i] : b[i - Half::kCount]; }
    void set(std::size_t i, double value) {
        i < Half::kCount ? a.set(i, value) : b.set(i - Half::kCount, value);
    }

    friend Twice operator+(const Twice& x, const Twice& y) { return {x.a + y.a, x.b + y.b}; }
    friend Twice operator-(const Twice& x, const Twice& y) { return {x.a - y.a, x.b - y.b}; }
    friend Twice operator*(const Twice& x, const Twice& y) { return {x.a * y.a, x.b * y.b}; }
    friend Twice operator/(const Twice& x, const Twice& y) { return {x.a / y.a, x.b / y.b}; }
    friend Twice operator-(const Twice& x) { return {-x.a, -x.b}; }
    Twice& operator+=(const Twice& y) { return a += y.a, b += y.b, *this; }
    Twice& operator-=(const Twice& y) { return a -= y.a, b -= y.b, *this; }
    Twice& operator*=(const Twice& y) { return a *= y.a, b *= y.b, *this; }
    friend Mask operator<(const Twice& x, const Twice& y) { return {x.a < y.a, x.b < y.b}; }
    friend Mask operator>(const Twice& x, const Twice& y) { return {x.a > y.a, x.b > y.b}; }
    friend Mask operator<=(const Twice& x, const Twice& y) { return {x.a <= y.a, x.b <= y.b}; }
    friend Mask operator>=(const Twice& x, const Twice& y) { return {x.a >= y.a, x.b >= y.b}; }
    friend Twice select(const Mask& m, const Twice& x, const Twice& y) {
        return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
    }
    friend Mask equal(const Twice& x, const Twice& y) { return {equal(x.a, y.a), equal(x.b, y.b)}; }
    friend Twice sqrt(const Twice& x) { return {sqrt(x.a), sqrt(x.b)}; }
    friend Twice floor(const Twice& x) { return {floor(x.a), floor(x.b)}; }
    friend Twice magnitude(const Twice& x) { return {magnitude(x.a), magnitude(x.b)}; }
};
template <class Half>
double lane(const Twice<Half>& x, std::size_t i) {
    return x[i];
}
template <class Half>
void set_lane(Twice<Half>& x, std::size_t i, double value) {
    x.set(i, value);
}

/// Whether T computes in floats, and the doubles that go with it: T itself if it does not.
template <class T>
struct FloatTraits {
    static constexpr bool kIsFloat = false;
    using Wide = T;
};
template <>
struct FloatTraits<Single> {
    static constexpr bool kIsFloat = true;
    using Wide = double;
};
template <int kLanes, class Isa>
struct FloatTraits<Lanes<float, kLanes, Isa>> {
    static constexpr bool kIsFloat = true;
    using Wide = Twice<Lanes<double, kLanes / 2, Isa>>;
};
template <class Half>
struct FloatTraits<Twice<Half>> {
    static constexpr bool kIsFloat = FloatTraits<Half>::kIsFloat;
    using Wide = Twice<typename FloatTraits<Half>::Wide>;
};
template <class T>
inline constexpr bool kIsFloat = FloatTraits<T>::kIsFloat;
template <class T>
using WideOf = typename FloatTraits<T>::Wide;

/// Doubles to floats, each rounded to the nearest.
template <class T>
struct Narrowing {
    static T of(const WideOf<T>& x) { return T(T::Set::join(x.a.x, x.b.x)); }
};
template <>
struct Narrowing<Single> {
    static Single of(double x) { return Single(x); }
};
template <class Half>
struct Narrowing<Twice<Half>> {
    static Twice<Half> of(const WideOf<Twice<Half>>& x) {
        return {Narrowing<Half>::of(x.a), Narrowing<Half>::of(x.b)};
    }
};
template <class T>
T narrow(const WideOf<T>& x) {
    return Narrowing<T>::of(x);
}

inline double widen(Single x) {
    return x.x;
}
template <int kLanes, class Isa>
Twice<Lanes<double, kLanes / 2, Isa>> widen(const Lanes<float, kLanes, Isa>& x) {
    using Half = Lanes<double, kLanes / 2, Isa>;
    return {Half(Isa::low(x.x)), Half(Isa::high(x.x))};
}
template <class Half>
WideOf<Twice<Half>> widen(const Twice<Half>& x) {
    return {widen(x.a), widen(x.b)};
}

}  // namespace roboss
