// When the programs of the cells print their counts, where, and how they keep numbers in saved runs.
#pragma once

#include <functional>
#include <string>

namespace arm_cell {

/// ROBOSS_CELLS_REPORT: simulated time between two reports, s, at least 1; or 600.
/// @throws std::runtime_error with a remedy.
double report_period_s();

/// Prints the line, and writes it to the file that the environment variable names, if it is set.
void report(const std::string& line, const char* variable);

/// Reports from a destructor: what fails is printed, not thrown.
void report_at_end(const std::function<void()>& report) noexcept;

/// The number so that reading it gives the same bits.
std::string exact(double value);

}  // namespace arm_cell
