// A hashed grid.
#include "schedule/box_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace roboss {

namespace {

constexpr std::int64_t kCellsMost = 16;  // of one box
constexpr float kFarthest = 1e9f;        // cells; what is beyond, or no number, is compared with all
constexpr std::size_t kTestsEach = 64;   // so many a box, and a Sweep would have been done

}  // namespace

struct BoxGrid::Cells {
    std::int32_t left = 0, right = 0, bottom = 0, top = 0;
    bool few = false;
    Cells(const Box32& box, float cells_per_m) {
        const float edges[] = {box.min[0] * cells_per_m, box.max[0] * cells_per_m, box.min[1] * cells_per_m,
                               box.max[1] * cells_per_m};
        for (const float edge : edges)
            if (!(std::fabs(edge) < kFarthest)) return;
        left = static_cast<std::int32_t>(std::floor(edges[0]));
        right = static_cast<std::int32_t>(std::floor(edges[1]));
        bottom = static_cast<std::int32_t>(std::floor(edges[2]));
        top = static_cast<std::int32_t>(std::floor(edges[3]));
        const std::int64_t columns = std::int64_t{right} - left + 1, rows = std::int64_t{top} - bottom + 1;
        few = columns > 0 && rows > 0 && columns <= kCellsMost && rows <= kCellsMost &&
              columns * rows <= kCellsMost;
    }
};

void BoxGrid::reset(std::span<const OwnedBox> like) {
    boxes_.clear(), large_.clear(), sizes_.clear();
    links_.assign(1, {});
    first_.assign(std::bit_ceil(2 * like.size() + 1), 0);
    tests_left_ = kTestsEach * like.size();
    for (const OwnedBox& b : like)
        sizes_.push_back(std::max(b.box.max[0] - b.box.min[0], b.box.max[1] - b.box.min[1]));
    std::erase_if(sizes_, [](float size) { return !(size > 0) || !std::isfinite(size); });
    overwhelmed_ = sizes_.empty();
    if (overwhelmed_) return;
    // nine of ten boxes are not larger than a cell
    const auto tenth = sizes_.end() - 1 - static_cast<std::ptrdiff_t>(sizes_.size() / 10);
    std::nth_element(sizes_.begin(), tenth, sizes_.end());
    cells_per_m_ = 1 / *tenth;
}

std::uint32_t& BoxGrid::first_in(std::int32_t x, std::int32_t y) {
    const std::uint32_t hash =
        static_cast<std::uint32_t>(x) * 73856093u ^ static_cast<std::uint32_t>(y) * 19349663u;
    return first_[(hash ^ hash >> 15) & (first_.size() - 1)];
}

bool BoxGrid::meets(const OwnedBox& box, std::uint32_t other, UnionFind& sets) {
    const OwnedBox& b = boxes_[other];
    if (tests_left_ > 0) --tests_left_;
    return box.owner != b.owner && overlaps(box.box, b.box) && sets.unite(box.owner, b.owner);
}

std::size_t BoxGrid::add(const OwnedBox& box, UnionFind& sets) {
    overwhelmed_ = overwhelmed_ || tests_left_ == 0;
    if (overwhelmed_) return 0;
    const Cells cells(box.box, cells_per_m_);
    const auto here = static_cast<std::uint32_t>(boxes_.size());
    std::size_t unions = 0;
    if (!cells.few) {
        for (std::uint32_t other = 0; other < here; ++other) unions += meets(box, other, sets) ? 1 : 0;
        large_.push_back(here);
        boxes_.push_back(box);
        return unions;
    }
    for (const std::uint32_t other : large_) unions += meets(box, other, sets) ? 1 : 0;
    boxes_.push_back(box);
    for (std::int32_t y = cells.bottom; y <= cells.top; ++y)
        for (std::int32_t x = cells.left; x <= cells.right; ++x) {
            std::uint32_t& first = first_in(x, y);
            for (std::uint32_t link = first; link != 0; link = links_[link].next)
                unions += meets(box, links_[link].box, sets) ? 1 : 0;
            links_.push_back({here, first});
            first = static_cast<std::uint32_t>(links_.size() - 1);
        }
    return unions;
}

}  // namespace roboss
