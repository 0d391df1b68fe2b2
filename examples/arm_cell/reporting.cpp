#include "reporting.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "../result_file.h"

namespace arm_cell {

namespace {

constexpr double kRounding_s = 1e-6;  // of sums of periods

}  // namespace

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
    if (now_s_ > 0) step_s_ = now_s - now_s_;
    now_s_ = now_s;
    if (now_s < last_s + period_s_) return false;
    last_s += period_s_;
    return has_reported_ = true;
}

std::optional<double> Reports::at_end() const {
    if (!(now_s_ > 0)) return std::nullopt;
    const double end_s = now_s_ + step_s_;
    if (has_reported_ && end_s + kRounding_s < last_s + period_s_) return std::nullopt;
    return end_s;
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

std::string whole_seconds(double time_s) {
    return std::to_string(static_cast<long>(std::floor(time_s + kRounding_s)));
}

std::string exact(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

}  // namespace arm_cell
