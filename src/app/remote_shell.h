// A shell on some host, which is given a script and says something.
#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace roboss {

/// Starts `words` (found by PATH), writes `script` to its input, and reads what the script says until it
/// ends; what others say before is dropped. An Error: it could not be started, is no shell or ended with
/// another code than 0; then with what it complained of.
Result<std::string> run_script(const std::vector<std::string>& words, const std::string& script);

/// As one word of a shell.
std::string quoted(const std::string& word);

}  // namespace roboss
