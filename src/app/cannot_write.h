// What is said where a file that was asked for cannot be written.
#pragma once

#include <cerrno>
#include <cstring>
#include <string>

#include "core/result.h"

namespace roboss {

/// `what`: the file, in words; `why`: the system's reason.
inline Error cannot_write(const std::string& what, const std::string& why = std::strerror(errno)) {
    return Error{"cannot write " + what + ": " + why, "check the folder, its rights and the space left"};
}

}  // namespace roboss
