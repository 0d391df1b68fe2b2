// Lanes: the same arithmetic on several robots at once. A kernel is written over a number type T; T = double
// serves one robot, T = Lanes a few robots of one type, each in its lane of a register. Every operation is
// the one that double would do, so each lane gets the same bits as a robot by itself; where ways part, both
// are computed and the right one is chosen (select), or the lanes vote (Lockstep).
//
// `Isa` names the instruction set (core/lanes_x86.h) and gives what the language has no operator for. It is a
// template argument so that code for different processors has different names: the linker must never take
// one for the other.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace roboss {

/// Yes or no for each lane.
template <class Number, int kLanes, class Isa>
struct LaneMask {
    using Bits = std::conditional_t<sizeof(Number) == 8, std::int64_t, std::int32_t>;
    using Vector [[gnu::vector_size(kLanes * sizeof(Number))]] = Bits;
    Vector m{};

    LaneMask() = default;
    explicit LaneMask(Vector lanes) : m(lanes) {}
    LaneMask(bool all) : m(Vector{} - Bits{all}) {}  // NOLINT: a bool serves all lanes
    friend LaneMask operator&(const LaneMask& a, const LaneMask& b) { return LaneMask(a.m & b.m); }
    friend LaneMask operator|(const LaneMask& a, const LaneMask& b) { return LaneMask(a.m | b.m); }
    friend LaneMask operator!(const LaneMask& a) { return LaneMask(~a.m); }
    /// Bit i: lane i.
    unsigned bits() const { return Isa::bits(m); }
    bool operator[](std::size_t i) const { return m[i] != 0; }
};

template <class Number, int kLanes, class Isa>
struct Lanes {
    using Vector [[gnu::vector_size(kLanes * sizeof(Number))]] = Number;
    using Mask = LaneMask<Number, kLanes, Isa>;
    using Set = Isa;
    static constexpr std::size_t kCount = kLanes;
    Vector x{};

    Lanes() = default;
    explicit Lanes(Vector lanes) : x(lanes) {}
    Lanes(double all) : x(static_cast<Number>(all) - Vector{}) {}  // NOLINT: a constant serves all lanes
    double operator[](std::size_t i) const { return x[i]; }
    void set(std::size_t i, double value) { x[i] = static_cast<Number>(value); }

    friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.x + b.x); }
    friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.x - b.x); }
    friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.x * b.x); }
    friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.x / b.x); }
    friend Lanes operator-(const Lanes& a) { return Lanes(-a.x); }
    Lanes& operator+=(const Lanes& b) { return x += b.x, *this; }
    Lanes& operator-=(const Lanes& b) { return x -= b.x, *this; }
    Lanes& operator*=(const Lanes& b) { return x *= b.x, *this; }
    friend Mask operator<(const Lanes& a, const Lanes& b) { return Mask(a.x < b.x); }
    friend Mask operator>(const Lanes& a, const Lanes& b) { return Mask(a.x > b.x); }
    friend Mask operator<=(const Lanes& a, const Lanes& b) { return Mask(a.x <= b.x); }
    friend Mask operator>=(const Lanes& a, const Lanes& b) { return Mask(a.x >= b.x); }
    friend Lanes select(const Mask& m, const Lanes& a, const Lanes& b) { return Lanes(m.m ? a.x : b.x); }
    friend Mask equal(const Lanes& a, const Lanes& b) { return Mask(a.x == b.x); }
    friend Lanes sqrt(const Lanes& a) { return Lanes(Isa::sqrt(a.x)); }
    friend Lanes floor(const Lanes& a) { return Lanes(Isa::floor(a.x)); }
    friend Lanes magnitude(const Lanes& a) { return Lanes(Isa::magnitude(a.x)); }
};

/// One robot by itself: the same words for double.
inline double select(bool m, double a, double b) {
    return m ? a : b;
}
inline bool equal(double a, double b) {
    return a == b;
}
inline double magnitude(double a) {
    return std::fabs(a);
}
inline double lane(double x, std::size_t) {
    return x;
}
inline void set_lane(double& x, std::size_t, double value) {
    x = value;
}
template <class Number, int kLanes, class Isa>
double lane(const Lanes<Number, kLanes, Isa>& x, std::size_t i) {
    return x[i];
}
template <class Number, int kLanes, class Isa>
void set_lane(Lanes<Number, kLanes, Isa>& x, std::size_t i, double value) {
    x.set(i, value);
}

template <class T>
struct LaneTraits {
    using Mask = typename T::Mask;
    static constexpr std::size_t kCount = T::kCount;
    static unsigned bits(const Mask& m) { return m.bits(); }
};
template <>
struct LaneTraits<double> {
    using Mask = bool;
    static constexpr std::size_t kCount = 1;
    static unsigned bits(bool m) { return m ? 1u : 0u; }
};
template <class T>
using MaskOf = typename LaneTraits<T>::Mask;
template <class T>
inline constexpr std::size_t kLanesOf = LaneTraits<T>::kCount;
template <class T>
inline constexpr unsigned kAllLanes = kLanesOf<T> == 32 ? ~0u : (1u << kLanesOf<T>)-1u;

/// True if it is so in any lane.
template <class Mask>
bool any(const Mask& m) {
    if constexpr (std::is_same_v<Mask, bool>)
        return m;
    else
        return m.bits() != 0;
}

/// As std::max, std::min and std::clamp choose: of equals the first.
template <class T>
T larger(const T& a, const T& b) {
    return select(a < b, b, a);
}
template <class T>
T smaller(const T& a, const T& b) {
    return select(b < a, b, a);
}
template <class T>
T clamped(const T& x, const T& low, const T& high) {
    return select(x < low, low, select(high < x, high, x));
}

/// `yes` or `no`, two functions without arguments: only what a lane needs is computed.
template <class Mask, class Yes, class No>
auto either(const Mask& m, Yes&& yes, No&& no) {
    if constexpr (std::is_same_v<Mask, bool>) {
        return m ? yes() : no();
    } else {
        const unsigned bits = m.bits();
        if (bits == 0) return no();
        return select(m, yes(), no());
    }
}

/// Who still goes the same way through a computation. Lanes vote; those that would go another way than most
/// leave: what is computed for them from there on counts for nothing, and they are computed again by
/// themselves. One robot alone decides as it likes.
template <class T>
class Lockstep {
  public:
    Lockstep() = default;
    /// Bit i: lane i is there.
    explicit Lockstep(unsigned present) : present_(present) {}
    bool operator()(const MaskOf<T>& condition) { return vote(condition, present_); }
    /// The vote of those who are not `done`; these stay, whatever comes of it.
    bool without(const MaskOf<T>& done, const MaskOf<T>& condition) {
        const unsigned resting = LaneTraits<T>::bits(done) & present_;
        present_ &= ~resting;
        const bool go = vote(condition, present_);
        present_ |= resting;
        return go;
    }
    bool all(const MaskOf<T>& condition) const { return (present_ & ~LaneTraits<T>::bits(condition)) == 0; }
    bool any() const { return present_ != 0; }
    void leave(std::size_t lane) { present_ &= ~(1u << lane); }
    /// Bit i: lane i is still there.
    unsigned present() const { return present_; }

  private:
    bool vote(const MaskOf<T>& condition, unsigned voters) {
        const unsigned yes = LaneTraits<T>::bits(condition) & voters, no = voters & ~yes;
        const bool go = yes != 0 && __builtin_popcount(yes) >= __builtin_popcount(no);
        present_ = go ? yes : no;
        return go;
    }

    unsigned present_ = kAllLanes<T>;
};
template <>
class Lockstep<double> {
  public:
    Lockstep() = default;
    explicit Lockstep(unsigned) {}
    bool operator()(bool condition) { return condition; }
    bool without(bool done, bool condition) { return !done && condition; }
    bool all(bool condition) const { return condition; }
    bool any() const { return true; }
    unsigned present() const { return 1; }
};

}  // namespace roboss
