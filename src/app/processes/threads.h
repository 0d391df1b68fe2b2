// The default number of threads of a Simulator.
#pragma once

namespace roboss {

/// Processors that this process may use: those it is bound to, at most what its container's quota allows.
int cores();

/// For each of so many processes of this computer: `asked`, or, where that is 0, an equal share of the cores.
int threads_of_each(int asked, int processes);

}  // namespace roboss
