#include "reporting.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace arm_cell {

double report_period_s() {
    const char* text = std::getenv("ROBOSS_CELLS_REPORT");
    const double seconds = text != nullptr ? std::atof(text) : 600;
    if (!(seconds >= 1))
        throw std::runtime_error(std::string("ROBOSS_CELLS_REPORT is \"") + text +
                                 "\"\n  remedy: give the time between two reports in seconds, at least 1");
    return seconds;
}

void report(const std::string& line, const char* variable) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
    const char* file = std::getenv(variable);
    if (file == nullptr) return;
    std::ofstream out(file);
    out << line << "\n" << std::flush;
    if (!out)
        throw std::runtime_error(std::string("cannot write the report to ") + file + "\n  remedy: set " +
                                 variable + " to a file in a writable folder");
}

std::string exact(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

}  // namespace arm_cell
