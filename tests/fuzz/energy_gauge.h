// Measures by how much the energy of a passive system grew. Where something touches, a tick is a step of
// semi-implicit Euler: v' = v + dt a(q), q' = q + dt v'. Its velocity is that of the middle of the tick, half
// a tick before its coordinates. The energy of both together swings by a share of (rate of the motion) * dt,
// as a body rocks or rolls off its centre, and does not grow (Hairer, Lubich, Wanner, Geometric Numerical
// Integration, 2006, I.1 and IX.3: the method keeps an energy near the true one). Where nothing touches, both
// are of the same time.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <support/mechanical_sums.h>

namespace roboss::fuzz {

/// Energy and its growth above the lowest value so far. What it is relative to: the energy itself; under
/// gravity, whose zero is free, that above the lowest potential energy so far.
class EnergyReading {
  public:
    EnergyReading(double energy, bool gravity) : gravity_(gravity), lowest_(energy) {}

    /// Growth now; `deepest` and `most_kinetic`: of the run so far, J.
    double read(double energy, double deepest, double most_kinetic) {
        // Of the motion at its liveliest: below it a state counts as being at rest.
        const double at_rest = gravity_ ? 1e-3 : 1e-6;
        const double growth = (energy - lowest_) / std::fmax(lowest_ - deepest, at_rest * most_kinetic);
        lowest_ = std::fmin(lowest_, energy);
        return std::isfinite(growth) ? growth : std::numeric_limits<double>::infinity();
    }

  private:
    bool gravity_;
    double lowest_;
};

/// Reads the energy at the end of the tick and in its middle. What truly grows does so in both: the smaller
/// growth counts.
class EnergyGauge {
  public:
    EnergyGauge(const test::MechanicalSums& start, bool gravity)
        : at_end_(start.energy(), gravity),
          in_middle_(start.energy(), gravity),
          deepest_(start.potential),
          most_(start.kinetic) {}

    /// Growth now. `end`: sums after a tick; `begin`: with the velocities after it at the coordinates before.
    double read(const test::MechanicalSums& begin, const test::MechanicalSums& end) {
        most_ = std::fmax(most_, end.kinetic);
        deepest_ = std::fmin(deepest_, end.potential);
        const double middle = 0.5 * (begin.energy() + end.energy());
        return std::fmin(at_end_.read(end.energy(), deepest_, most_),
                         in_middle_.read(middle, deepest_, most_));
    }

  private:
    EnergyReading at_end_, in_middle_;
    double deepest_, most_;
};

}  // namespace roboss::fuzz
