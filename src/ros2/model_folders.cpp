// See model_folders.h.
#include "ros2/model_folders.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <optional>

#include "ros2/model_text.h"

namespace roboss::ros2 {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kLargest = 16u << 20;  // bytes of a description
constexpr std::size_t kMost = 10'000;           // descriptions that are listed

bool is_description(const fs::path& file) {
    static const std::array<std::string, 5> kEndings{".sdf", ".urdf", ".xml", ".mjcf", ".world"};
    return std::ranges::find(kEndings, file.extension().string()) != kEndings.end();
}

/// The file below the folder, without links that lead out of it.
std::optional<fs::path> file_below(const fs::path& folder, const fs::path& wanted) {
    std::error_code problem;
    const fs::path file = fs::canonical(wanted.is_absolute() ? wanted : folder / wanted, problem);
    if (problem || !fs::is_regular_file(file, problem)) return {};
    const auto [end, at] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end() ? std::optional(file) : std::nullopt;
}

std::string without_scheme(const std::string& uri) {
    static constexpr std::string_view kFile = "file://";
    return uri.starts_with(kFile) ? uri.substr(kFile.size()) : uri;
}

}  // namespace

ModelFolders::ModelFolders(const std::vector<std::string>& folders) {
    for (const std::string& folder : folders) {
        std::error_code problem;
        fs::path path = fs::canonical(folder, problem);
        if (!problem) folders_.push_back(std::move(path));
    }
}

std::vector<ModelFile> ModelFolders::list() const {
    std::vector<ModelFile> files;
    for (const fs::path& folder : folders_) {
        std::error_code problem;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, problem)) {
            const std::string name = entry.path().filename().string();
            if (files.size() >= kMost) break;
            if (entry.is_directory(problem) && fs::exists(entry.path() / "model.config", problem))
                files.push_back({"model://" + name, "a model of " + folder.string()});
            else if (entry.is_regular_file(problem) && is_description(entry.path()))
                files.push_back({"file://" + entry.path().string(), "a file"});
        }
    }
    std::ranges::sort(files, {}, &ModelFile::uri);
    return files;
}

Result<ModelContent> ModelFolders::read(const std::string& uri) const {
    if (uri.starts_with("model://") || uri.starts_with("package://"))
        return ModelContent{"model.sdf", include_of(uri)};
    const fs::path wanted = without_scheme(uri);
    if (!is_description(wanted))
        return Error{"'" + uri.substr(0, 200) + "' is no SDF, URDF or MJCF file", "give a file of this kind",
                     "bad-format"};
    for (const fs::path& folder : folders_) {
        const std::optional<fs::path> file = file_below(folder, wanted);
        std::error_code problem;
        if (!file || fs::file_size(*file, problem) > kLargest || problem) continue;
        std::ifstream in(*file, std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(in), {}};
        if (in) return ModelContent{file->filename().string(), std::move(text)};
    }
    return Error{"there is no file '" + uri.substr(0, 200) + "' in the folders of models",
                 "GetSpawnables lists what there is", "no-file"};
}

}  // namespace roboss::ros2
