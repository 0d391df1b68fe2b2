// Reference solutions of ordinary differential equations: the extrapolated modified midpoint rule of Gragg,
// Bulirsch and Stoer (Hairer, Norsett, Wanner 1993, II.9) in long double. Slow and, at steps of a few
// milliseconds, exact to some 1e-15: what a simulated motion without a closed form is measured against.
#pragma once

#include <cstddef>
#include <vector>

namespace roboss::test {

using Real = long double;
using RealVector = std::vector<Real>;

namespace detail {

/// y at t + step by `parts` midpoint steps; the error is a series in (step / parts)^2.
template <class Rate>
RealVector midpoint_rule(const Rate& rate, const RealVector& y, Real step, int parts) {
    const Real h = step / static_cast<Real>(parts);
    RealVector before = y, now = y, slope = rate(y);
    for (std::size_t i = 0; i < y.size(); ++i) now[i] += h * slope[i];
    for (int part = 1; part < parts; ++part) {
        slope = rate(now);
        for (std::size_t i = 0; i < y.size(); ++i) {
            const Real next = before[i] + 2 * h * slope[i];
            before[i] = now[i];
            now[i] = next;
        }
    }
    return now;
}

}  // namespace detail

/// Moves y by one step; `rate(y)` is dy/dt. The order is 16.
template <class Rate>
void extrapolated_step(const Rate& rate, Real step, RealVector& y) {
    constexpr std::size_t kRows = 8;
    std::vector<RealVector> above, row;  // of the scheme of Aitken and Neville
    for (std::size_t k = 0; k < kRows; ++k) {
        row.assign(1, detail::midpoint_rule(rate, y, step, static_cast<int>(2 * (k + 1))));
        for (std::size_t j = 1; j <= k; ++j) {
            const Real ratio = static_cast<Real>(k + 1) / static_cast<Real>(k + 1 - j);
            RealVector better = row[j - 1];
            for (std::size_t i = 0; i < y.size(); ++i)
                better[i] += (row[j - 1][i] - above[j - 1][i]) / (ratio * ratio - 1);
            row.push_back(std::move(better));
        }
        above = row;
    }
    y = row.back();
}

/// Moves y by `duration` in steps of at most `step_max`.
template <class Rate>
void extrapolate(const Rate& rate, Real duration, Real step_max, RealVector& y) {
    const auto steps = static_cast<long>(duration / step_max) + 1;
    for (long i = 0; i < steps; ++i) extrapolated_step(rate, duration / static_cast<Real>(steps), y);
}

}  // namespace roboss::test
