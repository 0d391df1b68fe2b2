// When the programs of the cells print their counts, where, and how they keep numbers in saved runs.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace arm_cell {

/// ROBOSS_CELLS_REPORT: simulated time between two reports, s, at least 1; or 600.
/// @throws std::runtime_error with a remedy.
double report_period_s();

/// When a program reports: every report_period_s(), also at the end of a run that ends just then, and at the
/// end of a run that was too short for a report.
class Reports {
  public:
    void start() { period_s_ = report_period_s(); }
    /// Whether a report is due. Called at each control().
    bool is_due(double now_s);
    /// The time of a report at the end, s: a period behind the last control(), to which its orders applied.
    /// std::nullopt if there was a report before and none is due yet, or no control() at all.
    std::optional<double> at_end() const;

    double last_s = 0;  // when the last one was due; part of a saved run

  private:
    double period_s_ = 0, now_s_ = 0;
    double step_s_ = 0;  // between the last two control()
    bool has_reported_ = false;
};

/// Prints the line, and writes it to the file that the environment variable names, if it is set.
void report(const std::string& line, const char* variable);

/// Reports from a destructor: what fails is printed, not thrown.
void report_at_end(const std::function<void()>& report) noexcept;

/// The time in whole seconds, as reports have it.
std::string whole_seconds(double time_s);

/// The number so that reading it gives the same bits.
std::string exact(double value);

}  // namespace arm_cell
