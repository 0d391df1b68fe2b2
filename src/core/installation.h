// Where the files that come with this program are.
#pragma once

#include <filesystem>
#include <system_error>

namespace roboss {

/// The folder above that of this program: the prefix of an installation, or build/PRESET. Empty if unknown.
inline std::filesystem::path installation_prefix() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::canonical("/proc/self/exe", error);
    return error ? std::filesystem::path() : program.parent_path().parent_path();
}

}  // namespace roboss
