// Cells are cut along the diagonal from their lower left to their upper right corner: triangle 2 c is the
// lower right half of cell c, 2 c + 1 the upper left.
#include "geometry/height_field.h"

#include <algorithm>
#include <limits>

#include "core/check.h"
#include "core/fixed_math.h"
#include "core/hash.h"

namespace roboss {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

HeightField::HeightField(std::size_t columns, std::size_t rows, std::span<const double> heights,
                         double size_x, double size_y)
    : columns_(columns),
      rows_(rows),
      heights_(heights.begin(), heights.end()),
      size_x_(size_x),
      size_y_(size_y),
      x0_(-0.5 * size_x),
      y0_(-0.5 * size_y),
      dx_(size_x / static_cast<double>(columns - 1)),
      dy_(size_y / static_cast<double>(rows - 1)) {
    ROBOSS_CHECK(columns >= 2 && rows >= 2 && heights.size() == columns * rows,
                 "a height field needs a full grid");
    sides_ = SurfaceSides::kSolid;
    Hash hash;
    hash.add(static_cast<std::uint64_t>(columns_)), hash.add(static_cast<std::uint64_t>(rows_));
    hash.add(size_x), hash.add(size_y);
    hash.add(std::span<const double>(heights_));
    hash_ = hash.value();
    const auto [low, high] = std::minmax_element(heights_.begin(), heights_.end());
    box_.include(Vec3{x0_, y0_, *low});
    box_.include(Vec3{-x0_, -y0_, *high});
}

HeightField::Cells HeightField::cells_under(const Aabb& box) const {
    const auto cell = [](double x, double origin, double step, std::size_t nodes) {
        const double at = std::floor((x - origin) / step);
        return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(nodes - 2)));
    };
    return {cell(box.min.x, x0_, dx_, columns_), cell(box.max.x, x0_, dx_, columns_),
            cell(box.min.y, y0_, dy_, rows_), cell(box.max.y, y0_, dy_, rows_)};
}

void HeightField::query(const Aabb& box, std::vector<std::uint32_t>& out) const {
    out.clear();
    if (is_beside(box)) return;
    const Cells cells = cells_under(box);
    const double sliver = 1e-9 * dx_ * dy_;  // more than rounding: nothing slips through the diagonal
    for (std::size_t j = cells.j0; j <= cells.j1; ++j) {
        const double y = y0_ + dy_ * static_cast<double>(j), front = (box.min.y - y) * dx_,
                     back = (box.max.y - y) * dx_;
        for (std::size_t i = cells.i0; i <= cells.i1; ++i) {
            const double* h = &heights_[j * columns_ + i];
            const double across =
                std::max(h[0], h[columns_ + 1]);  // of the diagonal; what is below ground is in it
            const double x = x0_ + dx_ * static_cast<double>(i), left = (box.min.x - x) * dy_,
                         right = (box.max.x - x) * dy_;
            const auto number = static_cast<std::uint32_t>(2 * (j * (columns_ - 1) + i));
            // A body that has sunk below a cell may be nearest to either half.
            const bool sunk = box.max.z < std::min({h[0], h[1], h[columns_], h[columns_ + 1]});
            if (std::max(across, h[1]) >= box.min.z && (sunk || right >= front - sliver))
                out.push_back(number);
            if (std::max(across, h[columns_]) >= box.min.z && (sunk || back >= left - sliver))
                out.push_back(number + 1);
        }
    }
}

bool HeightField::may_overlap(const Aabb& box) const {
    constexpr std::size_t kMost = 64;  // cells that are worth a look
    if (is_beside(box) || box.min.z > box_.max.z) return false;
    const Cells cells = cells_under(box);
    if ((cells.i1 - cells.i0 + 1) * (cells.j1 - cells.j0 + 1) > kMost) return true;
    for (std::size_t j = cells.j0; j <= cells.j1; ++j)
        for (std::size_t i = cells.i0; i <= cells.i1; ++i)
            if (highest(i, j) >= box.min.z) return true;
    return false;
}

std::array<HeightField::Node, 3> HeightField::nodes(std::uint32_t number) const {
    // 32 bits: a division of 64 takes as long as the rest of a face.
    const auto width = static_cast<std::uint32_t>(columns_ - 1);
    const std::uint32_t cell = number / 2;
    const std::size_t i = cell % width, j = cell / width;
    if (number % 2 == 0) return {{{i, j}, {i + 1, j}, {i + 1, j + 1}}};
    return {{{i, j}, {i + 1, j + 1}, {i, j + 1}}};
}

SurfaceFace HeightField::face(std::uint32_t number) const {
    const std::array<Node, 3> at = nodes(number);
    SurfaceFace f;
    for (std::size_t k = 0; k < 3; ++k) f.v[k] = point(at[k].i, at[k].j);
    f.n = normalized(cross(f.v[1] - f.v[0], f.v[2] - f.v[0]));
    return f;
}

SurfaceTriangle HeightField::triangle(std::uint32_t number) const {
    const std::array<Node, 3> at = nodes(number);
    const SurfaceFace face = this->face(number);
    SurfaceTriangle t;
    t.v = face.v, t.n = face.n;
    const auto beyond = [&](std::size_t edge, bool known, std::size_t i, std::size_t j) {
        t.beyond[edge] = t.v[edge];
        t.fold[edge] = SurfaceTriangle::kBorder;
        if (!known) return;
        t.beyond[edge] = point(i, j);
        t.fold[edge] = fold_at(t.n, t.v[edge], t.v[(edge + 1) % 3], t.beyond[edge]);
    };
    const std::size_t i = at[0].i, j = at[0].j;
    if (number % 2 == 0) {
        beyond(0, j > 0, i, j - 1);
        beyond(1, i + 2 < columns_, i + 2, j + 1);
        beyond(2, true, i, j + 1);
    } else {
        beyond(0, true, i + 1, j);
        beyond(1, j + 2 < rows_, i + 1, j + 2);
        beyond(2, i > 0, i - 1, j);
    }
    return t;
}

bool HeightField::tops(std::uint32_t number, std::size_t corner, const Vec3& d, double tolerance) const {
    const Node at = nodes(number)[corner];
    const Vec3 p = point(at.i, at.j);
    constexpr int kRing[6][2] = {{-1, -1}, {0, -1}, {-1, 0}, {1, 0}, {0, 1}, {1, 1}};
    for (const auto& step : kRing) {
        const long i = static_cast<long>(at.i) + step[0], j = static_cast<long>(at.j) + step[1];
        if (i < 0 || j < 0 || i >= static_cast<long>(columns_) || j >= static_cast<long>(rows_)) continue;
        const Vec3 edge = point(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) - p;
        if (dot(d, edge) > tolerance * norm(edge)) return false;
    }
    return true;
}

double HeightField::ray_in_cell(std::size_t i, std::size_t j, const Vec3& origin,
                                const Vec3& direction) const {
    const Vec3 a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1), d = point(i, j + 1);
    return fixed_min(ray_triangle(origin, direction, {a, b, c}), ray_triangle(origin, direction, {a, c, d}));
}

// From cell to cell along the ray's shadow (Amanatides and Woo, "A Fast Voxel Traversal Algorithm", 1987).
double HeightField::ray(const Vec3& origin, const Vec3& direction, double limit) const {
    double enter = 0, leave = limit;
    for (std::size_t k = 0; k < 3; ++k) {
        const double low = box_.min[k] - 1e-9, high = box_.max[k] + 1e-9;
        if (std::fabs(direction[k]) < 1e-300) {
            if (origin[k] < low || origin[k] > high) return limit;
            continue;
        }
        const double a = (low - origin[k]) / direction[k], b = (high - origin[k]) / direction[k];
        enter = fixed_max(enter, fixed_min(a, b));
        leave = fixed_min(leave, fixed_max(a, b));
    }
    if (enter > leave) return limit;
    const Vec3 p = origin + direction * enter;
    const double fi = std::clamp(std::floor((p.x - x0_) / dx_), 0.0, static_cast<double>(columns_ - 2));
    const double fj = std::clamp(std::floor((p.y - y0_) / dy_), 0.0, static_cast<double>(rows_ - 2));
    auto i = static_cast<long>(fi), j = static_cast<long>(fj);
    const long si = direction.x < 0.0 ? -1 : 1, sj = direction.y < 0.0 ? -1 : 1;
    const auto crossing = [](double start, double d, double line) {
        return std::fabs(d) < 1e-300 ? kInfinity : (line - start) / d;
    };
    double nearest = limit;
    while (i >= 0 && j >= 0 && i + 1 < static_cast<long>(columns_) && j + 1 < static_cast<long>(rows_)) {
        nearest = fixed_min(nearest, ray_in_cell(static_cast<std::size_t>(i), static_cast<std::size_t>(j),
                                                 origin, direction));
        const double tx =
            crossing(origin.x, direction.x, x0_ + dx_ * static_cast<double>(si > 0 ? i + 1 : i));
        const double ty =
            crossing(origin.y, direction.y, y0_ + dy_ * static_cast<double>(sj > 0 ? j + 1 : j));
        const double next = fixed_min(tx, ty);
        if (!(next <= leave) || nearest <= next) break;
        if (tx <= ty)
            i += si;
        else
            j += sj;
    }
    return nearest;
}

}  // namespace roboss
