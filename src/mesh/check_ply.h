// What assimp 5.2 does not check in the head of a PLY file: it reads on without end where the head's end, or
// what the head announces, is missing.
#pragma once

#include <string_view>

#include "core/result.h"

namespace roboss {

/// `bytes` are those of the file.
Result<> check_ply(std::string_view bytes);

}  // namespace roboss
