// L D L^T of a sparse symmetric matrix of blocks, by dense fronts (multifrontal method: Duff and Reid 1983;
// Davis, Direct Methods for Sparse Linear Systems, 2006). A front is factored in panels, by loops that fill
// the processor's registers. Subtrees of the fronts, and the rows of large fronts, are shared by the threads
// of a team; every number is the same sequence of operations for any number of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/block_pattern.h"
#include "core/team.h"

namespace roboss {

class BlockLdlt {
  public:
    /// Where a block of the matrix is written: entry (i, j) at `at[i * stride + j]`.
    struct Block {
        double* at = nullptr;
        std::size_t stride = 0;
    };

    /// What writes the matrix, front by front and from several threads: for the node at a position its blocks
    /// on and right of the diagonal. They are zero before.
    class Source {
      public:
        virtual void add_rows(std::size_t position, BlockLdlt& matrix) const = 0;

      protected:
        ~Source() = default;
    };

    /// `rows` of each node; the pattern outlives this. Fast where nothing changed.
    void lay_out(const BlockPattern& pattern, std::span<const std::size_t> rows);
    /// The rows of node `p` and the columns of `q`, which is `p` or coupled to it and eliminated later;
    /// positions. Of the diagonal block the upper triangle counts.
    Block block(std::size_t p, std::size_t q);
    /// Of the node's rows in x.
    std::size_t first_row(std::size_t node) const { return row_first_[node]; }
    std::size_t rows() const { return row_first_.empty() ? 0 : row_first_.back(); }

    /// x := A^-1 x. A pivot of at most `implied` counts as zero: the row follows from those before it, and x
    /// is zero there.
    void solve(const Source& source, std::span<double> x, double implied, const Team& team);

  private:
    struct Front {
        std::size_t own = 0, size = 0;  // rows eliminated here, rows
        std::size_t stride = 0;         // of the matrix: `size`, the right hand side, padded
        std::size_t matrix_at = 0;
        std::size_t offsets_at = 0;  // in offsets_: where the rows of its nodes and its ends begin
        std::size_t runs_first = 0, runs_last = 0;  // in runs_: where its ends lie in its parent
    };
    /// Rows of a front's ends that lie side by side in its parent's front, too.
    struct Run {
        std::size_t from = 0, to = 0, count = 0;
    };
    /// For one thread.
    struct Buffer {
        std::vector<double> factors;  // of a panel: its rows over their pivots
        std::vector<double> x;        // of a front
    };

    bool is_laid_out(const BlockPattern& pattern, std::span<const std::size_t> rows) const;
    void lay_out_front(std::size_t f);
    void find_runs(std::size_t f);
    void plan(const Team& team);
    void clear_rows(const Front& front, std::size_t first, std::size_t last);
    void start_rows(std::size_t f, std::size_t first, std::size_t last, const Source& source,
                    std::span<const double> x);
    void add_child(const Front& child, const Front& parent, std::size_t first, std::size_t last);
    void factor_front(std::size_t f, const Source& source, std::span<const double> x, double implied,
                      Buffer& buffer, Team team);
    void eliminate_square(const Front& front, std::size_t begin, std::size_t end, std::size_t edge,
                          double implied, Buffer& buffer);
    void solve_back(std::size_t f, std::span<double> x, Buffer& buffer) const;
    double* matrix_of(const Front& front) { return a_.data() + front.matrix_at; }

    const BlockPattern* pattern_ = nullptr;
    std::uint64_t stamp_ = 0;             // of the pattern when it was laid out
    std::vector<std::size_t> rows_;       // by node
    std::vector<std::size_t> row_first_;  // by node, and the end
    std::vector<Front> fronts_;           // as the pattern's
    std::vector<std::size_t> offsets_;
    std::vector<Run> runs_;
    std::vector<double> a_;
    std::vector<double> cost_;  // by front: of its subtree
    std::vector<std::size_t> subtrees_, top_,
        first_of_subtree_;         // fronts; what threads take, and what is left
    std::size_t planned_for_ = 0;  // threads
    std::vector<Buffer> buffers_;  // by thread
};

}  // namespace roboss
