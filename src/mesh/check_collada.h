// What assimp 5.2 does not check in COLLADA, and what it then breaks on: reading beyond arrays, asserts that
// end the program, loops without end. Checked before assimp sees the file.
#pragma once

#include <string>

#include "core/result.h"

namespace roboss {

/// An Error names the line. `path` is for its remedy; the text is that of the file.
Result<> check_collada(const std::string& path, const std::string& text);

}  // namespace roboss
