// Files and their modes.
#include "net/key_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

namespace roboss {
namespace {

namespace fs = std::filesystem;

Error unwritable(const fs::path& file) {
    return {file.string() + " cannot be written: " + std::strerror(errno), "see the rights of its folder",
            "not-writable"};
}

Result<> check_private(const fs::path& file) {
    struct stat found {};
    if (::stat(file.c_str(), &found) == 0 && (found.st_mode & 0077) != 0)
        return Error{file.string() + " is a key that others may read", "chmod 600 " + file.string(),
                     "open-key"};
    return Ok{};
}

}  // namespace

Result<std::string> read_text(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    if (in && text << in.rdbuf()) return text.str();
    return Error{file.string() + " cannot be read",
                 "give the folder of a member's keys, as `roboss keys` makes it", "no-keys"};
}

Result<std::string> read_private(const fs::path& file) {
    if (Result<> checked = check_private(file); !checked) return checked.error();
    return read_text(file);
}

Result<> write_private(const fs::path& file, const std::string& text) {
    const fs::path unfinished = file.string() + ".new";
    ::unlink(unfinished.c_str());
    const int to = ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (to < 0) return unwritable(file);
    const ssize_t written = ::write(to, text.data(), text.size());
    const bool done = written == static_cast<ssize_t>(text.size());
    if (::close(to) != 0 || !done || ::rename(unfinished.c_str(), file.c_str()) != 0) return unwritable(file);
    return Ok{};
}

Result<Credentials> read_keys(const fs::path& folder) {
    Credentials credentials;
    for (const auto& [name, text] : key_files(credentials)) {
        Result<std::string> read =
            text == &credentials.own.key ? read_private(folder / name) : read_text(folder / name);
        if (!read) return read.error();
        *text = std::move(read).value();
    }
    std::ifstream revoked(folder / "revoked");
    for (std::string line; std::getline(revoked, line);)
        if (std::string serial; std::istringstream(line) >> serial) credentials.revoked.insert(serial);
    return credentials;
}

Result<> write_keys(const fs::path& folder, const Credentials& credentials) {
    if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) return unwritable(folder);
    for (const auto& [name, text] : key_files(credentials))
        if (Result<> written = write_private(folder / name, *text); !written) return written;
    return Ok{};
}

}  // namespace roboss
