// KeyRing: the authority of a cluster and the keys that it has made, as a folder:
//   authority.crt, authority.key    the authority; its key makes and revokes, and never leaves this folder
//   NAME/                           the keys of a holder (net/key_folder.h): the folder for its --keys
// Certificates that were revoked are listed in the folders of all Controllers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "net/certificates.h"
#include "net/tls.h"

namespace roboss {

class KeyRing {
  public:
    /// Opens one, or makes it with a new authority. An Error: the folder holds other things, or cannot be
    /// written.
    static Result<KeyRing> open(const std::filesystem::path& folder);

    /// Makes a key for a holder. An Error [key-exists]: the name has one already; [bad-rights]: only those of
    /// a Client can be limited.
    Result<> add(const std::string& name, Seat seat, int days, const Rights& rights = {});
    /// The keys of a holder.
    Result<Credentials> credentials(const std::string& name) const;
    bool has(const std::string& name) const;
    /// From the next connection on, no Controller accepts this certificate. Its folder is removed.
    Result<> revoke(const std::string& name);
    /// All holders, by name.
    Result<std::vector<Holder>> holders() const;

  private:
    explicit KeyRing(std::filesystem::path folder) : folder_(std::move(folder)) {}
    std::filesystem::path folder_;
};

/// Names of holders become names of folders: letters, digits, - _ and dots.
Result<> check_holder_name(const std::string& name);

}  // namespace roboss
