// Files of a KeyRing.
#include "net/key_ring.h"

#include <sys/stat.h>

#include <algorithm>

#include "net/key_folder.h"
#include "net/meeting_place.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

constexpr int kAuthority_days = 3'650;

}  // namespace

Result<> check_holder_name(const std::string& name) {
    if (is_file_name(name, 64)) return Ok{};
    return Error{"'" + name + "' is no name for a key",
                 "use at most 64 letters, digits, - _ and dots, and no dot at the start", "bad-name"};
}

Result<KeyRing> KeyRing::open(const fs::path& folder) {
    std::error_code error;
    KeyRing ring(folder);
    if (fs::exists(folder / "authority.key", error)) return ring;
    if (fs::exists(folder, error) && !fs::is_empty(folder, error))
        return Error{folder.string() + " is no folder of keys: it has no authority.key",
                     "name an empty or a new folder", "no-keys"};
    ::mkdir(folder.c_str(), 0700);
    const Result<KeyPair> authority = new_authority("roboss", kAuthority_days);
    if (!authority) return authority.error();
    if (Result<> written = write_private(folder / "authority.crt", authority.value().certificate); !written)
        return written.error();
    if (Result<> written = write_private(folder / "authority.key", authority.value().key); !written)
        return written.error();
    return ring;
}

bool KeyRing::has(const std::string& name) const {
    std::error_code error;
    return fs::exists(folder_ / name / "member.crt", error);
}

Result<> KeyRing::add(const std::string& name, Seat seat, int days, const Rights& rights) {
    if (Result<> named = check_holder_name(name); !named) return named;
    if (has(name))
        return Error{"'" + name + "' has a key already", "use it, or revoke it first", "key-exists"};
    const Result<std::string> certificate = read_text(folder_ / "authority.crt"),
                              key = read_text(folder_ / "authority.key");
    if (!certificate) return certificate.error();
    if (!key) return key.error();
    Result<KeyPair> own =
        new_certificate({certificate.value(), key.value()}, {name, seat, {}, {}, rights}, days);
    if (!own) return own.error();
    return write_keys(folder_ / name, {certificate.value(), std::move(own).value(), {}});
}

Result<Credentials> KeyRing::credentials(const std::string& name) const {
    return read_keys(folder_ / name);
}

Result<std::vector<Holder>> KeyRing::holders() const {
    std::vector<Holder> all;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
        if (!entry.is_directory(error) || !has(entry.path().filename().string())) continue;
        const Result<std::string> certificate = read_text(entry.path() / "member.crt");
        if (!certificate) return certificate.error();
        Result<Holder> holder = holder_of(certificate.value());
        if (!holder)
            return Error{(entry.path() / "member.crt").string() + ": " + holder.error().message,
                         holder.error().remedy, holder.error().code};
        all.push_back(std::move(holder).value());
    }
    std::ranges::sort(all, {}, &Holder::name);
    return all;
}

Result<> KeyRing::revoke(const std::string& name) {
    const Result<std::vector<Holder>> all = holders();
    if (!all) return all.error();
    const auto found = std::ranges::find(all.value(), name, &Holder::name);
    if (found == all.value().end())
        return Error{"there is no key of '" + name + "'", "`roboss keys list` lists them", "no-key"};
    for (const Holder& holder : all.value()) {
        if (holder.seat != Seat::kController) continue;
        const fs::path list = folder_ / holder.name / "revoked";
        std::error_code error;
        std::string text;
        if (fs::exists(list, error)) {
            Result<std::string> read = read_text(list);
            if (!read) return read.error();
            text = std::move(read).value();
        }
        if (Result<> written = write_private(list, text + found->serial + " " + name + "\n"); !written)
            return written;
    }
    std::error_code error;
    fs::remove_all(folder_ / name, error);
    return Ok{};
}

}  // namespace roboss
