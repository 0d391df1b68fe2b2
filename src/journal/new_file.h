// NewFile: a file that appears under its name only when it is complete. Until then it has a random name in
// the same folder, so that nobody can place a link there in advance.
#pragma once

#include <string>
#include <utility>

#include "core/result.h"

namespace roboss {

class NewFile {
  public:
    /// Creates the file beside `path`, empty; it must not have existed, as a link neither.
    static Result<NewFile> beside(const std::string& path);
    NewFile(NewFile&& other) noexcept : path_(std::move(other.path_)), own_(std::exchange(other.own_, {})) {}
    NewFile& operator=(NewFile&&) = delete;
    /// Removes it, if it was not published.
    ~NewFile();

    /// Where to write.
    const std::string& own_path() const { return own_; }
    /// Once it is written and closed: syncs it to the disk and gives it its name, replacing a file of this
    /// name.
    Result<> publish();

  private:
    NewFile(std::string path, std::string own) : path_(std::move(path)), own_(std::move(own)) {}
    std::string path_, own_;  // own_: empty: published
};

}  // namespace roboss
