// Reads SQLite files of rosbag2 (.db3).
#pragma once

#include <string_view>

#include "bags/intake.h"

namespace roboss::bags {

/// The first bytes of a file.
inline constexpr std::string_view kSqliteMagic("SQLite format 3\0", 16);

/// Hands on the messages of the file of this intake.
Result<> read_db3(Intake& intake);

}  // namespace roboss::bags
