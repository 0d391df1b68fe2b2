// See front_factor.h; front_analysis.cpp makes the fronts.
#include "physics/solver/front_factor.h"

#include <algorithm>

#include "core/pair.h"

namespace roboss {
namespace {

/// row -= f * pivot, from `from` or one before it.
void subtract(double* row, const double* pivot, double f, std::size_t from, std::size_t stride) {
    for (std::size_t j = from & ~std::size_t{1}; j < stride; j += 2)
        put(row + j, pair_at(row + j) - both(f) * pair_at(pivot + j));
}

}  // namespace

void FrontFactor::clear() {
    kept_.assign(a_.size(), 0.0);
}

FrontFactor::Place FrontFactor::place_in(std::vector<double>& matrices, std::size_t clique) const {
    const Front& front = fronts_[static_cast<std::size_t>(clique_front_[clique])];
    return {matrices.data() + front.matrix_at, front.stride, local_.data() + clique_first_[clique],
            std::span(runs_).subspan(run_first_[clique], run_first_[clique + 1] - run_first_[clique])};
}

FrontFactor::Place FrontFactor::place(std::size_t clique) {
    return place_in(kept_, clique);
}

FrontFactor::Place FrontFactor::unsymmetric_place(std::size_t clique) {
    return place_in(a_, clique);
}

void FrontFactor::add(std::size_t group, int unknown, double value) {
    const std::size_t i = own_place(group, unknown);
    kept_[fronts_[group].matrix_at + i * fronts_[group].stride + i] += value;
}

void FrontFactor::add(std::size_t group, const DofPaths& paths, std::span<const double> matrix) {
    const std::size_t stride = fronts_[group].stride;
    double* to = kept_.data() + fronts_[group].matrix_at;
    for (std::size_t i = 0; i < paths.size(); ++i)
        where_[i] = static_cast<int>(own_place(group, group_first_[group] + static_cast<int>(i)));
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const int* path = paths.path(i);
        const double* row = matrix.data() + paths.row(i);
        for (std::size_t k = 0; k < paths.length(i); ++k) {
            const auto [a, b] = std::minmax(where_[i], where_[static_cast<std::size_t>(path[k])]);
            to[static_cast<std::size_t>(a) * stride + static_cast<std::size_t>(b)] += row[k];
        }
    }
}

void FrontFactor::begin_factor(bool symmetric) {
    symmetric_ = symmetric;
    std::copy(kept_.begin(), kept_.end(), a_.begin());
    if (symmetric) return;
    for (const Front& front : fronts_) {
        double* a = a_.data() + front.matrix_at;
        for (std::size_t r = 1; r < front.size; ++r)
            for (std::size_t c = 0; c < r; ++c) a[r * front.stride + c] = a[c * front.stride + r];
    }
}

/// Own rows become those of D L^T, the reciprocals of D on the diagonal; what remains is the Schur complement
/// of the others.
void FrontFactor::eliminate(const Front& front) {
    double* a = a_.data() + front.matrix_at;
    const std::size_t stride = front.stride;
    for (std::size_t c = 0; c < front.own; ++c) {
        double* pivot = a + c * stride;
        const double inverse = 1.0 / pivot[c];
        pivot[c] = inverse;
        for (std::size_t r = c + 1; r < front.size; ++r) {
            const double f = pivot[r] * inverse;
            if (f != 0) subtract(a + r * stride, pivot, f, r, stride);
        }
    }
}

/// The same for the rows of U in L U.
bool FrontFactor::eliminate_general(const Front& front) {
    double* a = a_.data() + front.matrix_at;
    const std::size_t stride = front.stride;
    for (std::size_t c = 0; c < front.own; ++c) {
        double* pivot = a + c * stride;
        if (!(pivot[c] != 0)) return false;  // nor not a number
        const double inverse = 1.0 / pivot[c];
        pivot[c] = inverse;
        for (std::size_t r = c + 1; r < front.size; ++r) {
            double* row = a + r * stride;
            const double f = row[c] * inverse;
            if (f != 0) subtract(row, pivot, f, c + 1, stride);
        }
    }
    return true;
}

/// What is left of the matrix and of the right hand side.
void FrontFactor::add_to_parent(const Front& front) {
    const Front& parent = fronts_[static_cast<std::size_t>(front.parent)];
    const double* a = a_.data() + front.matrix_at;
    double* to = a_.data() + parent.matrix_at;
    const int* map = to_parent_.data() + front.update_at;
    for (std::size_t i = front.own; i < front.size; ++i) {
        double* row = to + static_cast<std::size_t>(map[i - front.own]) * parent.stride;
        const double* from = a + i * front.stride;
        for (std::size_t j = symmetric_ ? i : front.own; j < front.size; ++j)
            row[map[j - front.own]] += from[j];
        row[parent.size] += from[front.size];
    }
}

void FrontFactor::solve_back(const Front& front, std::span<double> x) {
    const double* a = a_.data() + front.matrix_at;
    const int* index = index_.data() + front.index_at;
    const auto at = [&](std::size_t i) -> double& { return x[static_cast<std::size_t>(index[i])]; };
    for (std::size_t i = front.own; i < front.size; ++i) x_[i] = at(i);
    for (std::size_t c = front.own; c-- > 0;) {
        const double* row = a + c * front.stride;
        double value = row[front.size];
        // The youngest unknown comes last: what it does not reach can be summed before it is known.
        for (std::size_t j = front.size; j-- > c + 1;) value -= row[j] * x_[j];
        x_[c] = at(c) = value * row[c];
    }
}

bool FrontFactor::solve(std::span<double> x) {
    for (std::size_t g = 0; g < groups_; ++g) {
        const Front& front = fronts_[g];
        double* side = a_.data() + front.matrix_at + front.size;
        const int* index = index_.data() + front.index_at;
        for (std::size_t i = 0; i < front.own; ++i)
            side[i * front.stride] = x[static_cast<std::size_t>(index[i])];
    }
    for (int g : order_) {
        const Front& front = fronts_[static_cast<std::size_t>(g)];
        if (symmetric_)
            eliminate(front);
        else if (!eliminate_general(front))
            return false;
        if (front.parent >= 0) add_to_parent(front);
    }
    for (std::size_t k = order_.size(); k-- > 0;) solve_back(fronts_[static_cast<std::size_t>(order_[k])], x);
    return true;
}

}  // namespace roboss
