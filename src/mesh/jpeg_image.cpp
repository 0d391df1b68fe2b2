// Markers, Huffman codes, dequantization and the inverse cosine transform, in this order. Section numbers are
// those of ITU-T T.81.
#include "mesh/jpeg_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/fixed_math.h"

namespace roboss {
namespace {

constexpr std::size_t kBlock = 64;  // samples of a block of 8 x 8
constexpr std::array<std::uint8_t, kBlock> kZigzag{
    0,  1,  8,  16, 9,  2,  3,  10, 17, 24, 32, 25, 18, 11, 4,  5,  12, 19, 26, 33, 40, 48,
    41, 34, 27, 20, 13, 6,  7,  14, 21, 28, 35, 42, 49, 56, 57, 50, 43, 36, 29, 22, 15, 23,
    30, 37, 44, 51, 58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63};

/// Codes by length (annex C); `first` and `place`: of the codes of a length.
struct HuffmanTable {
    std::array<int, 17> count{}, first{}, place{};
    std::vector<std::uint8_t> values;

    void number_codes() {
        int code = 0, at = 0;
        for (std::size_t length = 1; length <= 16; ++length) {
            first[length] = code, place[length] = at;
            code = (code + count[length]) << 1;
            at += count[length];
        }
    }
};

struct Component {
    int id = 0, across = 1, down = 1;  // samples of an MCU, in blocks
    std::size_t quantization = 0, dc = 0, ac = 0;
    int before = 0;  // last DC coefficient
    std::size_t width = 0, height = 0;
    std::vector<std::uint8_t> samples;
};

class JpegReader {
  public:
    explicit JpegReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    Result<ColourImage> read() {
        if (bytes_.size() < 4 || bytes_[0] != 0xFF || bytes_[1] != 0xD8) fail("it does not begin as one");
        at_ = 2;
        while (why_.empty() && !scanned_) read_segment();
        if (!why_.empty())
            return Error{"is no JPEG picture that can be read: " + why_,
                         "Save it as PNG or as baseline JPEG.", "picture-kind"};
        return colours();
    }

  private:
    void fail(const char* why) {
        if (why_.empty()) why_ = why;
    }
    int byte() {
        if (at_ < bytes_.size()) return bytes_[at_++];
        fail("it is cut off");
        return 0;
    }
    int word() {
        const int high = byte();
        return high << 8 | byte();
    }

    void read_segment() {
        if (byte() != 0xFF) return;  // between segments
        int marker = byte();
        while (marker == 0xFF && why_.empty()) marker = byte();
        if (marker == 0 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8)) return;
        if (marker == 0xD9) return fail("it has no picture in it");
        const std::size_t start = at_;
        const int length = word();
        if (length < 2 || start + static_cast<std::size_t>(length) > bytes_.size())
            return fail("it is cut off");
        end_ = start + static_cast<std::size_t>(length);
        const bool frame =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (marker == 0xC0 || marker == 0xC1) {
            read_frame();
        } else if (frame) {
            return fail(marker == 0xC2 ? "it is progressive" : "it is of a rare kind");
        } else if (marker == 0xC4) {
            while (at_ < end_ && why_.empty()) read_huffman();
        } else if (marker == 0xDB) {
            while (at_ < end_ && why_.empty()) read_quantization();
        } else if (marker == 0xDD) {
            restart_every_ = word();
        } else if (marker == 0xEE && length >= 14 && bytes_[at_] == 'A' && bytes_[at_ + 1] == 'd') {
            is_rgb_ = bytes_[at_ + 11] == 0;  // Adobe's colour transform
        } else if (marker == 0xDA) {
            return read_scan();
        }
        at_ = end_;
    }

    void read_quantization() {
        const int head = byte(), table = head & 15;
        if (table > 3) return fail("a table has a wrong number");
        for (const std::uint8_t place : kZigzag)
            quantization_[static_cast<std::size_t>(table)][place] = (head >> 4) != 0 ? word() : byte();
    }

    void read_huffman() {
        const int head = byte(), number = head & 15;
        if (number > 3 || head >> 4 > 1) return fail("a table has a wrong number");
        HuffmanTable& table = huffman_[static_cast<std::size_t>(head >> 4)][static_cast<std::size_t>(number)];
        std::size_t total = 0;
        for (std::size_t length = 1; length <= 16; ++length)
            total += static_cast<std::size_t>(table.count[length] = byte());
        if (total > 256) return fail("a table is too long");
        table.values.clear();
        for (std::size_t i = 0; i < total; ++i) table.values.push_back(static_cast<std::uint8_t>(byte()));
        table.number_codes();
    }

    void read_frame() {
        constexpr int kSideMost = 8192;
        if (byte() != 8) return fail("it has not 8 bits a sample");
        height_ = word(), width_ = word();
        if (width_ < 1 || height_ < 1 || width_ > kSideMost || height_ > kSideMost)
            return fail("its size is not from 1 to 8192 pixels");
        const int count = byte();
        if (count != 1 && count != 3) return fail("it has neither one nor three components");
        components_.clear();
        for (int i = 0; i < count; ++i) {
            Component& c = components_.emplace_back();
            c.id = byte();
            const int factors = byte();
            c.across = factors >> 4, c.down = factors & 15;
            c.quantization = static_cast<std::size_t>(byte() & 3);
            if (c.across < 1 || c.down < 1 || c.across > 4 || c.down > 4)
                return fail("its sampling is wrong");
            across_ = std::max(across_, c.across), down_ = std::max(down_, c.down);
        }
        if (count == 1) components_[0].across = components_[0].down = across_ = down_ = 1;
        columns_ = (width_ + 8 * across_ - 1) / (8 * across_),
        rows_ = (height_ + 8 * down_ - 1) / (8 * down_);
        for (Component& c : components_) {
            c.width = static_cast<std::size_t>(columns_ * c.across * 8);
            c.height = static_cast<std::size_t>(rows_ * c.down * 8);
            c.samples.resize(c.width * c.height);
        }
    }

    void read_scan() {
        if (components_.empty()) return fail("its size is missing");
        if (byte() != static_cast<int>(components_.size())) return fail("its components stand apart");
        for (std::size_t i = 0; i < components_.size(); ++i) {
            const int id = byte(), tables = byte();
            for (Component& c : components_)
                if (c.id == id)
                    c.dc = static_cast<std::size_t>(tables >> 4 & 3),
                    c.ac = static_cast<std::size_t>(tables & 3);
        }
        at_ = end_;
        scanned_ = true;
        int until_restart = restart_every_;
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column) {
                if (restart_every_ > 0 && until_restart-- == 0) restart(), until_restart = restart_every_ - 1;
                for (Component& c : components_)
                    for (int v = 0; v < c.down; ++v)
                        for (int u = 0; u < c.across; ++u)
                            read_block(c, column * c.across + u, row * c.down + v);
                if (!why_.empty()) return;
            }
    }

    void restart() {
        bits_ = 0, left_ = 0;
        while (at_ + 1 < bytes_.size() &&
               !(bytes_[at_] == 0xFF && bytes_[at_ + 1] >= 0xD0 && bytes_[at_ + 1] <= 0xD7))
            ++at_;
        at_ += 2;
        for (Component& c : components_) c.before = 0;
    }

    int bit() {
        if (left_ == 0) {
            // behind the end, and at a marker, there are zeros
            const bool ends = at_ >= bytes_.size() ||
                              (bytes_[at_] == 0xFF && at_ + 1 < bytes_.size() && bytes_[at_ + 1] != 0);
            bits_ = ends ? 0 : bytes_[at_++];
            if (!ends && bits_ == 0xFF) ++at_;
            if (ends && ++missing_ > kBlock * 64) fail("it is cut off");
            left_ = 8;
        }
        return bits_ >> --left_ & 1;
    }
    /// A signed number of so many bits (F.2.2.1).
    int number(int bits) {
        int value = 0;
        for (int i = 0; i < bits; ++i) value = value << 1 | bit();
        return bits > 0 && value < 1 << (bits - 1) ? value - (1 << bits) + 1 : value;
    }
    int symbol(const HuffmanTable& table) {
        int code = 0;
        for (std::size_t length = 1; length <= 16; ++length) {
            code = code << 1 | bit();
            const int place = code - table.first[length];
            if (place >= 0 && place < table.count[length])
                return table.values[static_cast<std::size_t>(table.place[length] + place)];
        }
        fail("a code is wrong");
        return 0;
    }

    void read_block(Component& c, int column, int row) {
        std::array<double, kBlock> block{};
        const auto& scale = quantization_[c.quantization];
        c.before += number(std::min(symbol(huffman_[0][c.dc]), 16));
        block[0] = c.before * scale[0];
        for (std::size_t k = 1; k < kBlock; ++k) {
            const int code = symbol(huffman_[1][c.ac]), zeros = code >> 4, bits = code & 15;
            if (bits == 0 && zeros != 15) break;
            k += static_cast<std::size_t>(zeros);
            if (k >= kBlock) break;
            if (bits > 0) block[kZigzag[k]] = number(bits) * scale[kZigzag[k]];
        }
        put(block, c, static_cast<std::size_t>(column), static_cast<std::size_t>(row));
    }

    /// cos((2 x + 1) u pi / 16) / 2, by sqrt(2) less for u = 0 (A.3.3); by x and u.
    static const std::array<double, kBlock>& cosines() {
        static const std::array<double, kBlock> table = [] {
            std::array<double, kBlock> made{};
            for (std::size_t x = 0; x < 8; ++x)
                for (std::size_t u = 0; u < 8; ++u)
                    made[8 * x + u] = 0.5 * (u == 0 ? std::sqrt(0.5) : 1) *
                                      fixed_cos(static_cast<double>((2 * x + 1) * u) * kPi / 16);
            return made;
        }();
        return table;
    }

    static void put(const std::array<double, kBlock>& block, Component& c, std::size_t column,
                    std::size_t row) {
        const std::array<double, kBlock>& cosine = cosines();
        std::array<double, kBlock> across{};
        for (std::size_t v = 0; v < 8; ++v)
            for (std::size_t x = 0; x < 8; ++x)
                for (std::size_t u = 0; u < 8; ++u) across[8 * v + x] += cosine[8 * x + u] * block[8 * v + u];
        for (std::size_t y = 0; y < 8; ++y)
            for (std::size_t x = 0; x < 8; ++x) {
                double sum = 128.5;
                for (std::size_t v = 0; v < 8; ++v) sum += cosine[8 * y + v] * across[8 * v + x];
                c.samples[(8 * row + y) * c.width + 8 * column + x] =
                    static_cast<std::uint8_t>(std::clamp(sum, 0.0, 255.0));
            }
    }

    ColourImage colours() const {
        ColourImage out{static_cast<std::size_t>(width_), static_cast<std::size_t>(height_), {}};
        out.samples.reserve(3 * out.columns * out.rows);
        const auto sample = [&](const Component& c, std::size_t x, std::size_t y) {
            const std::size_t u = x * static_cast<std::size_t>(c.across) / static_cast<std::size_t>(across_);
            const std::size_t v = y * static_cast<std::size_t>(c.down) / static_cast<std::size_t>(down_);
            return static_cast<double>(c.samples[v * c.width + u]);
        };
        const auto add = [&](double value) {
            out.samples.push_back(static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)));
        };
        for (std::size_t y = 0; y < out.rows; ++y)
            for (std::size_t x = 0; x < out.columns; ++x) {
                const double luma = sample(components_[0], x, y);
                if (components_.size() == 1) {
                    add(luma), add(luma), add(luma);
                    continue;
                }
                const double b = sample(components_[1], x, y), r = sample(components_[2], x, y);
                if (is_rgb_) {
                    add(luma), add(b), add(r);
                    continue;
                }
                add(luma + 1.402 * (r - 128));
                add(luma - 0.344136 * (b - 128) - 0.714136 * (r - 128));
                add(luma + 1.772 * (b - 128));
            }
        return out;
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0, end_ = 0;  // here, and the end of this segment
    std::string why_;               // it cannot be read; empty: it can
    bool scanned_ = false, is_rgb_ = false;
    int width_ = 0, height_ = 0, across_ = 1, down_ = 1, columns_ = 0, rows_ = 0;  // the last two: MCUs
    int restart_every_ = 0;
    std::vector<Component> components_;
    std::array<std::array<int, kBlock>, 4> quantization_{};
    std::array<std::array<HuffmanTable, 4>, 2> huffman_;
    int bits_ = 0, left_ = 0;
    std::size_t missing_ = 0;  // bytes that were read behind the end
};

}  // namespace

Result<ColourImage> decode_jpeg(std::span<const std::uint8_t> bytes) {
    return JpegReader(bytes).read();
}

}  // namespace roboss
