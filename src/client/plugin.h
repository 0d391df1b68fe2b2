// Loads a control program from a shared library (see control_program.h for what the library must have).
#pragma once

#include <memory>
#include <string>

#include "client/control_program.h"
#include "core/result.h"

namespace roboss {

/// The program out of the library at `path`. The library stays loaded for the rest of the process, since
/// objects made by its code may outlive the program. An Error says what is missing: the file, the entry
/// point, or the right version.
Result<std::unique_ptr<ControlProgram>> load_control_program(const std::string& path);

}  // namespace roboss
