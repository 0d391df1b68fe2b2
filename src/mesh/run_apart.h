// Runs a reader of files that may be damaged in a process of its own: if it crashes or hangs, the program
// continues.
#pragma once

#include <functional>
#include <string>

#include "core/result.h"

namespace roboss {

struct ApartLimits {
    int seconds = 600;                         // while this process is not stopped
    std::size_t bytes = std::size_t{4} << 30;  // of memory, beyond what this process has
    int cpu_seconds = 60;
};

/// What `work` gives, as it was made in a copy of this process that ends with it. Errors: the copy ended by
/// itself (reader-ended), passed a limit (reader-limit), was ended by a signal from outside (reader-stopped),
/// or could not be made (reader-not-started); the message continues the name of a file.
Result<std::string> run_apart(const std::function<std::string()>& work, const ApartLimits& limits = {});

}  // namespace roboss
