// fdlibm's kernels, written for one rounding at each operation (-ffp-contract=off is part of the contract).
#include "core/fixed_math.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace roboss {
namespace {

double atan_positive(double x) {
    constexpr double kHigh[] = {4.63647609000806093515e-01, 7.85398163397448278999e-01,
                                9.82793723247329054082e-01, 1.57079632679489655800e+00};
    constexpr double kLow[] = {2.26987774529616870924e-17, 3.06161699786838301793e-17,
                               1.39033110312309984516e-17, 6.12323399573676603587e-17};
    int region = -1;
    if (x >= 2.4375) {
        region = 3, x = -1.0 / x;
    } else if (x >= 1.1875) {
        region = 2, x = (x - 1.5) / (1.0 + 1.5 * x);
    } else if (x >= 0.6875) {
        region = 1, x = (x - 1.0) / (x + 1.0);
    } else if (x >= 0.4375) {
        region = 0, x = (2.0 * x - 1.0) / (2.0 + x);
    }
    const double z = x * x;
    const double w = z * z;
    const double s1 =
        z * (3.33333333333329318027e-01 +
             w * (1.42857142725034663711e-01 +
                  w * (9.09088713343650656196e-02 +
                       w * (6.66107313738753120669e-02 +
                            w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
    const double s2 = w * (-1.99999999998764832476e-01 +
                           w * (-1.11111104054623557880e-01 +
                                w * (-7.69187620504482999495e-02 +
                                     w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
    if (region < 0) return x - x * (s1 + s2);
    return kHigh[region] - ((x * (s1 + s2) - kLow[region]) - x);
}

}  // namespace

double fixed_sin(double angle) {
    return fixed_sincos(angle).sin;
}

double fixed_cos(double angle) {
    return fixed_sincos(angle).cos;
}

double fixed_atan2(double y, double x) {
    if (y == 0.0 && x == 0.0) return 0.0;
    const double ax = std::fabs(x);
    const double ay = std::fabs(y);
    double angle = ax == 0.0 ? 0.5 * kPi : atan_positive(ay / ax);
    if (x < 0.0) angle = kPi - (angle - 1.2246467991473531772e-16);
    return y < 0.0 ? -angle : angle;
}

double fixed_asin(double x) {
    if (x >= 1.0) return 0.5 * kPi;
    if (x <= -1.0) return -0.5 * kPi;
    return fixed_atan2(x, std::sqrt((1.0 - x) * (1.0 + x)));
}

double fixed_acos(double x) {
    if (x >= 1.0) return 0.0;
    if (x <= -1.0) return kPi;
    return fixed_atan2(std::sqrt((1.0 - x) * (1.0 + x)), x);
}

double fixed_log(double x) {
    constexpr double kLn2High = 6.93147180369123816490e-01;
    constexpr double kLn2Low = 1.90821492927058770002e-10;
    std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
    auto exponent = static_cast<int>((bits >> 52) & 0x7FF) - 1023;
    double m = std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFFull) | 0x3FF0000000000000ull);
    if (m > 1.41421356237309514547) {
        m *= 0.5;
        exponent += 1;
    }
    const double f = m - 1.0;
    const double s = f / (2.0 + f);
    const double z = s * s;
    const double w = z * z;
    const double t1 =
        w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
    const double t2 =
        z * (6.666666666666735130e-01 +
             w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
    const double half = 0.5 * f * f;
    const double k = exponent;
    return k * kLn2High - ((half - (s * (half + (t1 + t2)) + k * kLn2Low)) - f);
}

double fixed_exp(double x) {
    constexpr double kLn2High = 6.93147180369123816490e-01;
    constexpr double kLn2Low = 1.90821492927058770002e-10;
    constexpr double kInverseLn2 = 1.44269504088896338700e+00;
    constexpr double kMost = 700;
    if (!(x > -kMost)) x = -kMost;
    if (x > kMost) x = kMost;
    const double n = std::floor(x * kInverseLn2 + 0.5);
    const double high = x - n * kLn2High, low = n * kLn2Low;
    const double r = high - low, t = r * r;
    const double c = r - t * (1.66666666666666019037e-01 +
                              t * (-2.77777777770155933842e-03 +
                                   t * (6.61375632143793436117e-05 +
                                        t * (-1.65339022054652515390e-06 + t * 4.13813679705723846039e-08))));
    const double y = 1.0 - ((low - r * c / (2.0 - c)) - high);
    const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(n) + 1023);
    return y * std::bit_cast<double>(exponent << 52);
}

double wrap_angle(double angle) {
    const double turns = std::floor(angle / (2.0 * kPi) + 0.5);
    const double wrapped = angle - turns * (2.0 * kPi);
    return wrapped <= -kPi ? kPi : wrapped;
}

}  // namespace roboss
