// Counts the allocations of the whole program. The source file replaces the global operator new, so it is
// linked only into benchmarks.
#pragma once

#include <cstdint>

namespace roboss::bench {

/// How often operator new was called since the program's start, by any thread.
std::uint64_t allocations();

}  // namespace roboss::bench
