// JPEG pictures as numbers. The only place that knows libjpeg-turbo.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/image_file.h"

namespace roboss {

/// Colours of a JPEG picture, baseline or progressive, grey or coloured. The same bits with every instruction
/// set: its accurate inverse cosine transform is exact. Errors: it is damaged, of four inks (CMYK), or larger
/// than 8192 x 8192.
Result<ColourImage> decode_jpeg(std::span<const std::uint8_t> bytes);

/// A JPEG file of 8 bits a channel: 1 channel is grey, 3 are red, green and blue. `quality`: 1 to 100.
Result<std::vector<std::uint8_t>> encode_jpeg(int columns, int rows, int channels,
                                              const std::vector<std::uint8_t>& samples, int quality);

}  // namespace roboss
