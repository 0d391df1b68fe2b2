// libpng's simplified interface: no jumps over C++ frames. 16-bit samples are read as they are (linear),
// 8-bit ones too.
#include "mesh/image_file.h"

#include <png.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>

#include "mesh/jpeg_image.h"

namespace roboss {
namespace {

constexpr png_uint_32 kSideMax = 8193;

Error unreadable(const std::string& why) {
    return {"is no picture that can be read: " + why, "Save it as PNG, grey, 8 or 16 bits."};
}

/// Digital elevation models of geography come as TIFF, of either byte order.
bool is_tiff(const std::string& path) {
    char magic[4] = {};
    std::ifstream(path, std::ios::binary).read(magic, sizeof magic);
    return std::memcmp(magic, "II*\0", 4) == 0 || std::memcmp(magic, "MM\0*", 4) == 0;
}

/// Opens the picture and checks its size; nullopt: it can be read.
std::optional<Error> begin(const std::string& path, png_image& image) {
    if (is_tiff(path))
        return Error{
            "is a TIFF file, which is not read",
            "Convert it: gdal_translate -of PNG -ot UInt16 -scale FILE.tif FILE.png; heights then run from 0 "
            "to the z of <size>."};
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return unreadable(image.message);
    if (image.width < 2 || image.height < 2 || image.width > kSideMax || image.height > kSideMax) {
        const std::string size = std::to_string(image.width) + " x " + std::to_string(image.height);
        png_image_free(&image);
        return Error{"has " + size + " pixels",
                     "Give a picture from 2 x 2 to 8193 x 8193 pixels, usually 2^n + 1."};
    }
    return std::nullopt;
}

}  // namespace

Result<ColourImage> read_png_colours(const std::string& path) {
    png_image image;
    if (std::optional<Error> error = begin(path, image)) return *error;
    image.format = PNG_FORMAT_RGB;
    ColourImage out{image.width, image.height, {}};
    out.samples.resize(PNG_IMAGE_SIZE(image));
    const png_color black{0, 0, 0};
    if (png_image_finish_read(&image, &black, out.samples.data(), 0, nullptr) != 0) return out;
    const std::string why = image.message;
    png_image_free(&image);
    return unreadable(why);
}

namespace {

Result<> write_samples(const std::string& path, int columns, int rows, png_uint_32 format,
                       const void* samples) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(columns), image.height = static_cast<png_uint_32>(rows);
    image.format = format;
    if (png_image_write_to_file(&image, path.c_str(), 0, samples, 0, nullptr) != 0) return Ok{};
    const std::string why = image.message;
    png_image_free(&image);
    return Error{path + " cannot be written: " + why, "Check the folder, its permissions and the free space.",
                 "not-writable"};
}

}  // namespace

Result<> write_png(const std::string& path, int columns, int rows, int channels,
                   const std::vector<std::uint8_t>& samples) {
    return write_samples(path, columns, rows, channels == 3 ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY,
                         samples.data());
}

Result<std::vector<std::uint8_t>> encode_png(int columns, int rows, int channels,
                                             const std::vector<std::uint8_t>& samples) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(columns), image.height = static_cast<png_uint_32>(rows);
    image.format = channels == 3 ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
    image.flags = PNG_IMAGE_FLAG_FAST;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::uint8_t> bytes(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, samples.data(), 0, nullptr) != 0)
        return bytes.resize(size), bytes;
    const std::string why = image.message;
    png_image_free(&image);
    return Error{"a picture cannot be packed as PNG: " + why, "give it fewer pixels", "not-packed"};
}

Result<> write_png16(const std::string& path, int columns, int rows,
                     const std::vector<std::uint16_t>& samples) {
    return write_samples(path, columns, rows, PNG_FORMAT_LINEAR_Y, samples.data());
}

Result<ColourImage> decode_picture(const PictureSpec& picture) {
    if (picture.kind == PictureKind::kJpeg) return decode_jpeg(picture.bytes);
    if (picture.kind != PictureKind::kPng)
        return Error{"is of a kind that cameras do not show", "Save it as PNG.", "picture-kind"};
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, picture.bytes.data(), picture.bytes.size()) == 0)
        return unreadable(image.message);
    image.format = PNG_FORMAT_RGB;
    ColourImage out{image.width, image.height, {}};
    out.samples.resize(PNG_IMAGE_SIZE(image));
    const png_color white{255, 255, 255};
    if (png_image_finish_read(&image, &white, out.samples.data(), 0, nullptr) != 0) return out;
    const std::string why = image.message;
    png_image_free(&image);
    return unreadable(why);
}

Result<GreyImage> read_png(const std::string& path) {
    png_image image;
    if (std::optional<Error> error = begin(path, image)) return *error;
    const bool wide = (image.format & PNG_FORMAT_FLAG_LINEAR) != 0;
    const bool colour = (image.format & PNG_FORMAT_FLAG_COLOR) != 0;
    // Without alpha and gamma, every sample comes as it stands in the file.
    image.format = (wide ? PNG_FORMAT_FLAG_LINEAR : 0u) | (colour ? PNG_FORMAT_FLAG_COLOR : 0u);
    const std::size_t channels = colour ? 3 : 1, pixels = std::size_t{image.width} * image.height;
    GreyImage out{image.width, image.height, {}};
    out.values.resize(pixels);
    png_color black{0, 0, 0};
    const auto read = [&](auto& samples, double white) {
        samples.resize(pixels * channels);
        if (png_image_finish_read(&image, &black, samples.data(), 0, nullptr) == 0) return false;
        for (std::size_t i = 0; i < pixels; ++i)
            out.values[i] = static_cast<double>(samples[i * channels]) / white;
        return true;
    };
    std::vector<std::uint16_t> wide_samples;
    std::vector<std::uint8_t> samples;
    const bool ok = wide ? read(wide_samples, 65535.0) : read(samples, 255.0);
    if (!ok) {
        const std::string why = image.message;
        png_image_free(&image);
        return unreadable(why);
    }
    return out;
}

}  // namespace roboss
