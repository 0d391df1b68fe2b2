// See block_ldlt.h.
#include "physics/sparse/block_ldlt.h"

#include <algorithm>

#include "physics/sparse/front_kernel.h"

namespace roboss {
namespace {

// Multiplications that make it worth waking other threads: for the whole, for the rows of one front.
constexpr double kShareFrom = 1e6, kShareRowsFrom = 3e5;
constexpr double kSubtreesPerThread = 4;

std::size_t padded(std::size_t count) {
    return (count + kFrontLanes - 1) / kFrontLanes * kFrontLanes;
}

}  // namespace

bool BlockLdlt::is_laid_out(const BlockPattern& pattern, std::span<const std::size_t> rows) const {
    return stamp_ == pattern.stamp() && std::ranges::equal(rows_, rows);
}

void BlockLdlt::lay_out(const BlockPattern& pattern, std::span<const std::size_t> rows) {
    pattern_ = &pattern;
    if (is_laid_out(pattern, rows)) return;
    stamp_ = pattern.stamp();
    rows_.assign(rows.begin(), rows.end());
    row_first_.assign(1, 0);
    for (const std::size_t count : rows) row_first_.push_back(row_first_.back() + count);
    fronts_.assign(pattern.fronts().size(), {});
    offsets_.clear(), runs_.clear();
    std::size_t size = 0;
    for (std::size_t f = 0; f < fronts_.size(); ++f) {
        lay_out_front(f);
        fronts_[f].matrix_at = size;
        size += fronts_[f].size * fronts_[f].stride;
    }
    for (std::size_t f = 0; f < fronts_.size(); ++f) find_runs(f);
    a_.resize(size);
    planned_for_ = 0;
}

void BlockLdlt::lay_out_front(std::size_t f) {
    const BlockPattern::Front& shape = pattern_->fronts()[f];
    Front& front = fronts_[f];
    front.offsets_at = offsets_.size();
    const auto add = [&](std::size_t position) {
        offsets_.push_back(front.size);
        front.size += rows_[pattern_->node(position)];
    };
    for (std::size_t position = shape.first; position < shape.last; ++position) add(position);
    front.own = front.size;
    for (const std::size_t position : pattern_->ends_of(shape)) add(position);
    front.stride = padded(front.size + 1);
}

void BlockLdlt::find_runs(std::size_t f) {
    const BlockPattern::Front& shape = pattern_->fronts()[f];
    Front& front = fronts_[f];
    front.runs_first = front.runs_last = runs_.size();
    if (shape.parent < 0) return;
    const auto parent = static_cast<std::size_t>(shape.parent);
    const BlockPattern::Front& above = pattern_->fronts()[parent];
    const auto ends = pattern_->ends_of(shape), ends_above = pattern_->ends_of(above);
    const std::size_t* offsets = offsets_.data() + fronts_[parent].offsets_at;
    const std::size_t own = shape.last - shape.first, own_above = above.last - above.first;
    std::size_t at = 0;
    for (std::size_t e = 0; e < ends.size(); ++e) {
        std::size_t to = ends[e] - above.first;
        if (ends[e] >= above.last) {
            while (ends_above[at] != ends[e]) ++at;
            to = own_above + at;
        }
        const std::size_t from = offsets_[front.offsets_at + own + e];
        const std::size_t count = rows_[pattern_->node(ends[e])];
        if (runs_.size() > front.runs_first && runs_.back().to + runs_.back().count == offsets[to])
            runs_.back().count += count;
        else
            runs_.push_back({from, offsets[to], count});
    }
    front.runs_last = runs_.size();
}

BlockLdlt::Block BlockLdlt::block(std::size_t p, std::size_t q) {
    const std::size_t f = pattern_->front_of(p);
    const BlockPattern::Front& shape = pattern_->fronts()[f];
    std::size_t column = q - shape.first;
    if (q >= shape.last) {
        const auto ends = pattern_->ends_of(shape);
        column = shape.last - shape.first +
                 static_cast<std::size_t>(std::ranges::lower_bound(ends, q) - ends.begin());
    }
    const Front& front = fronts_[f];
    const std::size_t* offsets = offsets_.data() + front.offsets_at;
    return {matrix_of(front) + offsets[p - shape.first] * front.stride + offsets[column], front.stride};
}

/// Which subtrees threads take whole: large ones are split until there are a few for each.
void BlockLdlt::plan(const Team& team) {
    if (planned_for_ == team.size()) return;
    planned_for_ = team.size();
    const auto shapes = pattern_->fronts();
    cost_.assign(fronts_.size(), 0.0);
    first_of_subtree_.resize(fronts_.size());
    subtrees_.clear(), top_.clear();
    double all = 0;
    for (std::size_t f = 0; f < fronts_.size(); ++f) {
        const double size = static_cast<double>(fronts_[f].size),
                     left = size - static_cast<double>(fronts_[f].own);
        cost_[f] += (size * size * size - left * left * left) / 6;
        first_of_subtree_[f] = f;
        for (const std::size_t child : pattern_->children_of(shapes[f]))
            first_of_subtree_[f] = std::min(first_of_subtree_[f], first_of_subtree_[child]);
        if (shapes[f].parent >= 0) {
            cost_[static_cast<std::size_t>(shapes[f].parent)] += cost_[f];
        } else {
            subtrees_.push_back(f);
            all += cost_[f];
        }
    }
    if (team.size() > 1 && all >= kShareFrom) {
        const auto cheaper = [&](std::size_t a, std::size_t b) { return cost_[a] < cost_[b]; };
        const double most = all / (kSubtreesPerThread * static_cast<double>(team.size()));
        std::ranges::make_heap(subtrees_, cheaper);
        while (!subtrees_.empty() && cost_[subtrees_.front()] > most) {
            std::ranges::pop_heap(subtrees_, cheaper);
            const std::size_t f = subtrees_.back();
            subtrees_.pop_back();
            top_.push_back(f);
            for (const std::size_t child : pattern_->children_of(shapes[f])) {
                subtrees_.push_back(child);
                std::ranges::push_heap(subtrees_, cheaper);
            }
        }
        std::ranges::sort(subtrees_, [&](std::size_t a, std::size_t b) {
            return cost_[a] != cost_[b] ? cost_[a] > cost_[b] : a < b;
        });
        std::ranges::sort(top_);
    }
    if (buffers_.size() < team.size()) buffers_.resize(team.size());
    std::size_t largest = 0;
    for (const Front& front : fronts_) largest = std::max(largest, front.stride);
    for (Buffer& buffer : buffers_) buffer.factors.resize(kFrontPanel * largest), buffer.x.resize(largest);
}

/// Rows `first` .. `last` - 1 become zero, from the vector that holds the diagonal.
void BlockLdlt::clear_rows(const Front& front, std::size_t first, std::size_t last) {
    double* a = matrix_of(front);
    for (std::size_t r = first; r < last; ++r)
        std::fill(a + r * front.stride + r / kFrontLanes * kFrontLanes, a + (r + 1) * front.stride, 0.0);
}

/// Everything of a cleared front's nodes at positions `first` .. `last` - 1 but what its children give.
void BlockLdlt::start_rows(std::size_t f, std::size_t first, std::size_t last, const Source& source,
                           std::span<const double> x) {
    const BlockPattern::Front& shape = pattern_->fronts()[f];
    const Front& front = fronts_[f];
    double* a = matrix_of(front);
    for (std::size_t p = first; p < last; ++p) {
        source.add_rows(p, *this);
        const std::size_t node = pattern_->node(p);
        double* side = a + offsets_[front.offsets_at + p - shape.first] * front.stride + front.size;
        for (std::size_t i = 0; i < rows_[node]; ++i) side[i * front.stride] = x[row_first_[node] + i];
    }
}

/// What is left of the matrix and of the right hand side, of the ends' rows `first` .. `last` - 1.
void BlockLdlt::add_child(const Front& child, const Front& parent, std::size_t first, std::size_t last) {
    const auto runs = std::span(runs_).subspan(child.runs_first, child.runs_last - child.runs_first);
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const std::size_t begin = std::max(runs[r].from, first),
                          end = std::min(runs[r].from + runs[r].count, last);
        for (std::size_t i = begin; i < end; ++i) {
            const double* from = matrix_of(child) + i * child.stride;
            double* to = matrix_of(parent) + (runs[r].to + i - runs[r].from) * parent.stride;
            for (std::size_t j = i; j < runs[r].from + runs[r].count; ++j)
                to[runs[r].to + j - runs[r].from] += from[j];
            for (const Run& run : runs.subspan(r + 1))
                for (std::size_t j = 0; j < run.count; ++j) to[run.to + j] += from[run.from + j];
            to[parent.size] += from[child.size];
        }
    }
}

/// Eliminates rows `begin` .. `end` - 1 among themselves, in their own columns and those up to `edge`; the
/// rest of the front follows by the factors that this leaves.
void BlockLdlt::eliminate_square(const Front& front, std::size_t begin, std::size_t end, std::size_t edge,
                                 double implied, Buffer& buffer) {
    double* a = matrix_of(front);
    const std::size_t stride = front.stride;
    for (std::size_t c = begin; c < end; ++c) {
        double* pivot = a + c * stride;
        double* factors = buffer.factors.data() + (c - begin) * stride;
        if (!(pivot[c] > implied)) {
            std::fill(pivot + c, pivot + edge, 0.0);
            std::fill(factors + c, factors + edge, 0.0);
            continue;
        }
        const double inverse = 1.0 / pivot[c];
        pivot[c] = inverse;
        for (std::size_t r = c + 1; r < edge; ++r) factors[r] = pivot[r] * inverse;
        for (std::size_t r = c + 1; r < end; ++r) {
            double* __restrict row = a + r * stride;
            const double f = factors[r];
            for (std::size_t j = r; j < edge; ++j) row[j] -= f * pivot[j];
        }
    }
}

/// Large ones with the rows shared by the team.
void BlockLdlt::factor_front(std::size_t f, const Source& source, std::span<const double> x, double implied,
                             Buffer& buffer, Team team) {
    const BlockPattern::Front& shape = pattern_->fronts()[f];
    const Front& front = fronts_[f];
    const double size = static_cast<double>(front.size);
    if (size * size * static_cast<double>(front.own) < kShareRowsFrom) team = {};
    const auto share = [&](std::size_t begin, std::size_t end, std::size_t unit, const auto& work) {
        const std::size_t most = (end - begin) / (4 * team.size());
        team.run_blocks(end - begin, std::max((most + unit - 1) / unit * unit, unit),
                        [&](std::size_t first, std::size_t last) { work(begin + first, begin + last); });
    };
    share(0, front.size, kFrontLanes,
          [&](std::size_t first, std::size_t last) { clear_rows(front, first, last); });
    share(shape.first, shape.last, 4,
          [&](std::size_t first, std::size_t last) { start_rows(f, first, last, source, x); });
    for (const std::size_t child : pattern_->children_of(shape))
        share(fronts_[child].own, fronts_[child].size, kFrontLanes,
              [&](std::size_t first, std::size_t last) { add_child(fronts_[child], front, first, last); });
    const FrontKernel& kernel = front_kernel();
    double* matrix = matrix_of(front);
    double* factors = buffer.factors.data();
    for (std::size_t begin = 0; begin < front.own; begin += kFrontPanel) {
        const std::size_t end = std::min(front.own, begin + kFrontPanel), edge = padded(end);
        eliminate_square(front, begin, end, edge, implied, buffer);
        share(edge, front.stride, kFrontLanes, [&](std::size_t first, std::size_t last) {
            kernel.eliminate(matrix, front.stride, begin, end - begin, first, last, factors);
        });
        share(end, front.size, kFrontLanes, [&](std::size_t first, std::size_t last) {
            kernel.subtract(matrix, front.stride, first, last, front.stride, matrix + begin * front.stride,
                            factors, end - begin);
        });
    }
}

void BlockLdlt::solve_back(std::size_t f, std::span<double> x, Buffer& buffer) const {
    const BlockPattern::Front& shape = pattern_->fronts()[f];
    const Front& front = fronts_[f];
    const std::size_t* offsets = offsets_.data() + front.offsets_at;
    const std::size_t own = shape.last - shape.first;
    const auto ends = pattern_->ends_of(shape);
    double* local = buffer.x.data();
    std::fill(local, local + front.stride, 0.0);
    for (std::size_t e = 0; e < ends.size(); ++e) {
        const std::size_t node = pattern_->node(ends[e]);
        std::copy_n(x.data() + row_first_[node], rows_[node], local + offsets[own + e]);
    }
    const FrontKernel& kernel = front_kernel();
    const double* a = a_.data() + front.matrix_at;
    for (std::size_t c = front.own; c-- > 0;) {
        const double* row = a + c * front.stride;
        const std::size_t begin = c / kFrontLanes * kFrontLanes;  // what is before c is zero in `local` yet
        local[c] = (row[front.size] - kernel.dot(row + begin, local + begin, front.stride - begin)) * row[c];
    }
    for (std::size_t p = 0; p < own; ++p) {
        const std::size_t node = pattern_->node(shape.first + p);
        std::copy_n(local + offsets[p], rows_[node], x.data() + row_first_[node]);
    }
}

void BlockLdlt::solve(const Source& source, std::span<double> x, double implied, const Team& team) {
    plan(team);
    const auto each_of = [&](std::size_t root, const auto& work) {
        for (std::size_t f = first_of_subtree_[root]; f <= root; ++f) work(f);
    };
    team.run_in_order(
        subtrees_.size(), [&](std::size_t item, std::size_t worker) {  // the most expensive first
            each_of(subtrees_[item],
                    [&](std::size_t f) { factor_front(f, source, x, implied, buffers_[worker], {}); });
        });
    for (const std::size_t f : top_) factor_front(f, source, x, implied, buffers_[0], team);
    for (std::size_t i = top_.size(); i-- > 0;) solve_back(top_[i], x, buffers_[0]);
    team.run_in_order(subtrees_.size(), [&](std::size_t item, std::size_t worker) {
        const std::size_t root = subtrees_[item];
        for (std::size_t f = root + 1; f-- > first_of_subtree_[root];) solve_back(f, x, buffers_[worker]);
    });
}

}  // namespace roboss
