// The page's files, from one folder and nothing outside it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace roboss {

struct PageFile {
    std::string content;
    std::string type;  // MIME
};

class PageFiles {
  public:
    /// `folder`: empty, or without an index.html: then a page that says how to get one.
    explicit PageFiles(const std::filesystem::path& folder);

    bool there() const { return !folder_.empty(); }
    /// `path`: "/" or "/main.js", without a query. Nothing: there is no such file.
    std::optional<PageFile> find(std::string_view path) const;

  private:
    std::filesystem::path folder_;
};

/// Where the page is: `wanted` if it is given, else share/roboss/web beside or above the folder of this
/// program.
std::filesystem::path find_page_folder(const std::string& wanted);

}  // namespace roboss
