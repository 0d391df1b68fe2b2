// The sum of two convex bodies during a motion: the hull of the sums at its beginning and its end. Every
// point of a body is near the chord of its course, so a direction that separates this sum by more than the
// points may be off their chords separates the bodies all the way.
#pragma once

#include "geometry/general_sum.h"

namespace roboss::narrow {

class SweptSum {
  public:
    SweptSum(const GeneralSum& begin, const GeneralSum& end) : begin_(begin), end_(end) {}

    const Vec3& centre() const { return begin_.centre(); }
    double scale() const { return begin_.scale(); }
    double apart_gap() const { return 1e-6; }
    Touching touching(const Vec3& n) const {
        const Touching first = begin_.touching(n), last = end_.touching(n);
        if (first.s <= last.s) return first;
        return {{n, last.s}, last.support + (begin_.centre() - end_.centre()), last.first};
    }

  private:
    GeneralSum begin_, end_;
};

}  // namespace roboss::narrow
