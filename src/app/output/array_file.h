// Images and lists of numbers as files: PNG and NumPy.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "core/result.h"
#include "sensor_kinds/image.h"

namespace roboss {

/// Errors, also of the others: it cannot be written.
Result<> write_bytes(const std::string& file, const std::string& bytes);

/// A PNG file, 8 bits of each channel.
Result<> write_image(const std::string& file, const Image<std::uint8_t>& image);
/// A PNG file, 16 bits of grey.
Result<> write_image(const std::string& file, const Image<std::uint16_t>& image);
/// A PNG file, 16 bits of grey that count millimetres or, of an image in "K", hundredths of a kelvin; 0 where
/// a number is not finite.
Result<> write_image(const std::string& file, const Image<float>& image, const char* unit);

/// The start of a file of NumPy's format 1.0; `type` as "<f4".
std::string npy_header(const char* type, const std::vector<int>& shape);

/// The bytes of an array in NumPy's format.
template <class T>
std::string npy(const std::vector<int>& shape, const std::vector<T>& values) {
    const char* const type = std::is_same_v<T, double>  ? "<f8"
                             : std::is_same_v<T, float> ? "<f4"
                             : sizeof(T) == 2           ? "<u2"
                                                        : "|u1";
    std::string bytes = npy_header(type, shape);
    const std::size_t start = bytes.size();
    bytes.resize(start + values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(&bytes[start], values.data(), values.size() * sizeof(T));
    return bytes;
}

}  // namespace roboss
