// How a team factors the matrix of free bodies (BodyOrder): column by column, each by one thread, which takes
// the updates of the columns before it in the order of elimination. So each block sees the operations of a
// factorisation by one thread, in their order. Tasks are subtrees of the elimination tree, which depend on
// nothing outside, then the columns above them one by one, each as soon as those that it depends on are done
// (Geist and Ng 1989, Task scheduling for parallel sparse Cholesky factorization).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ready_flags.h"

namespace roboss {

class BodyOrder;

class FactorTasks {
  public:
    void plan(const BodyOrder& order, std::size_t threads);

    /// Claimed in ascending order: a task depends on earlier ones only.
    std::size_t count() const { return first_.empty() ? 0 : first_.size() - 1; }
    /// Pivots (BodyOrder::pivots), ascending.
    std::span<const std::uint32_t> pivots_of(std::size_t task) const {
        return std::span(sequence_).subspan(first_[task], first_[task + 1] - first_[task]);
    }

    /// An edge of an earlier pivot that ends at the column's body.
    struct Update {
        std::uint32_t pivot = 0, edge = 0;
    };
    /// Ascending.
    std::span<const Update> updates_of(std::size_t pivot) const {
        return std::span(updates_).subspan(first_update_[pivot],
                                           first_update_[pivot + 1] - first_update_[pivot]);
    }

    /// Which pivots are done in the factorisation that runs.
    ReadyFlags done;

  private:
    void list_updates(const BodyOrder& order);
    void weigh(const BodyOrder& order);
    void list_tasks(std::size_t threads);

    std::vector<std::uint32_t> sequence_, first_;
    std::vector<Update> updates_;
    std::vector<std::uint32_t> first_update_;
    std::vector<std::uint32_t> parents_;  // in the elimination tree; the number of pivots: none
    std::vector<double> weights_;         // of subtrees
    std::vector<std::uint32_t> task_of_;  // by pivot
    std::vector<std::uint32_t> roots_;    // of subtrees that are tasks
};

}  // namespace roboss
