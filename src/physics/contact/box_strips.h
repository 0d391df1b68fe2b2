// All pairs of boxes that overlap, for the broad phase: boxes sorted by strips along y, and by x within a
// strip, so that a box can overlap those of its own strip and of the next ones only. A box far wider than the
// others makes one strip of all, which is a plain sweep along x.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "math/aabb.h"

namespace roboss {

class BoxStrips {
  public:
    /// act(i, j) once for each pair of boxes that overlap, in any order. Boxes may be infinite.
    template <class Act>
    void for_each_overlap(std::span<const Aabb> boxes, Act&& act) {
        sort(boxes);
        std::size_t other = 0;  // first entry of the next strip that may still be met
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            const Entry& entry = entries_[i];
            const Aabb& box = sorted_[i];
            const auto meet_from = [&](std::size_t j, std::int64_t strip) {
                for (; j < entries_.size() && entries_[j].strip == strip && sorted_[j].min.x <= box.max.x;
                     ++j)
                    if (overlaps(box, sorted_[j])) act(entry.box, entries_[j].box);
            };
            meet_from(i + 1, entry.strip);
            const auto is_behind = [&](const Entry& e) {
                return e.strip <= entry.strip ||
                       (e.strip == entry.strip + 1 && e.min_x < entry.min_x - widest_);
            };
            while (other < entries_.size() && is_behind(entries_[other])) ++other;
            meet_from(other, entry.strip + 1);
        }
    }

  private:
    void sort(std::span<const Aabb> boxes) {
        double wide_y = 1e-6, largest = 0;
        widest_ = 0;
        for (const Aabb& box : boxes) {
            widest_ = std::max(widest_, box.max.x - box.min.x);
            wide_y = std::max(wide_y, box.max.y - box.min.y);
            largest = std::max(largest, std::fabs(box.min.y));
        }
        const double width = std::max(wide_y, 1e-12 * largest);
        const auto strip_of = [&](const Aabb& box) {
            const double strip = std::floor(box.min.y / width);
            return std::fabs(strip) < 1e15 ? static_cast<std::int64_t>(strip) : 0;
        };
        entries_.clear(), sorted_.clear();
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            entries_.push_back({strip_of(boxes[i]), boxes[i].min.x, i});
        std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
            return a.strip != b.strip ? a.strip < b.strip : a.min_x < b.min_x;
        });
        for (const Entry& entry : entries_) sorted_.push_back(boxes[entry.box]);
    }

    struct Entry {
        std::int64_t strip = 0;  // along y, as wide as the widest box
        double min_x = 0;
        std::uint32_t box = 0;
    };
    std::vector<Entry> entries_;
    std::vector<Aabb> sorted_;  // the entries' boxes
    double widest_ = 0;         // along x
};

}  // namespace roboss
