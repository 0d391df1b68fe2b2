// PNG pictures as grey values. The only place that knows libpng.
#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace roboss {

struct GreyImage {
    std::size_t columns = 0, rows = 0;
    std::vector<double> values;  // 0 black .. 1 white; row by row from the top
};

/// 8 or 16 bits a channel; of a colour picture the red channel counts. Errors: no such file, no PNG, smaller
/// than 2 x 2 or larger than 8193 x 8193.
Result<GreyImage> read_png(const std::string& path);

}  // namespace roboss
