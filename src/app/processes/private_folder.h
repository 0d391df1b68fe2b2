// PrivateFolder: a folder for temporary files with an unpredictable name, readable by its owner only. The
// destructor removes it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace roboss {

class PrivateFolder {
  public:
    /// In the system's folder for temporary files; none if that cannot be written.
    static std::optional<PrivateFolder> make(const std::string& purpose) {
        std::error_code error;
        const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
        if (error) return std::nullopt;
        std::string pattern = (folder / ("roboss-" + purpose + "-XXXXXX")).string();
        if (mkdtemp(pattern.data()) == nullptr) return std::nullopt;
        return PrivateFolder(std::move(pattern));
    }
    PrivateFolder(PrivateFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    PrivateFolder& operator=(PrivateFolder&&) = delete;
    ~PrivateFolder() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    explicit PrivateFolder(std::filesystem::path path) : path_(std::move(path)) {}
    std::filesystem::path path_;
};

}  // namespace roboss
