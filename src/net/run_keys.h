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

/// Of an authority that is forgotten at once.
Result<RunKeys> new_run_keys(const std::string& simulation);

}  // namespace roboss
