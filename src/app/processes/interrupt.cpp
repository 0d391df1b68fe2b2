// A flag, since nothing else is safe in a signal handler.
#include "app/processes/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace roboss {
namespace {

// Threads that step read it.
std::atomic<int> g_interrupted = 0;
static_assert(std::atomic<int>::is_always_lock_free);

void on_interrupt(int) {
    if (g_interrupted != 0) _exit(130);
    g_interrupted = 1;
}

}  // namespace

void watch_for_interrupts() {
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    // The terminal was closed; under nohup that is ignored.
    if (std::signal(SIGHUP, on_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

bool interrupted() {
    return g_interrupted != 0;
}

}  // namespace roboss
