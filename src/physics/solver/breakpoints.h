// Rows along a line between two velocities. Most stay between their bounds or at one of them, or slide on in
// about the same direction: along the line the derivative of their potential is a straight line too, or as
// good as one for who looks for a minimum. Those that stick or let go, or turn, bend it. Over T: see
// newton.h.
#pragma once

#include <vector>

#include "physics/solver/row_math.h"

namespace roboss {

template <class T>
class LineSearchBreakpoints {
  public:
    /// Finds the rows that bend between `low` and `high` of the range along their steps. There the derivative
    /// of the potential of everything is s_low and s_high.
    void find(IslandRowsT<T>& rows, const T& low, const T& high, const T& s_low, const T& s_high);
    /// The derivative between them.
    T slope(const T& fraction) const;

  private:
    using Mask = MaskOf<T>;
    template <class Row>
    struct Bent {
        const Row* row = nullptr;
        Mask here{true};
    };
    using Bounded = BoundedRowT<T>;
    using Disc = FrictionDiscT<T>;

    static Mask bends(const Bounded& row, const T& low, const T& high);
    static Mask bends(const Disc& disc, const TangentialT<T>& low, const TangentialT<T>& high);

    std::vector<Bent<Bounded>> bounded_;
    std::vector<Bent<Disc>> discs_;
    T low_{}, at_low_{}, rise_{};  // the straight part: its value at low, more per unit of step
};

template <class T>
MaskOf<T> LineSearchBreakpoints<T>::bends(const Bounded& row, const T& low, const T& high) {
    const T at_low = (row.target - row.u - low * row.du) * row.stiffness;
    const T at_high = (row.target - row.u - high * row.du) * row.stiffness;
    const Mask below = (at_low <= row.low) & (at_high <= row.low);
    const Mask above = (at_low >= row.high) & (at_high >= row.high);
    const Mask between = (smaller(at_low, at_high) >= row.low) & (larger(at_low, at_high) <= row.high);
    return !(below | above | between);
}

template <class T>
MaskOf<T> LineSearchBreakpoints<T>::bends(const Disc& disc, const TangentialT<T>& low,
                                          const TangentialT<T>& high) {
    constexpr double kStraight = 0.9;  // cosine of the angle by which sliding may turn
    constexpr double kInside = 1 - 1e-9;
    const T full = disc.bound * disc.bound;
    const Mask sticks = (low.t1 * low.t1 + low.t2 * low.t2 < kInside * full) &
                        (high.t1 * high.t1 + high.t2 * high.t2 < kInside * full);
    const Mask slides_on = low.t1 * high.t1 + low.t2 * high.t2 >= kStraight * full;
    return !(sticks | slides_on);
}

template <class T>
void LineSearchBreakpoints<T>::find(IslandRowsT<T>& rows, const T& low, const T& high, const T& s_low,
                                    const T& s_high) {
    bounded_.clear(), discs_.clear();
    T at_low = s_low, at_high = s_high;
    const auto take_out = [&](const Mask& here, const T& force_low, const T& force_high) {
        at_low += select(here, force_low, T(0)), at_high += select(here, force_high, T(0));
    };
    for_each_bounded(rows, [&](Bounded& row) {
        const Mask here = bends(row, low, high);
        if (!any(here)) return;
        bounded_.push_back({&row, here});
        take_out(here, force_along(row, low), force_along(row, high));
    });
    for_each_disc(rows, [&](Disc& disc) {
        if (disc.coefficient == 0) return;
        const TangentialT<T> t_low = impulse_along(disc, low), t_high = impulse_along(disc, high);
        const Mask here = bends(disc, t_low, t_high);
        if (!any(here)) return;
        discs_.push_back({&disc, here});
        take_out(here, force_of(disc, t_low), force_of(disc, t_high));
    });
    low_ = low, at_low_ = at_low, rise_ = (at_high - at_low) / (high - low);
}

template <class T>
T LineSearchBreakpoints<T>::slope(const T& fraction) const {
    T sum = at_low_ + (fraction - low_) * rise_;
    for (const Bent<Bounded>& bent : bounded_)
        sum -= select(bent.here, force_along(*bent.row, fraction), T(0));
    for (const Bent<Disc>& bent : discs_) sum -= select(bent.here, force_along(*bent.row, fraction), T(0));
    return sum;
}

}  // namespace roboss
