// When the programs of the cells print their counts, where, and how they keep numbers in saved runs.
#pragma once

#include <string>

namespace arm_cell {

/// ROBOSS_CELLS_REPORT: simulated time between two reports, s; or 600.
double report_period_s();

/// Prints the line, and writes it to the file that the environment variable names, if it is set.
void report(const std::string& line, const char* variable);

/// The number so that reading it gives the same bits.
std::string exact(double value);

}  // namespace arm_cell
