// Keys as files: authority.crt, member.crt and member.key, and `revoked`, a line for each certificate that is
// not accepted any more: its serial, then anything. All are readable by their owner alone.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>

#include "core/result.h"
#include "net/tls.h"

namespace roboss {

/// The files of a folder of keys: name and text of each.
template <class C>  // Credentials, const or not
auto key_files(C& credentials) {
    return std::array{std::pair{"authority.crt", &credentials.authority},
                      std::pair{"member.crt", &credentials.own.certificate},
                      std::pair{"member.key", &credentials.own.key}};
}

/// An Error names the file: it is missing, or others may read a key.
Result<Credentials> read_keys(const std::filesystem::path& folder);

/// Creates the folder if it is missing. Writes no list of revoked ones.
Result<> write_keys(const std::filesystem::path& folder, const Credentials& credentials);

/// A file that only its owner may read, whole or not at all.
Result<> write_private(const std::filesystem::path& file, const std::string& text);
Result<std::string> read_text(const std::filesystem::path& file);
/// An Error [open-key]: others may read it.
Result<std::string> read_private(const std::filesystem::path& file);

}  // namespace roboss
