// Ctrl-C and SIGTERM: the first one asks to end in good order, the second one ends at once.
#pragma once

namespace roboss {

void watch_for_interrupts();
bool interrupted();

}  // namespace roboss
