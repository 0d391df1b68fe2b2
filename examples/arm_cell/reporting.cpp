#include "reporting.h"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "../result_file.h"

namespace arm_cell {

double report_period_s() {
    const char* text = std::getenv("ROBOSS_CELLS_REPORT");
    char* end = nullptr;
    const double seconds = text != nullptr ? std::strtod(text, &end) : 600;
    if (!(seconds >= 1) || (end != nullptr && *end != '\0'))
        throw std::runtime_error(std::string("ROBOSS_CELLS_REPORT is \"") + text +
                                 "\"\n  remedy: give the time between two reports in seconds, at least 1");
    return seconds;
}

bool Reports::is_due(double now_s) {
    now_s_ = now_s;
    if (now_s < last_s + period_s_) return false;
    last_s += period_s_;
    return has_reported_ = true;
}

std::optional<double> Reports::at_end() const {
    if (has_reported_ || !(now_s_ > 0)) return std::nullopt;
    return now_s_;
}

void report(const std::string& line, const char* variable) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
    examples::write_result(line, variable);
}

void report_at_end(const std::function<void()>& report) noexcept {
    try {
        report();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
}

std::string exact(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

}  // namespace arm_cell
