// Images as readings have them.
#pragma once

#include <cstddef>
#include <vector>

namespace roboss {

/// Rows from the top, within a row pixels from the left, within a pixel its channels. A new one is empty.
template <class T>
struct Image {
    int rows = 0, columns = 0, channels = 1;  ///< its shape
    std::vector<T> samples;                   ///< rows * columns * channels of them

    /// Without samples.
    Image() = default;
    /// Of r rows, c columns and n channels; all samples are `value`.
    Image(int r, int c, int n, T value = T{})
        : rows(r),
          columns(c),
          channels(n),
          samples(static_cast<std::size_t>(r) * static_cast<std::size_t>(c) * static_cast<std::size_t>(n),
                  value) {}
    /// Whether it has no samples: the sensor does not measure it.
    bool empty() const { return samples.empty(); }
    /// Compares all members.
    friend bool operator==(const Image&, const Image&) = default;
};

}  // namespace roboss
