// Remedies for a refused process, by the code of the refusal.
#pragma once

#include <string>

namespace roboss {

inline const char* remedy_for(const std::string& code) {
    if (code == "bad-certificate") return "give this process a key of the run: see `roboss keys` and --keys";
    if (code == "other-version") return "run the same version of RoBOSS everywhere";
    if (code == "other-simulation") return "give the name of that run with --simulation";
    if (code == "no-room") return "raise that limit (ulimit -n), or let fewer processes take part";
    return "see the log of the Controller";
}

}  // namespace roboss
