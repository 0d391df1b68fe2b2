// See onboard_kinds/command_timeout.h.
#include <algorithm>

#include "onboard/controllers.h"

namespace roboss {

void run(const CommandTimeoutSpec& spec, OnboardContext& c) {
    if (!c.is_commanded(0)) return;
    if (std::ranges::all_of(c.command(0), [](double value) { return value == 0; })) return;
    const double age = static_cast<double>(c.tick() - c.commanded_at(0)) * c.dt();
    if (age <= spec.timeout) return;
    const double still[6] = {};
    c.give_command(0, still);
}

}  // namespace roboss
