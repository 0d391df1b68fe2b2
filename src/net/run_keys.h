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

}  // namespace roboss
