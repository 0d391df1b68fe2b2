// The rows of a run as a table for people and as JSON for tools.
#pragma once

#include <string>
#include <vector>

#include "peers/contest.h"

namespace roboss::bench {

void print_table(const std::vector<Row>& rows);

/// With commit, compiler, processor and date. False, with a message printed, if the file cannot be written.
bool write_json(const std::string& path, const std::vector<Row>& rows);

}  // namespace roboss::bench
