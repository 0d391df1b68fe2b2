// How the subcommands that run something end; their --help says the same.
#pragma once

namespace roboss {

enum ExitCode {
    kDone = 0,
    kBadInput = 1,
    kRunFailed = 3,
    kProcessesFailed = 4,  // Simulator processes of this run's own died or never joined
    kInterrupted = 130
};

}  // namespace roboss
