// Elementary functions with the same bits on every processor and compiler: only + - * / and sqrt, in a fixed
// order. libm picks other code on processors with FMA, so nothing in the step path or in sensors may call it.
// Polynomials and reduction constants are those of fdlibm (Sun Microsystems, 1993); errors below 2 units in
// the last place for |x| < 1e6 (beyond, the reduction loses digits slowly but the bits stay the same
// everywhere).
#pragma once

#include "core/lanes.h"

namespace roboss {

inline constexpr double kPi = 3.14159265358979323846;

template <class T>
struct SinCosT {
    T sin = 0;
    T cos = 1;
};
using SinCos = SinCosT<double>;

template <class T>
SinCosT<T> fixed_sincos(const T& angle_rad);
double fixed_sin(double angle_rad);
double fixed_cos(double angle_rad);
double fixed_atan2(double y, double x);  // -pi .. pi, (0,0) gives 0
double fixed_asin(double x);             // argument clamped to -1 .. 1
double fixed_acos(double x);             // argument clamped to -1 .. 1
double fixed_log(double x);              // x > 0 and normal; otherwise the result is meaningless but fixed

double fixed_exp(double x);  // argument clamped to -700 .. 700

/// As std::fmax and std::fmin, which disagree between processors about the sign of zero: of equals the
/// first; of a number and what is none the number.
inline double fixed_max(double a, double b) {
    return b > a || std::isnan(a) ? b : a;
}
inline double fixed_min(double a, double b) {
    return b < a || std::isnan(a) ? b : a;
}

/// The same angle in (-pi, pi].
double wrap_angle(double angle_rad);

namespace fixed {

// pi/2 in three parts of 33 bits and a rest, for Cody-Waite reduction.
inline constexpr double kPio2Part1 = 1.57079632673412561417e+00;
inline constexpr double kPio2Part2 = 6.07710050630396597660e-11;
inline constexpr double kPio2Part3 = 2.02226624871116645580e-21;
inline constexpr double kPio2Part3Rest = 8.47842766036889956997e-32;
inline constexpr double kTwoOverPi = 6.36619772367581382433e-01;

template <class T>
T sin_kernel(const T& x) {
    const T z = x * x;
    const T r = 8.33333333332248946124e-03 +
                z * (-1.98412698298579493134e-04 +
                     z * (2.75573137070700676789e-06 +
                          z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
    return x + z * x * (-1.66666666666666324348e-01 + z * r);
}

template <class T>
T cos_kernel(const T& x) {
    const T z = x * x;
    const T r = z * (4.16666666666666019037e-02 +
                     z * (-1.38888888888741095749e-03 +
                          z * (2.48015872894767294178e-05 +
                               z * (-2.75573143513906633035e-07 +
                                    z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
    const T half = 0.5 * z;
    const T w = 1.0 - half;
    return w + (((1.0 - w) - half) + z * r);
}

/// n mod 4 of a whole number. Those too large for an integer are multiples of 4.
template <class T>
T mod_4(const T& n) {
    if constexpr (std::is_same_v<T, double>)
        return std::fabs(n) < 0x1p62 ? static_cast<double>(static_cast<std::int64_t>(n) & 3) : 0.0;
    else
        return n - 4.0 * floor(n * 0.25);  // exact
}

}  // namespace fixed

template <class T>
SinCosT<T> fixed_sincos(const T& angle) {
    using std::floor;
    const T n = floor(angle * fixed::kTwoOverPi + 0.5);
    const T r = ((angle - n * fixed::kPio2Part1) - n * fixed::kPio2Part2) - n * fixed::kPio2Part3 -
                n * fixed::kPio2Part3Rest;
    const T s = fixed::sin_kernel(r), c = fixed::cos_kernel(r);
    const T quadrant = fixed::mod_4(n);
    if (!any(!equal(quadrant, T(0)))) return {s, c};  // most joints, most of the time
    const auto second = equal(quadrant, T(1)), third = equal(quadrant, T(2)), fourth = equal(quadrant, T(3));
    const T sine = select(second | fourth, c, s), cosine = select(second | fourth, s, c);
    return {select(third | fourth, -sine, sine), select(second | third, -cosine, cosine)};
}

}  // namespace roboss
