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

Result<std::vector<std::uint8_t>> encode_jpeg(int columns, int rows, int channels,
                                              const std::vector<std::uint8_t>& samples, int quality) {
    const std::unique_ptr<void, decltype(&tjDestroy)> encoder(tjInitCompress(), &tjDestroy);
    const bool grey = channels == 1;
    const int sampling = grey ? TJSAMP_GRAY : TJSAMP_420;
    std::vector<std::uint8_t> bytes(tjBufSize(columns, rows, sampling));
    unsigned char* place = bytes.data();
    unsigned long size = bytes.size();
    const int result =
        !encoder ? -1
                 : tjCompress2(encoder.get(), samples.data(), columns, 0, rows, grey ? TJPF_GRAY : TJPF_RGB,
                               &place, &size, sampling, quality, TJFLAG_NOREALLOC | TJFLAG_FASTDCT);
    if (result != 0) return Error{"a picture cannot be packed as JPEG", "give it fewer pixels", "not-packed"};
    bytes.resize(size);
    return bytes;
}

}  // namespace roboss
