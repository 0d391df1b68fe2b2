// Users of the viewer's page, as a file that only its owner may read: a line for each, NAME ROLE DIGEST,
// where the digest is the SHA-256 of the user's token. `roboss keys` writes it; who deletes a line revokes
// its token.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "gateway/roles.h"

namespace roboss {

/// Name of this file in a folder of keys.
inline constexpr const char* kUsersFile = "users";

/// An Error: it cannot be read, others may read it [open-key], or a line is none [bad-users].
Result<std::vector<PageUser>> read_page_users(const std::filesystem::path& file);

/// The same of a file that may be missing: then there are none.
Result<std::vector<PageUser>> page_users_of(const std::filesystem::path& file);

bool names_user(const std::vector<PageUser>& users, const std::string& name);

/// Adds a user to the file, which need not be there yet. The answer: the new token, which is kept nowhere. An
/// Error [key-exists]: the name has one.
Result<std::string> add_page_user(const std::filesystem::path& file, const std::string& name, PageRole role);

/// An Error [no-key]: there is no such user.
Result<> remove_page_user(const std::filesystem::path& file, const std::string& name);

}  // namespace roboss
