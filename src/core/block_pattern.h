// The symbolic part of a sparse factorisation of a symmetric matrix of blocks: in which order its nodes (rows
// and columns that belong together) are eliminated, and which of them share a dense front (Duff and Reid
// 1983; Liu 1992, The multifrontal method for sparse matrix solution). It depends on the couplings alone, and
// is shared by all factorisations with these.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/minimum_degree.h"

namespace roboss {

class BlockPattern {
  public:
    /// Nodes that are eliminated together, and the later ones that they are coupled to by then. Nodes by
    /// position: as they are eliminated.
    struct Front {
        std::size_t first = 0, last = 0;                    // its nodes are first .. last - 1
        std::size_t ends_first = 0, ends_last = 0;          // in ends(), ascending
        std::size_t children_first = 0, children_last = 0;  // in children()
        int parent = -1;                                    // -1: a root
    };

    /// For `count` nodes, coupled in pairs. In the order of minimum degree; nodes that would be fronts of a
    /// few rows join the next one where that adds few zeros.
    void analyse(std::size_t count, std::span<const std::pair<int, int>> couplings);

    /// Of this analysis: no other has the same in this process. What is laid out by a pattern compares it.
    std::uint64_t stamp() const { return stamp_; }
    std::size_t size() const { return position_.size(); }
    bool empty() const { return position_.empty(); }
    std::size_t position(std::size_t node) const { return position_[node]; }
    std::size_t node(std::size_t position) const { return node_[position]; }
    /// Of the node at a position.
    std::size_t front_of(std::size_t position) const { return front_of_[position]; }
    /// Every front comes after its children.
    std::span<const Front> fronts() const { return fronts_; }
    std::span<const std::size_t> ends_of(const Front& front) const {
        return std::span(ends_).subspan(front.ends_first, front.ends_last - front.ends_first);
    }
    std::span<const std::size_t> children_of(const Front& front) const {
        return std::span(children_).subspan(front.children_first, front.children_last - front.children_first);
    }

  private:
    void sort_tree();
    void visit(std::size_t root);
    void gather_ends();
    void merge_fronts();
    bool joins(const Front& front, std::size_t zeros, std::size_t position, std::size_t& more) const;
    void list_children();

    MinimumDegree elimination_;
    std::uint64_t stamp_ = 0;
    std::vector<std::size_t> position_, node_, front_of_;
    std::vector<Front> fronts_;
    std::vector<std::size_t> ends_, children_;
    // The elimination tree, by position in the order of minimum degree
    std::vector<int> parent_;
    std::vector<std::size_t> first_child_, child_, next_;
    std::vector<std::size_t> stack_;
    // Of single nodes, by position
    std::vector<std::size_t> all_ends_, all_first_;
};

}  // namespace roboss
