// TouchWatch: whether robots of two islands came near each other in a window, found while results arrive, so
// that the answer is known with the last of them. In the rare case of a touch, a Sweep finds the robots.
#pragma once

#include "schedule/box_grid.h"
#include "schedule/islands.h"

namespace roboss {

class TouchWatch {
  public:
    /// Begins a window of these islands. Its boxes are expected to resemble those of the last window.
    void begin(const Islands& islands);
    /// Where a robot was; it may have several boxes, one of them `last`.
    void add(const OwnedBox& box, bool last);
    void stop() { missing_ = kNever; }
    /// No two islands touched. False: some may have, or robots are missing.
    bool all_apart() const { return missing_ == 0 && touches_ == 0 && (one_ || !grid_.overwhelmed()); }

  private:
    static constexpr std::size_t kNever = ~std::size_t{0};

    BoxGrid grid_;
    UnionFind sets_;
    std::vector<OwnedBox> boxes_;  // of this window and, until it begins, of the one before
    std::size_t touches_ = 0, missing_ = kNever;
    bool one_ = false;  // island only: nobody to touch
};

inline void TouchWatch::begin(const Islands& islands) {
    sets_.reset(islands.robots.size());
    for (std::size_t i = 0; i < islands.count(); ++i)
        for (const RobotId robot : islands.of(i)) sets_.unite(islands.of(i).front().value, robot.value);
    one_ = islands.count() <= 1;
    grid_.reset(boxes_);
    boxes_.clear();
    touches_ = 0;
    missing_ = islands.robots.size();
}

inline void TouchWatch::add(const OwnedBox& box, bool last) {
    if (missing_ == kNever) return;
    boxes_.push_back(box);
    if (!one_) touches_ += grid_.add(box, sets_);
    if (last) --missing_;
}

}  // namespace roboss
