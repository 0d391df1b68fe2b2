// Elementary functions with the same bits on every processor and compiler: only + - * / and sqrt, in a fixed
// order. libm picks other code on processors with FMA, so nothing in the step path or in sensors may call it.
// Polynomials and reduction constants are those of fdlibm (Sun Microsystems, 1993); errors below 2 units in
// the last place for |x| < 1e6 (beyond, the reduction loses digits slowly but the bits stay the same
// everywhere).
#pragma once

namespace roboss {

inline constexpr double kPi = 3.14159265358979323846;

struct SinCos {
    double sin = 0;
    double cos = 1;
};

SinCos fixed_sincos(double angle_rad);
double fixed_sin(double angle_rad);
double fixed_cos(double angle_rad);
double fixed_atan2(double y, double x);  // -pi .. pi, (0,0) gives 0
double fixed_asin(double x);             // argument clamped to -1 .. 1
double fixed_acos(double x);             // argument clamped to -1 .. 1
double fixed_log(double x);              // x > 0 and normal; otherwise the result is meaningless but fixed

/// The same angle in (-pi, pi].
double wrap_angle(double angle_rad);

}  // namespace roboss
