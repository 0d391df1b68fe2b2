// The handler only writes what was prepared before: after a crash no memory may be allocated.
#include "app/processes/crash_report.h"

#include <dlfcn.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

#include "client/user_code.h"

namespace roboss {
namespace {

constexpr std::array kSignals{SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
std::array<char, 4096> g_journal{};
std::array<char, 64 * 1024> g_stack{};  // of the handler: the crash may be an overflow of the other one

void write_text(const char* text) {
    (void)!::write(STDERR_FILENO, text, std::strlen(text));
}

const char* name_of(int signal) {
    switch (signal) {
        case SIGSEGV:
            return "segmentation fault (SIGSEGV)";
        case SIGBUS:
            return "bus error (SIGBUS)";
        case SIGILL:
            return "illegal instruction (SIGILL)";
        case SIGFPE:
            return "arithmetic error (SIGFPE)";
        default:
            return "abort (SIGABRT), for example by an exception that nothing caught";
    }
}

/// The library whose code was running; null: not known. Of an abort it is the C library.
const char* library_at(void* context) {
    void* at = nullptr;
#if defined(__x86_64__)
    at = reinterpret_cast<void*>(static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__)
    at = reinterpret_cast<void*>(static_cast<ucontext_t*>(context)->uc_mcontext.pc);
#endif
    Dl_info found{};
    return at != nullptr && ::dladdr(at, &found) != 0 ? found.dli_fname : nullptr;
}

void on_crash(int signal, siginfo_t*, void* context) {
    write_text("\nroboss: ");
    if (const UserCode* code = UserCode::running()) {
        write_text("the control program ");
        write_text(code->program());
        write_text(" crashed in ");
        write_text(code->what());
    } else {
        write_text("crashed");
    }
    write_text(": ");
    write_text(name_of(signal));
    if (const char* library = signal == SIGABRT ? nullptr : library_at(context)) {
        write_text(", in the code of ");
        write_text(library);
    }
    write_text(UserCode::running() != nullptr
                   ? " [client-crashed]\n  remedy: fix the control program"
                   : " [crashed]\n  remedy: report it, with the command and its files");
    if (g_journal[0] != 0) {
        write_text("; the journal ");
        write_text(g_journal.data());
        write_text(" is intact, and the same command continues from it");
    }
    write_text("\n");
    std::signal(signal, SIG_DFL);
    (void)::raise(signal);
}

}  // namespace

void report_crashes(const std::string& journal) {
    std::strncpy(g_journal.data(), journal.c_str(), g_journal.size() - 1);
    stack_t stack{};
    stack.ss_sp = g_stack.data();
    stack.ss_size = g_stack.size();
    (void)::sigaltstack(&stack, nullptr);
    struct sigaction action {};
    action.sa_sigaction = on_crash;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | static_cast<int>(SA_RESETHAND);
    for (const int signal : kSignals) (void)::sigaction(signal, &action, nullptr);
}

}  // namespace roboss
