// Reads MCAP files (https://mcap.dev/spec) from their first record to their last, without their index: so a
// file whose writer was interrupted is read as far as it goes.
#pragma once

#include <string_view>

#include "bags/intake.h"

namespace roboss::bags {

/// The first and the last bytes of a file.
inline constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);

/// Hands on the messages of the file of this intake. An Error names the byte at which its record begins. A
/// file that ends in the middle is a warning, "truncated".
Result<> read_mcap(Intake& intake, Diagnostics& diagnostics);

}  // namespace roboss::bags
