// JPEG pictures as numbers: baseline and extended sequential (ITU-T T.81), by code of our own, so that the
// colours have the same bits everywhere.
#pragma once

#include <cstdint>
#include <span>

#include "mesh/image_file.h"

namespace roboss {

/// Colours of a picture with one (grey) or three components of 8 bits. Errors: it is damaged, progressive or
/// of another kind, or larger than 8192 x 8192.
Result<ColourImage> decode_jpeg(std::span<const std::uint8_t> bytes);

}  // namespace roboss
