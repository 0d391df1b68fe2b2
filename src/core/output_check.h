// OutputCheck: no output replaces anything but an older output of its own kind. Commands and functions that
// write files name what they read and what they write, and ask before they begin. An output is refused if it
// is an input of the same command or another of its outputs, also through symbolic and hard links, or a file
// of another kind, as its first bytes show.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace roboss {

class OutputCheck {
  public:
    /// A file that is read; empty or "-" (standard input) is none.
    void reads(const std::string& path);
    /// A file to write, by which option, and one of file_kinds(). Empty or "-" (standard output) is none.
    void writes(const std::string& option, const std::string& path, std::string_view kind);
    /// Errors: "output-is-input", "output-twice", "other-kind".
    Result<> check() const;

  private:
    struct Output {
        std::string option, path;
        std::string_view kind;
    };
    std::vector<std::string> inputs_;
    std::vector<Output> outputs_;
};

/// Kinds of files that are recognised: "trace", "png" ...
std::vector<std::string_view> file_kinds();
/// The file looks like one of this kind, is empty, is no regular file (a pipe, a device), or does not exist.
bool may_become(const std::string& path, std::string_view kind);

}  // namespace roboss
