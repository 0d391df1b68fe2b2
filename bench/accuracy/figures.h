// Small sums over what a case samples.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "math/vec3.h"

namespace roboss::bench {

/// The larger one; what is no number stays none, so that a state that blew up shows.
inline double largest(double a, double b) {
    return std::isnan(a) || b <= a ? a : b;
}

/// Slope of the straight line through (log x, log y) with the least squares.
inline double log_slope(const std::vector<double>& x, const std::vector<double>& y) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    const auto n = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double u = std::log(x[i]), v = std::log(y[i]);
        sx += u, sy += v, sxx += u * u, sxy += u * v;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace roboss::bench
