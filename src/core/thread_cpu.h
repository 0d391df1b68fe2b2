// The CPU time of a thread: for balance, telemetry and benchmarks, never for results.
#pragma once

#include <cstdint>

namespace roboss {

/// CPU time of the calling thread, ns.
std::uint64_t thread_cpu_ns();

}  // namespace roboss
