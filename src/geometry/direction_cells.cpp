// The directions of a cell are the convex combinations of those at its four corners. So a vertex that another
// one surpasses at all four corners is surpassed in the whole cell, and left out; cells are divided into four
// again and again, each part beginning with what was left of the whole. No vertex is left out by less than
// what rounding can do, so the furthest one to the last bit is always among the rest.
#include "geometry/direction_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace roboss {
namespace {

constexpr std::size_t kFew = 32;  // vertices: up to here a scan of all of them is as fast
constexpr std::size_t kVerticesMax = 65536;
constexpr std::size_t kBlock =
    4;  // vertices that are looked at together; a cell's last one fills up its last block
constexpr double kLeast = 1e-280, kMost = 1e280;  // directions beyond have rounding errors of their own
constexpr double kRoundingMargin = 1e-13;  // of the size of the body: some fifty times what rounding does

/// Of one side of the cube. A direction is (1 or -1, u, v) from the axis on.
class Side {
  public:
    Side(std::span<const Vec3> vertices, double margin, std::size_t axis, double sign, std::size_t along)
        : vertices_(vertices),
          margin_(margin),
          axis_(axis),
          sign_(sign),
          along_(along),
          found_(along * along) {
        std::vector<std::uint16_t> all(vertices.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint16_t>(i);
        divide(0, 0, along, all);
    }
    /// By cell: those that may be the furthest.
    std::span<const std::vector<std::uint16_t>> found() const { return found_; }

  private:
    using Corners = std::array<double, 4>;

    Vec3 direction(std::size_t i, std::size_t j) const {
        const auto place = [&](std::size_t k) {
            return 2.0 * static_cast<double>(k) / static_cast<double>(along_) - 1.0;
        };
        Vec3 d;
        d[axis_] = sign_, d[(axis_ + 1) % 3] = place(i), d[(axis_ + 2) % 3] = place(j);
        return d;
    }

    /// The cells i .. i + size - 1, j .. j + size - 1.
    void divide(std::size_t i, std::size_t j, std::size_t size,
                const std::vector<std::uint16_t>& candidates) {
        const std::array<Vec3, 4> corners{direction(i, j), direction(i, j + size), direction(i + size, j),
                                          direction(i + size, j + size)};
        std::vector<std::uint16_t> left = without_surpassed(candidates, corners);
        if (size == 1) {
            found_[i * along_ + j] = std::move(left);
            return;
        }
        const std::size_t half = size / 2;
        for (const std::size_t di : {std::size_t{0}, half})
            for (const std::size_t dj : {std::size_t{0}, half}) divide(i + di, j + dj, half, left);
    }

    std::vector<std::uint16_t> without_surpassed(const std::vector<std::uint16_t>& candidates,
                                                 const std::array<Vec3, 4>& corners) const {
        std::vector<Corners> reach(candidates.size());
        for (std::size_t k = 0; k < reach.size(); ++k)
            for (std::size_t c = 0; c < 4; ++c) reach[k][c] = dot(corners[c], vertices_[candidates[k]]);
        const std::vector<Corners> rivals = furthest_within(reach);
        std::vector<std::uint16_t> left;
        for (std::size_t k = 0; k < reach.size(); ++k) {
            const bool surpassed = std::ranges::any_of(rivals, [&](const Corners& rival) {
                bool all = true;
                for (std::size_t c = 0; c < 4; ++c) all = all && rival[c] > reach[k][c] + margin_;
                return all;
            });
            if (!surpassed) left.push_back(candidates[k]);
        }
        return left;
    }

    /// The furthest ones along a few directions of the cell.
    static std::vector<Corners> furthest_within(const std::vector<Corners>& reach) {
        constexpr std::size_t kSteps = 2;
        std::vector<Corners> found;
        for (std::size_t a = 0; a <= kSteps; ++a) {
            for (std::size_t b = 0; b <= kSteps; ++b) {
                const double u = static_cast<double>(a) / kSteps, v = static_cast<double>(b) / kSteps;
                const Corners weight{(1 - u) * (1 - v), (1 - u) * v, u * (1 - v), u * v};
                const auto at = [&](const Corners& r) {
                    return weight[0] * r[0] + weight[1] * r[1] + weight[2] * r[2] + weight[3] * r[3];
                };
                found.push_back(*std::ranges::max_element(reach, {}, at));
            }
        }
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

    std::span<const Vec3> vertices_;
    double margin_;
    std::size_t axis_;
    double sign_;
    std::size_t along_;
    std::vector<std::vector<std::uint16_t>> found_;
};

}  // namespace

std::uint32_t furthest_of_all(const Vec3& d, std::span<const Vec3> vertices) {
    std::uint32_t best = 0;
    double most = dot(d, vertices[0]);
    for (std::uint32_t i = 1; i < vertices.size(); ++i) {
        const double x = dot(d, vertices[i]);
        const bool is_further = x > most;  // no branch: it would be guessed wrong
        most = is_further ? x : most;
        best = is_further ? i : best;
    }
    return best;
}

void DirectionCells::build(std::span<const Vec3> vertices) {
    *this = {};
    const std::size_t count = vertices.size();
    if (count <= kFew || count > kVerticesMax) return;
    along_ = count <= 400 ? 8 : 16;
    double size = 0;
    for (const Vec3& v : vertices) size = std::max(size, norm(v));
    first_.push_back(0);
    for (std::size_t side = 0; side < 6; ++side) {
        const Side cells(vertices, kRoundingMargin * size, side / 2, side % 2 == 0 ? 1.0 : -1.0, along_);
        for (const std::vector<std::uint16_t>& cell : cells.found()) {
            numbers_.insert(numbers_.end(), cell.begin(), cell.end());
            while (numbers_.size() % kBlock != 0) numbers_.push_back(cell.back());
            first_.push_back(static_cast<std::uint32_t>(numbers_.size()));
        }
    }
}

/// The sizes of d's components: finite numbers. Without branches, which would be guessed wrong.
std::size_t DirectionCells::cell_of(const Vec3& d, const Vec3& sizes) const {
    const auto [x, y, z] = sizes;
    // The axis of the largest component, by (y > x) + 2 (z > x) + 4 (z > y); two of these cannot be.
    constexpr std::array<unsigned char, 8> kAxis{0, 1, 2, 1, 0, 1, 2, 2};
    const std::size_t axis = kAxis[static_cast<std::size_t>(y > x) + 2 * static_cast<std::size_t>(z > x) +
                                   4 * static_cast<std::size_t>(z > y)];
    const std::array<double, 5> along{d.x, d.y, d.z, d.x, d.y};
    const double half = 0.5 * static_cast<double>(along_), scale = half / std::fabs(along[axis]);
    const auto place = [&](double w) {
        const auto cell = static_cast<std::size_t>(static_cast<int>(w * scale + half));
        return std::min(cell, along_ - 1);
    };
    const std::size_t side = 2 * axis + static_cast<std::size_t>(std::signbit(along[axis]));
    return (side * along_ + place(along[axis + 1])) * along_ + place(along[axis + 2]);
}

std::uint32_t DirectionCells::furthest(const Vec3& d, std::span<const Vec3> vertices) const {
    const Vec3 sizes{std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)};
    const double sum = sizes.x + sizes.y + sizes.z;
    if (first_.empty() || !(sum > kLeast && sum < kMost)) return furthest_of_all(d, vertices);
    const std::size_t cell = cell_of(d, sizes);
    const std::uint16_t *at = numbers_.data() + first_[cell], *const end = numbers_.data() + first_[cell + 1];
    std::uint32_t best = at[0];
    double most = -HUGE_VAL;
    do {  // mostly once
        const double a = dot(d, vertices[at[0]]), b = dot(d, vertices[at[1]]), c = dot(d, vertices[at[2]]),
                     e = dot(d, vertices[at[3]]);
        const double ab = b > a ? b : a, ce = e > c ? e : c;
        const std::uint32_t of_ab = at[b > a ? 1 : 0], of_ce = at[e > c ? 3 : 2];
        const double abce = ce > ab ? ce : ab;
        const std::uint32_t of_abce = ce > ab ? of_ce : of_ab;
        best = abce > most ? of_abce : best;
        most = abce > most ? abce : most;
        at += kBlock;
    } while (at != end);
    return best;
}

}  // namespace roboss
