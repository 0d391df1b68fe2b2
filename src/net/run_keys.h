// The keys of a run whose Controller was given none: its own, and one for all members of this computer and
// user.
#pragma once

#include <string>

#include "core/result.h"
#include "net/tls.h"

namespace roboss {

struct RunKeys {
    Credentials controller, member;
};

/// Keys of a new authority, whose own key is not kept.
Result<RunKeys> new_run_keys(const std::string& simulation);

/// For the viewer's page of a run that listens at this address: its certificate is good for a year, for all
/// names and addresses of this computer.
Result<KeyPair> new_page_keys(const std::string& address);

}  // namespace roboss
