// Says whether libsdformat itself accepts a file, with the resource folders given: the yardstick of
// tools/check_corpus. Usage: libsdformat_verdict FILE [FOLDER...]
// Prints "accepted", or "refused: " and the first error. Exit codes: 0 accepted, 1 refused, 2 wrong usage.
#include <filesystem>
#include <iostream>
#include <sdf/sdf.hh>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// The file or folder behind a URI: what follows the scheme, in the first of the folders that has it.
std::string find(const std::vector<fs::path>& folders, const std::string& uri) {
    const std::size_t scheme = uri.find("://");
    const fs::path rest = scheme == std::string::npos ? uri : uri.substr(scheme + 3);
    for (const fs::path& folder : folders) {
        std::error_code ignored;
        if (fs::exists(folder / rest, ignored)) return (folder / rest).string();
    }
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: libsdformat_verdict FILE [FOLDER...]\n";
        return 2;
    }
    const std::string file = argv[1];
    std::vector<fs::path> folders{fs::path(file).parent_path()};
    for (int i = 2; i < argc; ++i) folders.emplace_back(argv[i]);
    std::string why;
    try {
        sdf::ParserConfig config;
        config.SetFindCallback([&](const std::string& uri) { return find(folders, uri); });
        sdf::Root root;
        const sdf::Errors errors = root.Load(file, config);
        if (errors.empty()) {
            std::cout << "accepted\n";
            return 0;
        }
        why = errors.front().Message();
    } catch (const std::exception& exception) {
        why = exception.what();
    }
    std::cout << "refused: " << why.substr(0, why.find('\n')) << '\n';
    return 1;
}
