// The error for an output file that cannot be written.
#pragma once

#include <cerrno>
#include <cstring>
#include <string>

#include "core/result.h"

namespace roboss {

/// `what`: what the file is, with a space behind it; `why`: the system's reason.
inline Error cannot_write(const std::string& path, const std::string& what = "",
                          const std::string& why = std::strerror(errno)) {
    return Error{"cannot write " + what + "'" + path + "': " + why,
                 "check the folder, its permissions and the free space", "not-writable"};
}

}  // namespace roboss
