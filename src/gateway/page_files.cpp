// Paths are taken letter by letter: what is not plainly a file's name below the folder is not there.
#include "gateway/page_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <utility>

#include "core/installation.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kFileBytesMax = 64u << 20;

const char* const kNoPage = R"(<!doctype html><html lang="en"><meta charset="utf-8"><title>RoBOSS</title>
<h1>The viewer's page is not built</h1>
<p>The simulation runs and its gateway answers, but the page itself is missing. Build it with <code>./run.sh</code> or
<code>tools/build.sh release web</code>, or name its folder with <code>--web FOLDER</code>.</p></html>
)";

const char* type_of(const std::string& extension) {
    static constexpr std::array<std::pair<const char*, const char*>, 14> kTypes = {
        {{".html", "text/html; charset=utf-8"},
         {".js", "text/javascript; charset=utf-8"},
         {".mjs", "text/javascript; charset=utf-8"},
         {".css", "text/css; charset=utf-8"},
         {".json", "application/json"},
         {".map", "application/json"},
         {".svg", "image/svg+xml"},
         {".png", "image/png"},
         {".jpg", "image/jpeg"},
         {".ico", "image/x-icon"},
         {".wasm", "application/wasm"},
         {".woff2", "font/woff2"},
         {".txt", "text/plain; charset=utf-8"},
         {".webmanifest", "application/manifest+json"}}};
    for (const auto& [name, type] : kTypes)
        if (extension == name) return type;
    return "application/octet-stream";
}

bool plain(std::string_view path) {
    const bool letters = std::all_of(path.begin(), path.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_' ||
               c == '/';
    });
    return letters && path.starts_with('/') && path.find("/.") == std::string_view::npos &&
           path.find("//") == std::string_view::npos;
}

}  // namespace

PageFiles::PageFiles(const fs::path& folder) {
    std::error_code error;
    if (!folder.empty() && fs::is_regular_file(folder / "index.html", error))
        folder_ = fs::canonical(folder, error);
}

std::optional<PageFile> PageFiles::find(std::string_view path) const {
    if (path == "/") path = "/index.html";
    if (folder_.empty() && path == "/index.html") return PageFile{kNoPage, type_of(".html")};
    if (folder_.empty() || !plain(path)) return std::nullopt;
    std::error_code error;
    const fs::path file = fs::canonical(folder_ / fs::path(path.substr(1)), error);
    if (error || !fs::is_regular_file(file, error)) return std::nullopt;
    const auto [end, rest] = std::mismatch(folder_.begin(), folder_.end(), file.begin(), file.end());
    if (end != folder_.end()) return std::nullopt;  // a link that leads out of it
    if (fs::file_size(file, error) > kFileBytesMax || error) return std::nullopt;
    std::ifstream in(file, std::ios::binary);
    PageFile found{{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()},
                   type_of(file.extension().string())};
    if (!in.good() && !in.eof()) return std::nullopt;
    return found;
}

fs::path find_page_folder(const std::string& wanted) {
    if (!wanted.empty()) return wanted;
    std::error_code error;
    const fs::path page = installation_prefix() / "share" / "roboss" / "web";
    return fs::is_regular_file(page / "index.html", error) ? page : fs::path();
}

}  // namespace roboss
