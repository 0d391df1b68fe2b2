// See decompress.h.
#include "bags/decompress.h"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace roboss::bags {

namespace {

/// A step of a decompressor.
struct Progress {
    std::size_t read = 0, written = 0;  // bytes
    bool at_frame_end = false;
    const char* problem = nullptr;
};

Error bad(const std::string& compression, const std::string& what) {
    return {"its bytes in " + compression + " " + what, "record it again, or repair it (`mcap recover`)",
            "bad-compression"};
}

/// `step(packed, room)` unpacks a part of what is left into what room there is.
template <class Step>
Result<std::vector<std::uint8_t>> unpack(const std::string& compression, Bytes packed, std::size_t size,
                                         Step step) {
    constexpr std::size_t kFirst = std::size_t{1} << 16;
    std::vector<std::uint8_t> bytes;
    std::size_t filled = 0;
    for (bool ended = size == 0; !packed.empty() || !ended;) {
        if (filled == bytes.size()) bytes.resize(std::min(size + 1, std::max(kFirst, 2 * filled)));
        const Progress done = step(packed, std::span(bytes).subspan(filled));
        if (done.problem != nullptr) return bad(compression, std::string("are damaged: ") + done.problem);
        packed = packed.subspan(done.read);
        filled += done.written;
        ended = done.at_frame_end;
        if (filled > size)
            return bad(compression, "are more than the " + std::to_string(size) + " announced");
        if (done.read == 0 && done.written == 0 && !ended) return bad(compression, "end too early");
    }
    if (filled != size)
        return bad(compression,
                   "are " + std::to_string(filled) + ", not the " + std::to_string(size) + " announced");
    bytes.resize(size);
    return bytes;
}

Result<std::vector<std::uint8_t>> unpack_zstd(Bytes packed, std::size_t size) {
    const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
    if (!context) return bad("zstd", "need more memory than there is");
    return unpack("zstd", packed, size, [&](Bytes from, std::span<std::uint8_t> to) -> Progress {
        ZSTD_inBuffer in{from.data(), from.size(), 0};
        ZSTD_outBuffer out{to.data(), to.size(), 0};
        const std::size_t more = ZSTD_decompressStream(context.get(), &out, &in);
        if (ZSTD_isError(more) != 0) return {0, 0, false, ZSTD_getErrorName(more)};
        return {in.pos, out.pos, more == 0, nullptr};
    });
}

Result<std::vector<std::uint8_t>> unpack_lz4(Bytes packed, std::size_t size) {
    LZ4F_dctx* made = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0)
        return bad("lz4", "need more memory than there is");
    const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
        made, &LZ4F_freeDecompressionContext);
    return unpack("lz4", packed, size, [&](Bytes from, std::span<std::uint8_t> to) -> Progress {
        std::size_t read = from.size(), written = to.size();
        const std::size_t more =
            LZ4F_decompress(context.get(), to.data(), &written, from.data(), &read, nullptr);
        if (LZ4F_isError(more) != 0) return {0, 0, false, LZ4F_getErrorName(more)};
        return {read, written, more == 0, nullptr};
    });
}

}  // namespace

Result<std::vector<std::uint8_t>> decompressed(const std::string& compression, Bytes packed,
                                               std::size_t size) {
    if (compression == "zstd") return unpack_zstd(packed, size);
    if (compression == "lz4") return unpack_lz4(packed, size);
    return Error{"it is compressed by '" + compression + "', which is not known here",
                 "write it with zstd, lz4 or without compression", "unknown-compression"};
}

}  // namespace roboss::bags
