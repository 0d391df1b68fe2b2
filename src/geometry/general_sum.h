// The signed distance of any two convex bodies as a function of a direction, as in convex_sum.h but without
// symmetry: s(n) = n.c - h_A(-n) - h_B(n) of the cores; the balls are taken off by the caller.
#pragma once

#include "core/fixed_math.h"
#include "geometry/convex_body.h"
#include "geometry/convex_sum.h"

namespace roboss::narrow {

class GeneralSum {
  public:
    static constexpr bool kSymmetric = false;

    GeneralSum(const ConvexBody& first, const ConvexBody& second);

    const Vec3& centre() const { return centre_; }
    double inradius() const { return fixed_max(a_->inradius(), b_->inradius()); }
    double scale() const { return fixed_min(a_->size(), b_->size()); }
    bool curved() const { return a_->curved() || b_->curved(); }
    double apart_gap() const { return 1e-12; }
    double overlap_gap() const { return curved() ? 1e-4 : 1e-9; }

    Vec3 support(const Vec3& n) const { return b_->support(n) - a_->support(-n); }
    Separation separation(const Vec3& n) const { return {n, dot(n, centre_ - support(n))}; }
    /// separation() and support() at once, bit for bit.
    Touching touching(const Vec3& n) const {
        const Vec3 first = -a_->support(-n), x = first + b_->support(n);
        return {{n, dot(n, centre_ - x)}, x, first};
    }
    GeneralSum moved(const Vec3& by) const {
        GeneralSum sum = *this;
        sum.centre_ += by;
        return sum;
    }

    /// As ConvexSum::polished: to rounding, the flatter of equals.
    Separation polished(const Separation& start) const;

  private:
    struct Edges;

    Separation polished_once(const Separation& start) const;
    double rounding() const;
    Separation better(const Separation& best, const Separation& found) const {
        return found.s >= best.s - rounding() ? found : best;
    }
    Separation climb(const Vec3& start, const Vec3* edge) const;
    bool newton_step(const Touching& at, const Vec3* edge, Vec3& move) const;

    const ConvexBody* a_;
    const ConvexBody* b_;
    Vec3 centre_;
};

}  // namespace roboss::narrow
