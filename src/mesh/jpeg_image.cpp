// TurboJPEG's interface: no jumps over C++ frames. Its warnings (stray bytes, a missing end) are passed over,
// as browsers do.
#include "mesh/jpeg_image.h"

#include <turbojpeg.h>

#include <memory>
#include <string>

namespace roboss {
namespace {

constexpr int kSideMax = 8192;

Error undecodable(const std::string& why) {
    return {"is a JPEG picture that cannot be decoded: " + why,
            "Save it anew as JPEG or PNG, in red, green and blue.", "picture-kind"};
}

}  // namespace

Result<ColourImage> decode_jpeg(std::span<const std::uint8_t> bytes) {
    const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), &tjDestroy);
    if (!decoder) return undecodable("out of memory");
    const auto size = static_cast<unsigned long>(bytes.size());
    int columns = 0, rows = 0, sampling = 0, colours = 0;
    const auto failed = [&](int result) {
        return result != 0 && tjGetErrorCode(decoder.get()) == TJERR_FATAL;
    };
    if (failed(tjDecompressHeader3(decoder.get(), bytes.data(), size, &columns, &rows, &sampling, &colours)))
        return undecodable(tjGetErrorStr2(decoder.get()));
    if (columns > kSideMax || rows > kSideMax)
        return undecodable(std::to_string(columns) + " x " + std::to_string(rows) + " pixels are too many");
    if (colours == TJCS_CMYK || colours == TJCS_YCCK)
        return undecodable("its colours are those of four inks");
    ColourImage out{static_cast<std::size_t>(columns), static_cast<std::size_t>(rows), {}};
    out.samples.resize(3 * out.columns * out.rows);
    if (failed(tjDecompress2(decoder.get(), bytes.data(), size, out.samples.data(), columns, 0, rows,
                             TJPF_RGB, TJFLAG_ACCURATEDCT)))
        return undecodable(tjGetErrorStr2(decoder.get()));
    return out;
}

}  // namespace roboss
