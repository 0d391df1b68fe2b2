// PNG: ISO/IEC 15948 (chunks up to IEND). JPEG: ITU-T T.81, annex B (segments up to the scan, an end marker
// behind it). WebP: RFC 9649 (a RIFF file whose first chunk is VP8, VP8L or VP8X).
#include "mesh/picture_file.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace roboss {
namespace {

constexpr std::uintmax_t kBytesMax = 32u << 20;
constexpr std::uint32_t kSideMax = 8192;

struct Size {
    std::uint32_t width = 0, height = 0;  // 0: the bytes end before it is known
};

class Bytes {
  public:
    explicit Bytes(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
    std::size_t size() const { return bytes_.size(); }
    /// Beyond the end: 0.
    std::uint32_t at(std::size_t i) const { return i < bytes_.size() ? bytes_[i] : 0; }
    bool has(std::size_t i, std::string_view text) const {
        return i + text.size() <= bytes_.size() &&
               std::equal(text.begin(), text.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(i),
                          [](char c, std::uint8_t b) { return static_cast<std::uint8_t>(c) == b; });
    }
    std::uint32_t big(std::size_t i, std::size_t n) const {
        std::uint32_t value = 0;
        for (std::size_t k = 0; k < n; ++k) value = value << 8 | at(i + k);
        return value;
    }
    std::uint32_t little(std::size_t i, std::size_t n) const {
        std::uint32_t value = 0;
        for (std::size_t k = n; k-- > 0;) value = value << 8 | at(i + k);
        return value;
    }

  private:
    const std::vector<std::uint8_t>& bytes_;
};

Size png_size(const Bytes& b) {
    Size size;
    for (std::size_t i = 8; i + 12 <= b.size(); i += 12 + std::size_t{b.big(i, 4)}) {
        if (b.has(i + 4, "IHDR")) size = {b.big(i + 8, 4), b.big(i + 12, 4)};
        if (b.has(i + 4, "IEND")) return size;
    }
    return {};
}

Size jpeg_size(const Bytes& b) {
    Size size;
    for (std::size_t i = 2; i + 4 <= b.size() && b.at(i) == 0xFF; i += 2 + std::size_t{b.big(i + 2, 2)}) {
        while (b.at(i + 1) == 0xFF) ++i;  // padding
        const std::uint32_t marker = b.at(i + 1);
        const bool frame =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (frame) size = {b.big(i + 7, 2), b.big(i + 5, 2)};
        if (marker != 0xDA) continue;
        for (std::size_t end = b.size(); end-- > i;)
            if (b.at(end) == 0xFF && b.at(end + 1) == 0xD9) return size;
        return {};
    }
    return {};
}

Size webp_size(const Bytes& b) {
    if (b.size() < 30 || b.size() - 8 < b.little(4, 4)) return {};
    if (b.has(12, "VP8X")) return {1 + b.little(24, 3), 1 + b.little(27, 3)};
    if (b.has(12, "VP8L")) return {1 + (b.little(21, 4) & 0x3FFF), 1 + (b.little(21, 4) >> 14 & 0x3FFF)};
    if (b.has(12, "VP8 ")) return {b.little(26, 2) & 0x3FFF, b.little(28, 2) & 0x3FFF};
    return {};
}

Error too_large() {
    return {"is larger than 32 MiB", "Save it with fewer pixels."};
}

}  // namespace

Result<PictureSpec> read_picture(const std::string& path) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) return Error{"cannot be read: " + error.message(), "Check that it is a file and may be read."};
    if (size > kBytesMax) return too_large();
    std::ifstream in(path, std::ios::binary);
    std::vector<std::uint8_t> bytes(size);
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!in) return Error{"cannot be read", "Check that it is a file and may be read."};
    return picture_in(std::move(bytes), path);
}

Result<PictureSpec> picture_in(std::vector<std::uint8_t> bytes, std::string source) {
    if (bytes.size() > kBytesMax) return too_large();
    PictureSpec picture{std::move(source), PictureKind::kPng, 0, 0, std::move(bytes)};
    const Bytes b(picture.bytes);
    Size size;
    if (b.has(0, "\x89PNG\r\n\x1A\n")) {
        size = png_size(b);
    } else if (b.has(0, "\xFF\xD8\xFF")) {
        picture.kind = PictureKind::kJpeg;
        size = jpeg_size(b);
    } else if (b.has(0, "RIFF") && b.has(8, "WEBP")) {
        picture.kind = PictureKind::kWebp;
        size = webp_size(b);
    } else {
        return Error{"is no picture that browsers show", "Save it as PNG, JPEG or WebP."};
    }
    if (size.width == 0 || size.height == 0) return Error{"is damaged or cut off", "Save it anew."};
    if (size.width > kSideMax || size.height > kSideMax)
        return Error{"has " + std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels",
                     "Give a picture of at most 8192 x 8192 pixels."};
    picture.width = size.width;
    picture.height = size.height;
    return picture;
}

}  // namespace roboss
