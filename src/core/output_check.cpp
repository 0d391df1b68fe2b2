// Kinds of files by their first bytes; files by their inodes.
#include "core/output_check.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "core/check.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLookedAt = 1u << 16;  // bytes of a file

/// How files of a kind begin, a text that follows soon, and the name of the outermost element of XML; each
/// may be empty. In `head`, '\1' stands for any digit.
struct Kind {
    std::string_view name, phrase, head, within, root;
};
constexpr std::array kKinds{
    Kind{"trace", "a trace of --trace", "time_s,robot,link,", "", ""},
    Kind{"contacts", "a table of --contacts", "time_s,robot_a,", "", ""},
    Kind{"reading", "a table of one reading", "name,index,value,unit", "", ""},
    Kind{"table", "a table of `roboss record`", "# roboss {", "", ""},
    Kind{"summary", "a summary of a run", "{\n  \"world\":", "", ""},
    Kind{"device summary", "a summary of devices", "{\"calls\":", "", ""},
    Kind{"log", "a log of --log", "\1\1\1\1-\1\1-\1\1T\1\1:\1\1:\1\1.\1\1\1Z level=", "", ""},
    Kind{"svg", "an SVG picture", "<", "", "svg"},
    Kind{"png", "a PNG picture", "\x89PNG", "", ""},
    Kind{"pdf", "a PDF file", "%PDF", "", ""},
    Kind{"npy", "a NumPy array", "\x93NUMPY", "", ""},
    Kind{"pcd", "a point cloud", "# .PCD", "", ""},
    Kind{"html", "a report", "<!doctype html", "", "html"},
    Kind{"parquet", "a Parquet file", "PAR1", "", ""},
    Kind{"mcap", "an MCAP file of RoBOSS", "\x89MCAP", "roboss", ""},
    Kind{"rrd", "a Rerun recording", "RRF", "", ""},
    Kind{"world", "a world or robot file", "<", "", "sdf gazebo robot mujoco"},
    Kind{"saved state", "a saved state", "SQLite format 3", "CREATE TABLE checkpoints", ""},
    Kind{"figures", "figures of roboss-fuzz", "[", "\"replay\"", ""},
};

const Kind& kind_of(std::string_view name) {
    const auto* const found = std::ranges::find(kKinds, name, &Kind::name);
    ROBOSS_CHECK(found != kKinds.end(), std::string(name));
    return *found;
}

bool begins(std::string_view bytes, std::string_view head) {
    const auto fits = [](char byte, char expected) {
        return expected == '\1' ? byte >= '0' && byte <= '9' : byte == expected;
    };
    return bytes.size() >= head.size() && std::ranges::equal(bytes.substr(0, head.size()), head, fits);
}

/// The name of the outermost element of an XML file, behind declarations and comments; empty: there is none.
std::string_view root_of(std::string_view bytes) {
    for (std::size_t at = bytes.find('<'); at != std::string_view::npos; at = bytes.find('<', at)) {
        const std::string_view rest = bytes.substr(at + 1);
        if (!rest.starts_with('?') && !rest.starts_with('!'))
            return rest.substr(0, rest.find_first_of(" \t\r\n/>"));
        at = bytes.find(rest.starts_with("!--") ? "-->" : ">", at);
    }
    return {};
}

bool is_one_of(std::string_view word, std::string_view words) {
    return !word.empty() &&
           (' ' + std::string(words) + ' ').find(' ' + std::string(word) + ' ') != std::string::npos;
}

bool is(std::string_view bytes, const Kind& kind) {
    if (!kind.root.empty() && bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    return begins(bytes, kind.head) && bytes.find(kind.within) != std::string_view::npos &&
           (kind.root.empty() || is_one_of(root_of(bytes), kind.root));
}

bool is_none(const std::string& path) {
    return path.empty() || path == "-";
}

/// One file, perhaps by two names; also of one that is yet to be made.
bool same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    if (fs::exists(a, error) && fs::exists(b, error))
        return fs::is_regular_file(a, error) && fs::equivalent(a, b, error);
    std::error_code in_a, in_b;
    const fs::path x = fs::weakly_canonical(fs::absolute(a, in_a), in_a),
                   y = fs::weakly_canonical(fs::absolute(b, in_b), in_b);
    return !in_a && !in_b && x == y;
}

}  // namespace

std::vector<std::string_view> file_kinds() {
    std::vector<std::string_view> names;
    for (const Kind& kind : kKinds) names.push_back(kind.name);
    return names;
}

bool may_become(const std::string& path, std::string_view kind) {
    std::error_code error;
    if (!fs::is_regular_file(path, error) || fs::file_size(path, error) == 0) return true;
    std::ifstream file(path, std::ios::binary);
    std::string bytes(kLookedAt, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (file.bad() || !file.is_open()) return true;  // opening it for writing says why it cannot be
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return is(bytes, kind_of(kind));
}

void OutputCheck::reads(const std::string& path) {
    if (!is_none(path)) inputs_.push_back(path);
}

void OutputCheck::writes(const std::string& option, const std::string& path, std::string_view kind) {
    if (!is_none(path)) outputs_.push_back({option, path, kind_of(kind).name});
}

Result<> OutputCheck::check() const {
    for (const Output& output : outputs_) {
        const std::string named = "'" + output.path + "' of " + output.option;
        for (const std::string& input : inputs_)
            if (same_file(output.path, input))
                return Error{named + " is a file that is read" + (input == output.path ? "" : ": " + input),
                             "give the output another name", "output-is-input"};
        for (const Output& other : outputs_)
            if (&other < &output && same_file(output.path, other.path))
                return Error{named + " is also the file of " + other.option, "give each output its own name",
                             "output-twice"};
        if (!may_become(output.path, output.kind))
            return Error{named + " exists and is not " + std::string(kind_of(output.kind).phrase) +
                             "; nothing else is overwritten",
                         "give another name, or remove the file yourself", "other-kind"};
    }
    return Ok{};
}

}  // namespace roboss
