// The order of minimum degree for a sparse elimination (George and Liu 1989, The evolution of the minimum
// degree ordering algorithm): what is coupled to the fewest others goes next, and those become coupled to
// each other. Ties go to the lowest number. Buffers are kept from one graph to the next.
#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace roboss {

class MinimumDegree {
  public:
    /// A graph of `count` nodes that nothing couples yet.
    void begin(std::size_t count);
    /// Couples two different nodes; once more does nothing.
    void join(int a, int b);
    /// Orders all nodes. False, and some are left out, if the pairs of nodes that are coupled to a third one
    /// when it goes become more than `most_pairs` in all: the work of a factorisation.
    bool eliminate(std::size_t most_pairs = std::numeric_limits<std::size_t>::max());

    /// Nodes as they are eliminated.
    const std::vector<int>& order() const { return order_; }
    /// When a node is eliminated.
    const std::vector<int>& position() const { return position_; }
    /// What the node eliminated at `position` is coupled to by then, ascending: [first, last) of ends().
    std::pair<std::size_t, std::size_t> ends_of(std::size_t position) const {
        return {first_[position], first_[position + 1]};
    }
    const std::vector<int>& ends() const { return ends_; }

  private:
    std::vector<int> order_, position_, degree_;
    std::vector<std::size_t> first_;
    std::vector<int> ends_;
    std::vector<std::vector<int>> near_;  // by node: neighbours left, ascending
    std::vector<int> merged_;
    std::vector<std::pair<int, int>> queue_;  // (degree, node), a heap; outdated entries are skipped
};

}  // namespace roboss
