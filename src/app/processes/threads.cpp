// Affinity and cgroup.
#include "app/processes/threads.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace roboss {
namespace {

/// Of a container, in processors (cgroup v2); without one, or without a quota, more than any computer has.
int quota() {
    constexpr int kNone = 1 << 20;
    std::ifstream file("/sys/fs/cgroup/cpu.max");
    double in_period = 0, period = 0;
    if (!(file >> in_period >> period) || in_period <= 0 || period <= 0) return kNone;
    return static_cast<int>(std::min<double>(std::ceil(in_period / period), kNone));
}

int bound_to() {
    cpu_set_t set;
    CPU_ZERO(&set);
    return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

}  // namespace

int cores() {
    return std::max(1, std::min(bound_to(), quota()));
}

int threads_of_each(int asked, int processes) {
    return asked > 0 ? asked : std::max(1, cores() / std::max(processes, 1));
}

}  // namespace roboss
