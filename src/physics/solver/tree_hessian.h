// The matrix of Newton's method, M + J^T D J with D the rows' curvatures, where all rows act along paths of
// one robot's tree: then it has the mass matrix's pattern. Over T: one robot, or a few in lanes.
#pragma once

#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "physics/dynamics/tree_factor.h"
#include "physics/solver/row_math.h"

namespace roboss {

/// Curvatures of a contact point that the matrix lacks.
template <class T>
struct CurvatureChange {
    T n{}, t11{}, t12{}, t22{};
    MaskOf<T> nothing() const {
        return equal(n, T(0)) & equal(t11, T(0)) & equal(t12, T(0)) & equal(t22, T(0));
    }
    /// D J for a column of J.
    jacobian::Along<T> times(const T& cn, const T& c1, const T& c2) const {
        return {n * cn, t11 * c1 + t12 * c2, t12 * c1 + t22 * c2};
    }
};

/// What the matrix lacks, which from now on it holds.
template <class T>
CurvatureChange<T> take_change(BoundedRowT<T>& normal, FrictionDiscT<T>& disc) {
    const CurvatureChange<T> change{normal.d - normal.d_held, disc.d_11 - disc.held_11,
                                    disc.d_12 - disc.held_12, disc.d_22 - disc.held_22};
    normal.d_held = normal.d;
    disc.held_11 = disc.d_11, disc.held_12 = disc.d_12, disc.held_22 = disc.d_22;
    return change;
}

template <class T>
void hold_nothing(IslandRowsT<T>& rows) {
    for_each_bounded(rows, [](BoundedRowT<T>& row) { row.d_held = 0; });
    for_each_disc(rows, [](FrictionDiscT<T>& disc) { disc.held_11 = disc.held_12 = disc.held_22 = 0; });
}

template <class T>
class TreeHessian {
  public:
    /// The rows' curvatures are not in yet.
    void start(const Mechanics<T>& robot, IslandRowsT<T>& rows) {
        paths_ = &robot.type->paths;
        kept_ = robot.mass_matrix;
        hold_nothing(rows);
    }
    /// For the solver, which speaks of islands: the only robot.
    void start(std::span<const Mechanics<T>* const> robots, std::span<const int>, IslandRowsT<T>& rows,
               std::size_t) {
        start(*robots[0], rows);
    }

    /// Whether it does unsymmetric matrices.
    static constexpr bool couples() { return true; }

    /// Takes the rows' curvatures, as far as they changed; with `coupled` also those of friction bounds that
    /// move with the normal impulse, which make the matrix unsymmetric. Nothing is left out: here it would
    /// spare little.
    void assemble(IslandRowsT<T>& rows, bool coupled, const T& /*lack*/) {
        coupled_ = coupled;
        for (JointRowT<T>& row : rows.joints) {
            const T change = row.d - row.d_held;
            row.d_held = row.d;
            kept_[paths_->diagonal(static_cast<std::size_t>(row.dof))] += change;
        }
        for (ContactRowT<T>& row : rows.contacts)
            add_block(rows.columns, row.first, row.last, take_change(row.normal, row.slip));
        for (AngularRowT<T>& row : rows.angulars)
            add_block(rows.columns, row.first, row.last, take_change(row.spin, row.roll));
        h_ = kept_;
        if (!coupled) return;
        upper_ = kept_;
        add_slides(rows);
    }

    /// x := H^-1 x, once after assemble. False for the lanes whose unsymmetric matrix has no factorisation
    /// without pivoting.
    MaskOf<T> solve(std::vector<T>& x) {
        if (!coupled_) {
            tree_factor(*paths_, h_.data());
            tree_solve(*paths_, h_.data(), x.data());
            return true;
        }
        const MaskOf<T> good = tree_factor_general(*paths_, h_.data(), upper_.data());
        if (any(good)) tree_solve_general(*paths_, h_.data(), upper_.data(), x.data());
        return good;
    }

  private:
    /// J^T D J of one contact, or of its angular row. Its columns are those of one path: a row of the lower
    /// triangle is all that precedes.
    void add_block(const ContactColumnsT<T>& columns, std::size_t first, std::size_t last,
                   const CurvatureChange<T>& d) {
        const MaskOf<T> nothing = d.nothing(), some = !nothing;
        if (first == last || !any(some)) return;
        const T *cn = columns.n.data() + first, *c1 = columns.t1.data() + first,
                *c2 = columns.t2.data() + first;
        using Share = jacobian::Along<T>;
        const auto rows = [&](auto&& add) {
            for (std::size_t a = 0; a < last - first; ++a) {
                add(d.times(cn[a], c1[a], c2[a]), a + 1,
                    kept_.data() + paths_->row(static_cast<std::size_t>(columns.dof[first + a])));
            }
        };
        if constexpr (std::is_same_v<T, double>) {
            if (columns.base[first]) return add_block_on_base(columns, first, last, d);
        }
        if (!any(nothing))
            rows([&](const Share& share, std::size_t count, T* h) {
                jacobian::add_run(cn, c1, c2, share, count, h);
            });
        else  // adding zero is not nothing: it takes the sign from a zero
            rows([&](const Share& share, std::size_t count, T* __restrict h) {
                for (std::size_t b = 0; b < count; ++b)
                    h[b] = select(some, h[b] + (cn[b] * share.n + c1[b] * share.t1 + c2[b] * share.t2), h[b]);
            });
    }

    /// The same for a contact whose path begins with a free base.
    void add_block_on_base(const ContactColumns& columns, std::size_t first, std::size_t last,
                           const CurvatureChange<double>& d) {
        const double *cn = columns.n.data() + first, *c1 = columns.t1.data() + first,
                     *c2 = columns.t2.data() + first;
        const auto share = [&](std::size_t a) { return d.times(cn[a], c1[a], c2[a]); };
        const auto add_row = [&]<std::size_t a>(std::integral_constant<std::size_t, a>) {
            jacobian::add_run(cn, c1, c2, share(a), a + 1, kept_.data() + a * (a + 1) / 2);
        };
        [&]<std::size_t... a>(std::index_sequence<a...>) {
            (add_row(std::integral_constant<std::size_t, a>{}), ...);
        }
        (std::make_index_sequence<6>{});
        for (std::size_t a = 6; a < last - first; ++a) {
            double* h = kept_.data() + paths_->row(static_cast<std::size_t>(columns.dof[first + a]));
            const jacobian::Along<double> s = share(a);
            jacobian::add_run(cn, c1, c2, s, 6, h);
            jacobian::add_run(cn + 6, c1 + 6, c2 + 6, s, a - 5, h + 6);
        }
    }

    /// Sliding friction by the normal velocity: the part that is not symmetric. What is right of the diagonal
    /// stands in the rows of `upper_`.
    void add_slides(const IslandRowsT<T>& rows) {
        for (const ContactRowT<T>& row : rows.contacts) {
            const FrictionDiscT<T>& disc = row.slip;
            const MaskOf<T> some = !(equal(disc.d_1n, T(0)) & equal(disc.d_2n, T(0)));
            if (row.first == row.last || !any(some)) continue;
            const int* dof = rows.columns.dof.data() + row.first;
            const T *cn = rows.columns.n.data() + row.first, *c1 = rows.columns.t1.data() + row.first,
                    *c2 = rows.columns.t2.data() + row.first;
            const auto row_of = [&](std::size_t c) { return paths_->row(static_cast<std::size_t>(dof[c])); };
            const std::size_t count = row.last - row.first;
            for (std::size_t a = 0; a < count; ++a) {
                const T slide = disc.d_1n * c1[a] + disc.d_2n * c2[a];
                for (std::size_t b = 0; b < count; ++b) {
                    T& h = b <= a ? h_[row_of(a) + b] : upper_[row_of(b) + a];
                    h = select(some, h + slide * cn[b], h);
                }
            }
        }
    }

    const DofPaths* paths_ = nullptr;
    bool coupled_ = false;
    // Packed by paths, lower triangle; to factor; coupled: upper triangle, transposed.
    std::vector<T> kept_, h_, upper_;
};

}  // namespace roboss
