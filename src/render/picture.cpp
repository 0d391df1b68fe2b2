// See picture.h.
#include "render/picture.h"

#include <algorithm>
#include <cmath>

namespace roboss::render {

Picture::Picture(std::size_t columns, std::size_t rows, const std::vector<std::uint8_t>& rgb) {
    ROBOSS_CHECK(columns > 0 && rows > 0 && rgb.size() == 3 * columns * rows, "three samples for each pixel");
    Level first{columns, rows, std::vector<float>(rgb.size())};
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const float share = static_cast<float>(rgb[i]) / 255.0F;
        first.rgb[i] = share * share;
    }
    levels_.push_back(std::move(first));
    while (levels_.back().columns > 1 || levels_.back().rows > 1) {
        const Level& from = levels_.back();
        Level to{std::max<std::size_t>(1, from.columns / 2), std::max<std::size_t>(1, from.rows / 2), {}};
        to.rgb.resize(3 * to.columns * to.rows);
        for (std::size_t r = 0; r < to.rows; ++r)
            for (std::size_t c = 0; c < to.columns; ++c)
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::size_t r1 = std::min(2 * r + 1, from.rows - 1), r0 = std::min(2 * r, r1);
                    const std::size_t c1 = std::min(2 * c + 1, from.columns - 1), c0 = std::min(2 * c, c1);
                    const auto sample = [&](std::size_t row, std::size_t column) {
                        return from.rgb[3 * (row * from.columns + column) + k];
                    };
                    to.rgb[3 * (r * to.columns + c) + k] =
                        0.25F * ((sample(r0, c0) + sample(r0, c1)) + (sample(r1, c0) + sample(r1, c1)));
                }
        levels_.push_back(std::move(to));
    }
}

Vec3 Picture::blend(const Level& level, double u, double v) {
    const auto columns = static_cast<double>(level.columns), rows = static_cast<double>(level.rows);
    const double x = (u - std::floor(u)) * columns - 0.5, y = (1 - (v - std::floor(v))) * rows - 0.5;
    const double x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
    const auto wrapped = [](double at, std::size_t count) {
        const auto n = static_cast<std::int64_t>(count);
        const std::int64_t i = static_cast<std::int64_t>(at) % n;
        return static_cast<std::size_t>(i < 0 ? i + n : i);
    };
    const std::size_t c0 = wrapped(x0, level.columns), c1 = wrapped(x0 + 1, level.columns);
    const std::size_t r0 = wrapped(y0, level.rows), r1 = wrapped(y0 + 1, level.rows);
    const auto pixel = [&](std::size_t r, std::size_t c) {
        const float* p = &level.rgb[3 * (r * level.columns + c)];
        return Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
    };
    const Vec3 top = pixel(r0, c0) * (1 - fx) + pixel(r0, c1) * fx;
    const Vec3 bottom = pixel(r1, c0) * (1 - fx) + pixel(r1, c1) * fx;
    return top * (1 - fy) + bottom * fy;
}

Vec3 Picture::at(double u, double v, double width) const {
    if (!(std::fabs(u) < 1e9 && std::fabs(v) < 1e9)) return {};
    double texels = width * static_cast<double>(std::max(columns(), rows()));
    std::size_t level = 0;
    while (texels > 1.5 && level + 1 < levels_.size()) texels *= 0.5, ++level;
    return blend(levels_[level], u, v);
}

}  // namespace roboss::render
