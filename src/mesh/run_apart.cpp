// The copy has the thread that called, and no other: `work` must not wait for other threads. It writes its
// result into a pipe; a result is whole if the mark stands before it and its length is right. glibc makes
// memory allocation safe behind a fork.
#include "mesh/run_apart.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>

namespace roboss {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kMark = 0x726f626f73733031;

Error ended(const std::string& how) {
    return {"is no mesh that can be read: its reader " + how, "Export it anew, best as STL or OBJ.",
            "reader-ended"};
}

/// Its memory is limited from what the program has already: address sanitizers reserve much of it.
void limit_memory(std::size_t bytes) {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t most = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + bytes;
    const rlimit memory{most, most}, none{0, 0};
    (void)setrlimit(RLIMIT_AS, &memory);
    (void)setrlimit(RLIMIT_CORE, &none);
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

[[noreturn]] void work_and_end(int pipe, const std::function<std::string()>& work,
                               const ApartLimits& limits) {
    for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGINT, SIGTERM})
        (void)std::signal(number, SIG_DFL);
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);  // it holds the locks and sockets of the program
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) (void)dup2(nowhere, STDERR_FILENO);  // what libraries say at their end
    limit_memory(limits.bytes);
    try {
        const std::string result = work();
        const std::array<std::uint64_t, 2> head{kMark, result.size()};
        write_all(pipe, head.data(), sizeof head);
        write_all(pipe, result.data(), result.size());
    } catch (...) {
        _exit(1);
    }
    _exit(0);
}

/// All that comes until the pipe is closed; false: it took too long.
bool read_all(int pipe, const ApartLimits& limits, std::string& bytes) {
    const auto end = Clock::now() + std::chrono::seconds(limits.seconds);
    std::array<char, 65536> part;
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        pollfd wait{pipe, POLLIN, 0};
        const int ready = left <= 0 ? 0 : poll(&wait, 1, static_cast<int>(left));
        if (ready < 0 && errno == EINTR) continue;
        if (ready <= 0 || bytes.size() > limits.bytes) return false;
        const ssize_t count = read(pipe, part.data(), part.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return true;
        bytes.append(part.data(), static_cast<std::size_t>(count));
    }
}

Result<std::string> taken(const std::string& bytes) {
    std::array<std::uint64_t, 2> head{};
    if (bytes.size() < sizeof head) return ended("ended by itself, as the file is damaged");
    std::memcpy(head.data(), bytes.data(), sizeof head);
    if (head[0] != kMark || head[1] != bytes.size() - sizeof head)
        return ended("ended by itself, as the file is damaged");
    return bytes.substr(sizeof head);
}

}  // namespace

Result<std::string> run_apart(const std::function<std::string()>& work, const ApartLimits& limits) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return ended("cannot be started: no pipe is left");
    const pid_t id = fork();
    if (id == 0) work_and_end(ends[1], work, limits);
    (void)close(ends[1]);
    std::string bytes;
    const bool in_time = id > 0 && read_all(ends[0], limits, bytes);
    (void)close(ends[0]);
    if (id < 0) return ended("cannot be started: no process is left");
    if (!in_time) (void)kill(id, SIGKILL);
    while (waitpid(id, nullptr, 0) < 0 && errno == EINTR) {
    }
    if (!in_time) return ended("took more than " + std::to_string(limits.seconds) + " s or too much memory");
    return taken(bytes);
}

}  // namespace roboss
