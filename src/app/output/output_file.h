// Where a table of a run is written to: a file, or standard output.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace roboss {

/// The name of standard output in options.
inline constexpr const char* kStandardOutput = "-";

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using OutputFile = std::unique_ptr<std::FILE, FileCloser>;

/// Opens for writing; null with errno if that fails.
OutputFile open_output(const std::string& path);

}  // namespace roboss
