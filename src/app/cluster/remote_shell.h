// Runs a script in a shell, here or on another host, and returns its output.
#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace roboss {

/// Starts `words` (found by PATH), writes `script` to its input, and reads its output until it
/// ends; output from before the script is dropped. An Error if it could not be started, is no shell or ended
/// with a non-zero exit code; the message contains its output.
Result<std::string> run_script(const std::vector<std::string>& words, const std::string& script);

/// Quoted for a shell.
std::string quoted(const std::string& word);

}  // namespace roboss
