// Exit codes of the subcommands; their --help lists them.
#pragma once

namespace roboss {

enum ExitCode {
    kSuccess = 0,
    kBadInput = 1,
    kWrongUsage = 2,
    kRunFailed = 3,
    kProcessesFailed = 4,  // Simulator processes that the run started ended or never joined
    kInterrupted = 130
};

}  // namespace roboss
