// What a Client reports of refused orders: each kind once.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "core/similar.h"

namespace roboss {

class Refusals {
  public:
    /// A refused order. Of equal texts only the first is kept, and no more than a hundred texts. Texts that
    /// differ in names and numbers, as those of the robots of one pattern, make one line.
    void add_order(const Error& error) {
        constexpr std::size_t kTextsMost = 100;
        if (order_texts_.size() >= kTextsMost || !order_texts_.insert(error.text()).second) return;
        for (Kind& kind : kinds_)
            if (kind.pattern == pattern_of(error.message)) {
                ++kind.more;
                return;
            }
        kinds_.push_back({pattern_of(error.message), error, 0});
    }
    void add(std::string text) { waiting_.push_back(std::move(text)); }
    /// Those since the last call.
    std::vector<std::string> take() {
        for (Kind& kind : std::exchange(kinds_, {})) {
            if (kind.more > 0) kind.first.message += " (and " + std::to_string(kind.more) + " more like it)";
            add("an order was refused: " + kind.first.text());
        }
        return std::exchange(waiting_, {});
    }

  private:
    struct Kind {
        std::string pattern;
        Error first;
        int more = 0;
    };

    std::vector<std::string> waiting_;
    std::vector<Kind> kinds_;            // since the last call of take()
    std::set<std::string> order_texts_;  // that were reported
};

}  // namespace roboss
