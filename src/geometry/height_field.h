// HeightField: ground given by heights on a regular grid, two triangles a cell; triangles are made when they
// are asked for. Solid below.
#pragma once

#include <algorithm>
#include <span>

#include "geometry/triangle_surface.h"

namespace roboss {

class HeightField final : public TriangleSurface {
  public:
    /// `heights` (m) row by row, x growing within a row, y from row to row; centred on the origin, `size_x`
    /// by `size_y` metres. At least 2 columns and 2 rows.
    HeightField(std::size_t columns, std::size_t rows, std::span<const double> heights, double size_x,
                double size_y);

    std::size_t triangle_count() const override { return 2 * (columns_ - 1) * (rows_ - 1); }
    void query(const Aabb& box, std::vector<std::uint32_t>& out) const override;
    bool may_overlap(const Aabb& box) const override;
    SurfaceTriangle triangle(std::uint32_t number) const override;
    SurfaceFace face(std::uint32_t number) const override;
    bool tops(std::uint32_t number, std::size_t corner, const Vec3& d, double tolerance) const override;
    double ray(const Vec3& origin, const Vec3& direction, double limit) const override;
    bool is_ground() const override { return true; }
    SurfaceSource source() const override {
        return HeightSource{columns_, rows_, heights_, size_x_, size_y_};
    }

  private:
    struct Cells {
        std::size_t i0 = 0, i1 = 0, j0 = 0, j1 = 0;  // both ends included
    };
    Cells cells_under(const Aabb& box) const;
    bool is_beside(const Aabb& box) const {
        return box.max.x < box_.min.x || box.min.x > box_.max.x || box.max.y < box_.min.y ||
               box.min.y > box_.max.y;
    }
    double highest(std::size_t i, std::size_t j) const {
        const double* h = &heights_[j * columns_ + i];
        return std::max({h[0], h[1], h[columns_], h[columns_ + 1]});
    }
    struct Node {
        std::size_t i = 0, j = 0;
    };
    Vec3 point(std::size_t i, std::size_t j) const {
        return {x0_ + dx_ * static_cast<double>(i), y0_ + dy_ * static_cast<double>(j),
                heights_[j * columns_ + i]};
    }
    std::array<Node, 3> nodes(std::uint32_t number) const;
    double ray_in_cell(std::size_t i, std::size_t j, const Vec3& origin, const Vec3& direction) const;

    std::size_t columns_, rows_;
    std::vector<double> heights_;
    double size_x_, size_y_, x0_, y0_, dx_, dy_;
};

}  // namespace roboss
