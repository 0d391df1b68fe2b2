// The two programs of the processes of a Crew (crew.h): the centre, which measures, and a member, which sends
// back whatever comes.
#pragma once

#include <string>

namespace roboss::bench {

/// Answers the questions that come as lines from `questions` with a number each, until the end of file:
/// "joined", "round-trip BYTES", "barrier BYTES", "vanished". Writes a first number when it listens.
[[noreturn]] void run_centre(const std::string& run, int members, int questions, int answers);
/// Ends when this process is killed.
[[noreturn]] void run_member(const std::string& run, int number);

/// Nanoseconds of a clock that all processes share.
long long shared_clock_ns();

}  // namespace roboss::bench
