// See radio_link.h.
#include "sensors/radio_link.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"

namespace roboss {
namespace {

constexpr double kLn10 = 2.30258509299404568402;
constexpr double kSqrtPi = 1.77245385090551602730;

}  // namespace

bool share_a_channel(const RadioSpec& a, const RadioSpec& b) {
    return a.channel == b.channel && a.broker == b.broker;
}

double radio_log10(double x) {
    return fixed_log(x) / kLn10;
}

double radio_power(double dBm) {
    return fixed_exp(dBm / 10 * kLn10);
}

double radio_erfc(double x) {
    const double gauss = fixed_exp(-x * x) / kSqrtPi;
    if (x < 2.5) {  // erf(x) = 2/sqrt(pi) exp(-x^2) sum 2^n x^(2n+1) / (1 3 5 ... (2n+1)) (DLMF 7.6.2)
        double term = x, sum = x;
        for (int n = 1; term > 1e-17 * sum; ++n) sum += term *= 2 * x * x / (2 * n + 1);
        return 1 - 2 * gauss * sum;
    }
    // erfc(x) = exp(-x^2)/sqrt(pi) 1/(x + (1/2)/(x + 1/(x + (3/2)/(x + ...)))) (DLMF 7.9.1)
    double fraction = x;
    for (int n = 60; n >= 1; --n) fraction = x + 0.5 * n / fraction;
    return gauss / fraction;
}

double radio_success(double signal_to_noise, double bytes) {
    if (!(bytes > 0)) return 1;
    const double error = radio_erfc(std::sqrt(signal_to_noise));
    if (!(error < 1)) return 0;
    // log(1 - error) of a small error is -error - error^2 / 2
    const double log = error < 1e-6 ? -error - error * error / 2 : fixed_log(1 - error);
    return fixed_exp(std::max(bytes * log, -700.0));
}

/// The quotient of a whole number of ticks may be a little above it.
Tick radio_arrival(double time_s, double dt_s) {
    constexpr double kRounding = 1e-6;  // of a tick
    return static_cast<Tick>(std::ceil(time_s / dt_s - kRounding));
}

}  // namespace roboss
