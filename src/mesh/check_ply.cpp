// The head has lines of words: "element NAME COUNT", "property TYPE NAME", "property list TYPE TYPE NAME".
#include "mesh/check_ply.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "xml/source_file.h"

namespace roboss {
namespace {

using Words = std::vector<std::string_view>;

Error wrong(int line, const std::string& what) {
    return {"is no mesh that can be read: line " + std::to_string(line) + ": " + what, "Export it anew."};
}

class PlyHead {
  public:
    explicit PlyHead(std::string_view bytes) : bytes_(bytes) {}

    Result<> check() {
        std::size_t at = 0;
        for (int line = 1; at < bytes_.size(); ++line) {
            const std::size_t end = std::min(bytes_.find_first_of("\r\n", at), bytes_.size());
            const Words words = xml::words_of(bytes_.substr(at, end - at));
            at = end + (bytes_.substr(end, 2) == "\r\n" ? 2 : 1);
            if (words.empty()) continue;
            if (words[0] == "end_header") return check_size(line, at);
            if (const Result<> good = take(words, line); !good) return good;
        }
        return wrong(1, "its head has no line end_header");
    }

  private:
    Result<> take(const Words& words, int line) {
        if (words[0] == "format" && words.size() > 1) binary_ = words[1].starts_with("binary");
        if (words[0] == "property") {
            const std::string_view type = words.size() > 1 ? words[1] : "";
            each_ += type == "list" ? size_of(words.size() > 2 ? words[2] : "") : size_of(type);
        }
        if (words[0] != "element") return Ok{};
        close_element();
        const std::string_view count = words.size() == 3 ? words[2] : "";
        const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), count_);
        if (error != std::errc() || end != count.data() + count.size())
            return wrong(line, "an element has no count from 0 to 4294967295");
        return Ok{};
    }

    /// The fewest bytes of a value: of text a character and what divides it from the next.
    std::uint64_t size_of(std::string_view type) const {
        static const std::map<std::string_view, std::uint64_t> kSizes{
            {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
            {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
            {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
        if (!binary_) return 2;
        const auto known = kSizes.find(type);
        return known == kSizes.end() ? 0 : known->second;
    }

    void close_element() {
        needed_ += std::max<std::uint64_t>(each_, 1) * count_;
        each_ = count_ = 0;
    }

    Result<> check_size(int line, std::size_t at) {
        close_element();
        const std::uint64_t there = bytes_.size() - std::min(at, bytes_.size()) + 1;  // the last needs no end
        if (needed_ > there) return wrong(line, "the file ends before all that its head announces");
        return Ok{};
    }

    std::string_view bytes_;
    bool binary_ = false;
    std::uint32_t count_ = 0;
    std::uint64_t each_ = 0, needed_ = 0;
};

}  // namespace

Result<> check_ply(std::string_view bytes) {
    return PlyHead(bytes).check();
}

}  // namespace roboss
