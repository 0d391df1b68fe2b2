// The tree of a robot's degrees of freedom, row by row: the path of i is every degree of freedom from the
// root down to i. Paths of ancestors are prefixes, so a matrix that couples only what lies on one path (mass
// matrix, its factors) is stored densely, a path a row, and its elimination runs over contiguous numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace roboss {

class DofPaths {
  public:
    DofPaths() = default;
    /// `parent` of each degree of freedom, lower than itself; -1 at a root.
    explicit DofPaths(std::span<const int> parent) {
        for (std::size_t i = 0; i < parent.size(); ++i) {
            if (parent[i] >= 0) {
                const auto p = static_cast<std::size_t>(parent[i]);
                for (std::size_t k = start_[p]; k < start_[p + 1]; ++k) dofs_.push_back(dofs_[k]);
            }
            dofs_.push_back(static_cast<int>(i));
            start_.push_back(dofs_.size());
        }
        trunk_ = trunk_of(parent);
    }

    /// Degrees of freedom.
    std::size_t size() const { return start_.size() - 1; }
    /// Entries of a packed matrix.
    std::size_t entries() const { return dofs_.size(); }
    /// Where row i begins; its entry k stands for column path(i)[k], the last one for the diagonal.
    std::size_t row(std::size_t i) const { return start_[i]; }
    std::size_t diagonal(std::size_t i) const { return start_[i + 1] - 1; }
    std::size_t length(std::size_t i) const { return start_[i + 1] - start_[i]; }
    /// The first path(i).size() numbers from here ascend from the root to i.
    const int* path(std::size_t i) const { return dofs_.data() + start_[i]; }

    /// Numbers 0 .. trunk() - 1 begin every later path: those of a free base, mostly.
    std::size_t trunk() const { return trunk_; }

  private:
    static std::size_t trunk_of(std::span<const int> parent) {
        std::size_t trunk = 0;
        while (trunk < parent.size() && parent[trunk] == static_cast<int>(trunk) - 1) ++trunk;
        for (std::size_t i = trunk; i < parent.size(); ++i)
            trunk = std::min(trunk, static_cast<std::size_t>(parent[i] + 1));
        return trunk;
    }

    std::vector<std::size_t> start_{0};
    std::vector<int> dofs_;
    std::size_t trunk_ = 0;
};

}  // namespace roboss
