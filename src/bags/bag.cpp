// See bag.h.
#include "bags/bag.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include "bags/db3_reader.h"
#include "bags/decompress.h"
#include "bags/intake.h"
#include "bags/mcap_reader.h"

namespace roboss::bags {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kRos1Magic = "#ROSBAG ";

enum class Format { kMcap, kSqlite, kZstd, kRos1, kOther };

Format format_of(const std::string& file) {
    std::string head(16, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(in.gcount()));
    for (const auto& [magic, format] : {std::pair{kMcapMagic, Format::kMcap},
                                        {kSqliteMagic, Format::kSqlite},
                                        {kZstdMagic, Format::kZstd},
                                        {kRos1Magic, Format::kRos1}})
        if (head.starts_with(magic)) return format;
    return Format::kOther;
}

std::string ending(const fs::path& path) {
    return path.extension().string();
}

Result<> read_file(Intake& intake, Diagnostics& diagnostics) {
    switch (format_of(intake.file())) {
        case Format::kSqlite:
            return read_db3(intake);
        case Format::kZstd:
            return Error{"the whole file is compressed", "unpack it: `unzstd " + intake.file() + "`",
                         "compressed-file"};
        case Format::kRos1:
            return Error{"it is a bag of ROS 1",
                         "convert it: `pip install rosbags`, then `rosbags-convert --src FILE --dst FOLDER`",
                         "not-a-bag"};
        case Format::kMcap:
        case Format::kOther:
            break;
    }
    return read_mcap(intake, diagnostics);
}

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// bag_2.mcap comes before bag_10.mcap: digits count as numbers.
bool comes_before(const std::string& a, const std::string& b) {
    const auto number_at = [](const std::string& text, std::size_t at) {
        std::size_t end = at;
        while (end < text.size() && is_digit(text[end])) ++end;
        while (at + 1 < end && text[at] == '0') ++at;
        return std::string_view(text).substr(at, end - at);
    };
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        if (is_digit(a[i]) && is_digit(b[j])) {
            const std::string_view m = number_at(a, i), n = number_at(b, j);
            if (m != n) return m.size() != n.size() ? m.size() < n.size() : m < n;
            while (i < a.size() && is_digit(a[i])) ++i;
            while (j < b.size() && is_digit(b[j])) ++j;
        } else if (a[i] != b[j])
            return a[i] < b[j];
        else
            ++i, ++j;
    }
    return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

/// The files of a bag, in their order.
Result<std::vector<std::string>> files_of(const std::string& path) {
    std::error_code problem;
    if (!fs::is_directory(path, problem)) return std::vector{path};
    std::vector<std::string> mcap, db3;
    for (fs::directory_iterator at(path, problem), end; !problem && at != end; at.increment(problem)) {
        const fs::path file = at->path();
        std::error_code ignored;
        if (!fs::is_regular_file(file, ignored)) continue;
        if (ending(file) == ".zstd" && (ending(file.stem()) == ".mcap" || ending(file.stem()) == ".db3"))
            return Error{"the file " + file.filename().string() + " of the folder is compressed",
                         "unpack its files: `unzstd " + (fs::path(path) / "*.zstd").string() + "`",
                         "compressed-file"};
        if (ending(file) == ".mcap") mcap.push_back(file.string());
        if (ending(file) == ".db3") db3.push_back(file.string());
    }
    if (problem) return Error{"cannot list the folder: " + problem.message(), "check the path", "no-file"};
    if (mcap.empty() && db3.empty())
        return Error{"the folder has no files that end in .mcap or .db3", "give the folder of a rosbag2",
                     "not-a-bag"};
    if (!mcap.empty() && !db3.empty())
        return Error{"the folder has files that end in .mcap, and others that end in .db3",
                     "give the file of one of the bags", "not-a-bag"};
    std::vector<std::string>& files = mcap.empty() ? db3 : mcap;
    std::ranges::sort(files, comes_before);
    return files;
}

}  // namespace

bool is_bag(const std::string& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return true;
    if (!fs::is_regular_file(path, ignored)) return false;  // reading a pipe would empty it
    const std::string end = ending(path);
    return end == ".mcap" || end == ".db3" || format_of(path) != Format::kOther;
}

std::optional<std::int64_t> read_bag(const std::string& path, Sink& sink, Diagnostics& diagnostics) {
    const auto report = [&](const std::string& file, const Error& error) {
        diagnostics.error({file, 0}, error.code.empty() ? "bad-bag" : error.code, error.message,
                          error.remedy);
    };
    const Result<std::vector<std::string>> files = files_of(path);
    if (!files) return report(path, files.error()), std::nullopt;
    std::int64_t earliest_ns = Intake::kNoTime;
    for (const std::string& file : files.value()) {
        Intake intake(file, sink);
        const Result<> read = read_file(intake, diagnostics);
        earliest_ns = std::min(earliest_ns, intake.earliest_ns());
        if (read) continue;
        report(file, read.error());
        break;
    }
    if (earliest_ns == Intake::kNoTime) return std::nullopt;
    return earliest_ns;
}

}  // namespace roboss::bags
