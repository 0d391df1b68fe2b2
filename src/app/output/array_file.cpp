// See array_file.h.
#include "app/output/array_file.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "mesh/image_file.h"

namespace roboss {

Result<> write_bytes(const std::string& file, const std::string& bytes) {
    std::ofstream out(file, std::ios::binary);
    if (out << bytes && out.flush()) return Ok{};
    return Error{file + " cannot be written", "check the folder, its permissions and the free space",
                 "not-writable"};
}

Result<> write_image(const std::string& file, const Image<std::uint8_t>& image) {
    return write_png(file, image.columns, image.rows, image.channels, image.samples);
}

Result<> write_image(const std::string& file, const Image<std::uint16_t>& image) {
    return write_png16(file, image.columns, image.rows, image.samples);
}

Result<> write_image(const std::string& file, const Image<float>& image, const char* unit) {
    constexpr double kMillimetre = 0.001, kHundredthOfKelvin = 0.01, kMost = 65535;
    const double one = std::strcmp(unit, "K") == 0 ? kHundredthOfKelvin : kMillimetre;
    std::vector<std::uint16_t> counts;
    for (const float value : image.samples) {
        const double count = std::floor(static_cast<double>(value) / one + 0.5);
        counts.push_back(std::isfinite(count) && count > 0
                             ? static_cast<std::uint16_t>(std::fmin(count, kMost))
                             : std::uint16_t{0});
    }
    return write_png16(file, image.columns, image.rows, counts);
}

std::string npy_header(const char* type, const std::vector<int>& shape) {
    std::string sizes;
    for (const int size : shape) sizes += fmt::format("{}, ", size);
    std::string header =
        fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, sizes);
    constexpr std::size_t kPrefix = 10, kAligned = 64;
    header.append(kAligned - (kPrefix + header.size() + 1) % kAligned, ' ');
    header += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(header.size() & 0xFF);
    bytes += static_cast<char>(header.size() >> 8);
    return bytes + header;
}

}  // namespace roboss
