// Creation by O_EXCL, fsync of file and folder, rename.
#include "journal/new_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>

#include "core/hash.h"

namespace roboss {
namespace {

constexpr int kTries = 100;
constexpr const char* kRemedy = "check the path, the permissions, and the room on the disk";

Error failed(const std::string& doing) {
    return {"cannot " + doing + ": " + std::strerror(errno), kRemedy};
}

/// False: see errno.
bool bring_to_disk(const std::string& path, int flags) {
    const int file = open(path.c_str(), flags | O_CLOEXEC);
    if (file < 0) return false;
    const bool done = fsync(file) == 0;
    const int error = errno;
    close(file);
    errno = error;
    return done;
}

}  // namespace

Result<NewFile> NewFile::beside(const std::string& path) {
    std::random_device device;
    for (int i = 0; i < kTries; ++i) {
        const std::uint64_t number = static_cast<std::uint64_t>(device()) << 32 | device();
        std::string own = path + "." + to_hex(number) + ".part";
        const int file = open(own.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file >= 0) {
            close(file);
            return NewFile(path, std::move(own));
        }
        if (errno != EEXIST) break;
    }
    return failed("write " + path);
}

NewFile::~NewFile() {
    if (!own_.empty()) unlink(own_.c_str());
}

Result<> NewFile::publish() {
    if (!bring_to_disk(own_, O_RDONLY)) return failed("write " + path_);
    if (rename(own_.c_str(), path_.c_str()) != 0) return failed("rename " + own_ + " to " + path_);
    own_.clear();
    const std::string folder = std::filesystem::path(path_).parent_path().string();
    if (!bring_to_disk(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY) && errno != EINVAL)
        return failed("write the folder of " + path_);
    return Ok{};
}

}  // namespace roboss
