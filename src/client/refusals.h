// What a Client reports of refused orders: each kind once.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"

namespace roboss {

class Refusals {
  public:
    /// A refused order; only the first of equal texts is kept, and no more than a hundred.
    void add_order(const Error& error) {
        constexpr std::size_t kTextsMost = 100;
        if (order_texts_.size() < kTextsMost && order_texts_.insert(error.text()).second)
            add("an order was refused: " + error.text());
    }
    void add(std::string text) { waiting_.push_back(std::move(text)); }
    /// Those since the last call.
    std::vector<std::string> take() { return std::exchange(waiting_, {}); }

  private:
    std::vector<std::string> waiting_;
    std::set<std::string> order_texts_;  // that were reported
};

}  // namespace roboss
