// PNG pictures as numbers. The only place that knows libpng.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"
#include "world/world.h"

namespace roboss {

struct GreyImage {
    std::size_t columns = 0, rows = 0;
    std::vector<double> values;  // 0 black .. 1 white; row by row from the top
};

/// 8 or 16 bits a channel; of a colour picture the red channel counts. Errors: no such file, no PNG, smaller
/// than 2 x 2 or larger than 8193 x 8193.
Result<GreyImage> read_png(const std::string& path);

struct ColourImage {
    std::size_t columns = 0, rows = 0;
    std::vector<std::uint8_t> samples;  // red, green, blue of each pixel; row by row from the top
};

/// The colours of a picture; samples of 8 bits as they stand in the file, transparent ones before black.
/// Errors as above.
Result<ColourImage> read_png_colours(const std::string& path);

/// Writes 8 bits a channel: 1 channel is grey, 3 are red, green and blue. Errors: it cannot be written.
Result<> write_png(const std::string& path, int columns, int rows, int channels,
                   const std::vector<std::uint8_t>& samples);
/// Writes 16 bits of grey, as they are.
Result<> write_png16(const std::string& path, int columns, int rows,
                     const std::vector<std::uint16_t>& samples);

/// A PNG file in memory, of 8 bits a channel as above; packed quickly rather than small.
Result<std::vector<std::uint8_t>> encode_png(int columns, int rows, int channels,
                                             const std::vector<std::uint8_t>& samples);

/// The colours of a picture of a visual. Errors: it is cut off or damaged, or of a kind that is not decoded
/// (WebP).
Result<ColourImage> decode_picture(const PictureSpec& picture);

}  // namespace roboss
