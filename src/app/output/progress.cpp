// Writes the progress line to standard error.
#include "app/output/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace roboss {

Progress::Progress(bool wanted) : on_(wanted && isatty(STDERR_FILENO) == 1) {}

void Progress::show(const Simulation& simulation, const std::string& more) {
    const auto now = Clock::now();
    const double since_s = std::chrono::duration<double>(now - last_).count();
    if (!on_ || since_s < 0.5) return;
    const Counters& c = simulation.counters();
    const double factor = last_time_s_ < 0 ? 0.0 : (simulation.time_s() - last_time_s_) / since_s;
    const std::uint64_t ticks = c.ticks - last_ticks_;
    const double contacts =
        ticks > 0 ? static_cast<double>(c.contacts - last_contacts_) / static_cast<double>(ticks) : 0.0;
    const std::string line = fmt::format(
        "\r{:9.2f} s  {:6.1f} x real time  {} robots  {} islands  {:.0f} contacts  {} ", simulation.time_s(),
        factor, simulation.model().robots.size(), c.islands_now, contacts, more);
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
    line_open_ = true;
    last_ = now;
    last_time_s_ = simulation.time_s();
    last_contacts_ = c.contacts;
    last_ticks_ = c.ticks;
}

void Progress::clear() {
    if (line_open_) std::fputc('\n', stderr);
    line_open_ = false;
}

}  // namespace roboss
