// Ctrl-C, SIGTERM and SIGHUP: the first one requests an orderly end, the second one ends the process
// immediately.
#pragma once

namespace roboss {

void watch_for_interrupts();
bool interrupted();

}  // namespace roboss
