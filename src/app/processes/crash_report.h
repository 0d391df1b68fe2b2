// A crash in a control program: a message that names its library and says how to go on, instead of nothing.
#pragma once

#include <string>

namespace roboss {

/// From now on SIGSEGV, SIGBUS, SIGILL, SIGFPE and SIGABRT print which code crashed, then end the process as
/// they would have (with a core file, if the system writes any). `journal`: file that the run can be
/// continued from; empty: none.
void report_crashes(const std::string& journal);

}  // namespace roboss
