// What a message costs over the real Bus: two members of a run on this computer, a thread each, send each
// other messages of an assignment's size over TLS on the loopback interface.
#pragma once

#include "cluster/virtual_network.h"

namespace roboss::bench {

/// Medians of `rounds` round trips. Throws std::runtime_error if the network cannot be had.
NetworkCosts measure_network(int rounds);

}  // namespace roboss::bench
