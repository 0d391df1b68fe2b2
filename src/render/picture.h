// Picture: a texture with smaller copies of itself, so that what is far away does not glitter. Values are
// linear: the square of what the file says (a screen shows about that much light).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/result.h"
#include "world/world.h"

namespace roboss::render {

class Picture {
  public:
    /// `rgb`: 3 * columns * rows samples, rows from the top; neither is 0.
    Picture(std::size_t columns, std::size_t rows, const std::vector<std::uint8_t>& rgb);

    /// Linear colour at (u, v), in pictures from the lower left corner; it repeats. `width`: of what one ray
    /// stands for, in pictures.
    Vec3 at(double u, double v, double width) const;
    std::size_t columns() const { return levels_.front().columns; }
    std::size_t rows() const { return levels_.front().rows; }

  private:
    struct Level {
        std::size_t columns = 0, rows = 0;
        std::vector<float> rgb;
    };
    static Vec3 blend(const Level& level, double u, double v);
    std::vector<Level> levels_;  // each half of the one before
};

/// Decodes the bytes of a picture (mesh/image_file.h does).
using DecodePicture = std::function<Result<Picture>(const PictureSpec&)>;

}  // namespace roboss::render
