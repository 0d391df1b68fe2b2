// The method by which a part of a contact island was solved: docs/how-contacts-are-solved.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace roboss {

/// The last attempt, which succeeded. Those on bodies are of parts that are free bodies alone.
enum class SolveMethod : std::uint8_t {
    kNewton,         // Newton's method, from where the last tick ended
    kAtRest,         // of a pile at rest: its coupled steps alone
    kSweeps,         // sweeps settled it
    kSweptNewton,    // Newton's method from where sweeps ended
    kHardened,       // Newton's method on rows that were soft at first
    kActiveSet,      // a displacement: the rows that push are found in rounds
    kSweptFromRest,  // nothing found a balance: sweeps without a start
    kBodiesNewton,
    kBodiesSweeps,
    kBodiesActiveSet,
    kSoft  // soft substeps, velocities and displacement at once
};
inline constexpr std::size_t kSolveMethods = 11;

/// "swept_newton": for programs.
inline constexpr std::array<const char*, kSolveMethods> kSolveMethodNames{
    "newton",          "at_rest",       "sweeps",        "swept_newton",      "hardened", "active_set",
    "swept_from_rest", "bodies_newton", "bodies_sweeps", "bodies_active_set", "soft"};

/// Parts by the method that solved them.
using SolveCounts = std::array<std::uint64_t, kSolveMethods>;

inline void add_solves(const SolveCounts& from, SolveCounts& to) {
    for (std::size_t m = 0; m < kSolveMethods; ++m) to[m] += from[m];
}

}  // namespace roboss
