// The copy has the thread that called, and no other: `work` must not wait for other threads. It writes its
// result into a pipe; a result is whole if the mark stands before it and all that it announces has come.
// glibc makes memory allocation safe behind a fork.
#include "mesh/run_apart.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <mutex>
#include <new>
#include <optional>

namespace roboss {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kMark = 0x726f626f73733031;
constexpr int kNoMemory = 3;  // the copy's exit status
constexpr int kSliceMs = 1000;

using Head = std::array<std::uint64_t, 2>;  // kMark, and how many bytes follow

enum class Came { kWhole, kEnd, kTooLate, kTooMuch };

Error damaged() {
    return {"is no mesh that can be read: its reader ended by itself, as the file is damaged",
            "Export it anew, best as STL or OBJ.", "reader-ended"};
}

Error not_started(const char* what, int number) {
    const std::string why = std::string(what) + ": " + std::strerror(number);
    const bool files = number == EMFILE || number == ENFILE;
    return {"cannot be read now: no process for its reader (" + why + ")",
            files ? "Raise the limit of open files (ulimit -n)."
                  : "Raise the limit of processes (ulimit -u, pids of the container), or free memory.",
            "reader-not-started"};
}

Error too_slow(const std::string& time) {
    return {"is no mesh that can be read: its reader took more than " + time,
            "Export it anew, or give a coarser mesh.", "reader-limit"};
}

Error too_large(std::size_t bytes) {
    return {"is no mesh that can be read: its reader needed more memory than there is (at most " +
                std::to_string(bytes >> 20) + " MiB)",
            "Export it anew, or give a coarser mesh; free memory if the file is sound.", "reader-limit"};
}

Error stopped(int signal) {
    const bool killed = signal == SIGKILL;
    return {"was not read: its reader was ended from outside (" + std::string(strsignal(signal)) + ")",
            killed ? "Free memory if the system has run out of it, and load it again." : "Load it again.",
            "reader-stopped"};
}

void limit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
    rlimit now{};
    if (getrlimit(resource, &now) != 0) return;
    const rlimit least{std::min(soft, now.rlim_max), std::min(hard, now.rlim_max)};
    (void)setrlimit(resource, &least);
}

/// Its memory is limited from what the program has already: address sanitizers reserve much of it.
void limit_copy(const ApartLimits& limits) {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t most = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + limits.bytes;
    const auto seconds = static_cast<rlim_t>(limits.cpu_seconds);
    limit(RLIMIT_AS, most, most);
    limit(RLIMIT_CORE, 0, 0);
    limit(RLIMIT_CPU, seconds, seconds + 1);
}

void write_all(int pipe, const void* data, std::size_t size) {
    const char* at = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = write(pipe, at, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) _exit(1);
        at += written, size -= static_cast<std::size_t>(written);
    }
}

void take_default_signals() {
    sigset_t taken;
    (void)sigemptyset(&taken);
    for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGINT, SIGTERM, SIGXCPU}) {
        (void)std::signal(number, SIG_DFL);
        (void)sigaddset(&taken, number);
    }
    (void)sigprocmask(SIG_UNBLOCK, &taken, nullptr);
}

[[noreturn]] void work_and_end(int given, const std::function<std::string()>& work,
                               const ApartLimits& limits) {
    take_default_signals();
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);  // it holds the locks and sockets of the program
    // Where a standard stream is closed, the pipe may have its number.
    const int pipe = fcntl(given, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (pipe < 0) _exit(1);
    (void)close(given);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) (void)dup2(nowhere, STDERR_FILENO);  // what libraries say at their end
    limit_copy(limits);
    std::set_new_handler([] { _exit(kNoMemory); });  // libraries make other errors of std::bad_alloc
    try {
        const std::string result = work();
        const Head head{kMark, result.size()};
        write_all(pipe, head.data(), sizeof head);
        write_all(pipe, result.data(), result.size());
    } catch (...) {
        _exit(1);
    }
    _exit(0);
}

/// The head, once it has come.
std::optional<Head> head_of(const std::string& bytes) {
    Head head{};
    if (bytes.size() < sizeof head) return std::nullopt;
    std::memcpy(head.data(), bytes.data(), sizeof head);
    return head;
}

/// All that is announced, not up to the pipe's end: processes that others made meanwhile may hold it open.
/// Time counts by slices, so that an hour in which the program was stopped is one of them at most.
Came read_all(int pipe, const ApartLimits& limits, std::string& bytes) {
    std::array<char, 65536> part;
    std::chrono::milliseconds waited{0};
    for (;;) {
        if (const auto head = head_of(bytes)) {
            if ((*head)[0] != kMark) return Came::kEnd;
            if ((*head)[1] > limits.bytes) return Came::kTooMuch;
            if (bytes.size() - sizeof(Head) >= (*head)[1]) return Came::kWhole;
        }
        const bool last = waited > std::chrono::seconds(limits.seconds);
        const auto start = Clock::now();
        pollfd wait{pipe, POLLIN, 0};
        const int ready = poll(&wait, 1, last ? 0 : kSliceMs);
        const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start);
        waited += std::min(took, std::chrono::milliseconds(kSliceMs));
        if (ready == 0 && last) return Came::kTooLate;
        if (ready <= 0) continue;
        const ssize_t count = read(pipe, part.data(), part.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return Came::kEnd;
        bytes.append(part.data(), static_cast<std::size_t>(count));
    }
}

Error why_ended(int status, const ApartLimits& limits) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == kNoMemory) return too_large(limits.bytes);
    if (!WIFSIGNALED(status)) return damaged();
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU) return too_slow(std::to_string(limits.cpu_seconds) + " s of computing time");
    for (const int fault : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS})
        if (signal == fault) return damaged();
    return stopped(signal);
}

struct Copy {
    pid_t id = -1;
    int pipe = -1;
};

/// One at a time: a copy made between another's pipe and its close would hold that pipe open.
Result<Copy> start(const std::function<std::string()>& work, const ApartLimits& limits) {
    static std::mutex one;
    const std::lock_guard lock(one);
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return not_started("pipe", errno);
    const pid_t id = fork();
    const int number = errno;
    if (id == 0) work_and_end(ends[1], work, limits);
    (void)close(ends[1]);
    if (id > 0) return Copy{id, ends[0]};
    (void)close(ends[0]);
    return not_started("fork", number);
}

}  // namespace

Result<std::string> run_apart(const std::function<std::string()>& work, const ApartLimits& limits) {
    const Result<Copy> copy = start(work, limits);
    if (!copy) return copy.error();
    const pid_t id = copy.value().id;
    std::string bytes;
    const Came came = read_all(copy.value().pipe, limits, bytes);
    (void)close(copy.value().pipe);
    if (came == Came::kTooLate || came == Came::kTooMuch) (void)kill(id, SIGKILL);
    int status = 0;
    while (waitpid(id, &status, 0) < 0 && errno == EINTR) {
    }
    if (came == Came::kTooLate) return too_slow(std::to_string(limits.seconds) + " s");
    if (came == Came::kTooMuch) return too_large(limits.bytes);
    if (came == Came::kEnd) return why_ended(status, limits);
    return bytes.substr(sizeof(Head));
}

}  // namespace roboss
