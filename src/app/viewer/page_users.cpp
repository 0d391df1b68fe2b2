// See page_users.h.
#include "app/viewer/page_users.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "gateway/access.h"
#include "net/key_folder.h"
#include "net/key_ring.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigest = 64;  // hex digits

bool is_digest(const std::string& text) {
    return text.size() == kDigest && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

Result<> write_users(const fs::path& file, const std::vector<PageUser>& users) {
    std::string text = "# users of the page: NAME ROLE SHA-256 of the token (roboss keys)\n";
    for (const PageUser& user : users)
        text += fmt::format("{} {} {}\n", user.name, name_of(user.role), user.digest);
    return write_private(file, text);
}

}  // namespace

bool names_user(const std::vector<PageUser>& users, const std::string& name) {
    return std::ranges::find(users, name, &PageUser::name) != users.end();
}

Result<std::vector<PageUser>> page_users_of(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return std::vector<PageUser>{};
    return read_page_users(file);
}

Result<std::vector<PageUser>> read_page_users(const fs::path& file) {
    const Result<std::string> text = read_private(file);
    if (!text) return Error{text.error().message, "see --view-users", text.error().code};
    std::vector<PageUser> users;
    std::istringstream lines(text.value());
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        std::istringstream words(line);
        std::string name, role, digest, more;
        if (!(words >> name) || name.starts_with('#')) continue;
        const bool complete = static_cast<bool>(words >> role >> digest) && !(words >> more);
        const std::optional<PageRole> known = parse_page_role(role);
        if (!complete || !known || !is_digest(digest) || names_user(users, name) || !check_holder_name(name))
            return Error{fmt::format("{}:{} is no user of the page", file.string(), number),
                         "a line is NAME ROLE DIGEST, each name once; `roboss keys add` writes it",
                         "bad-users"};
        users.push_back({name, *known, digest});
    }
    return users;
}

Result<std::string> add_page_user(const fs::path& file, const std::string& name, PageRole role) {
    if (Result<> named = check_holder_name(name); !named) return named.error();
    Result<std::vector<PageUser>> users = page_users_of(file);
    if (!users) return users.error();
    if (names_user(users.value(), name))
        return Error{"'" + name + "' has a token already", "use it, or revoke it first", "key-exists"};
    std::string token = random_token();
    users.value().push_back({name, role, token_digest(token)});
    if (Result<> written = write_users(file, users.value()); !written) return written.error();
    return token;
}

Result<> remove_page_user(const fs::path& file, const std::string& name) {
    Result<std::vector<PageUser>> users = page_users_of(file);
    if (!users) return users.error();
    if (std::erase_if(users.value(), [&](const PageUser& user) { return user.name == name; }) == 0)
        return Error{"there is no key of '" + name + "'", "`roboss keys list` lists them", "no-key"};
    return write_users(file, users.value());
}

}  // namespace roboss
