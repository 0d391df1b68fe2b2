// Pictures for visuals as they stand in their files: kind and size are read from the header, nothing is
// decoded, so no decoder can be attacked here. Who draws them decodes them (the viewer's browser).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"
#include "world/world.h"

namespace roboss {

/// PNG, JPEG or WebP, by content and not by name. Errors: no such file, another kind, cut off, larger than
/// 32 MiB or 8192 x 8192 pixels.
Result<PictureSpec> read_picture(const std::string& path);

/// The same of a picture in memory; `source` is what messages call it.
Result<PictureSpec> picture_in(std::vector<std::uint8_t> bytes, std::string source);

}  // namespace roboss
