// fork and exec of this same executable.
#include "app/processes/local_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>
#include <utility>

namespace roboss {

std::string process_name(pid_t process) {
    char host[256] = {};
    gethostname(host, sizeof host - 1);
    return std::string(host) + "/" + std::to_string(process);
}

namespace {

constexpr off_t kLogRead = 4096;  // bytes of a log's end

std::string name_of_signal(int number) {
    const char* name = sigabbrev_np(number);
    return name == nullptr ? "signal " + std::to_string(number) : std::string("SIG") + name;
}

/// Between fork and exec, so only calls that are safe there.
[[noreturn]] void become(char* const* words, pid_t parent, int log) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    setpgid(0, 0);  // Ctrl-C is for the parent, which ends this one
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    close_range(3, ~0u, 0);
    execv("/proc/self/exe", words);
    _exit(127);
}

}  // namespace

Result<LocalProcess> LocalProcess::start(const std::vector<std::string>& arguments) {
    std::vector<char*> words;
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    const int log = memfd_create("roboss-log", MFD_CLOEXEC);
    if (log < 0)
        return Error{std::string("no log can be created for a process: ") + std::strerror(errno),
                     "see the limits (ulimit -n)"};
    fcntl(log, F_SETFL, O_APPEND);
    const pid_t parent = getpid();
    const pid_t id = fork();
    if (id == 0) become(words.data(), parent, log);
    if (id < 0) {
        const int reason = errno;
        close(log);
        return Error{std::string("a process could not be started: ") + std::strerror(reason),
                     "see the limits (ulimit -u)"};
    }
    return LocalProcess(id, log);
}

LocalProcess::LocalProcess(LocalProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      log_(std::exchange(other.log_, -1)),
      read_(other.read_),
      status_(other.status_) {}

LocalProcess& LocalProcess::operator=(LocalProcess&& other) noexcept {
    std::swap(id_, other.id_);  // the other one ends what this one had
    std::swap(log_, other.log_);
    std::swap(read_, other.read_);
    std::swap(status_, other.status_);
    return *this;
}

LocalProcess::~LocalProcess() {
    if (id_ >= 0 && !ended()) {
        kill();
        waitpid(id_, nullptr, 0);
    }
    if (log_ >= 0) close(log_);
}

void LocalProcess::kill() {
    if (!ended()) ::kill(id_, SIGKILL);
}

std::optional<std::string> LocalProcess::ended() {
    int status = 0;
    if (!status_ && waitpid(id_, &status, WNOHANG) == id_) status_ = status;
    if (!status_) return {};
    if (WIFSIGNALED(*status_)) return "was killed by " + name_of_signal(WTERMSIG(*status_));
    return "ended with exit code " + std::to_string(WEXITSTATUS(*status_));
}

std::optional<int> LocalProcess::exit_code() {
    return ended() && WIFEXITED(*status_) ? std::optional(WEXITSTATUS(*status_)) : std::nullopt;
}

bool LocalProcess::wait(int ms_max) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(ms_max);
    while (!ended() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return ended().has_value();
}

std::string LocalProcess::doing() const {
    std::ifstream file("/proc/" + std::to_string(id_) + "/stat");
    std::string line;
    std::getline(file, line);
    const std::size_t name_end = line.rfind(") ");  // the name before it may hold anything
    const char state = name_end == std::string::npos ? '?' : line[name_end + 2];
    if (state == 'T' || state == 't') return "stopped (SIGSTOP or a debugger)";
    if (state == 'D') return "waiting for a disk or another device";
    return state == '?' ? "unknown" : "running";
}

std::string LocalProcess::last_lines(std::size_t count) const {
    const off_t end = lseek(log_, 0, SEEK_END), from = std::max<off_t>(end - kLogRead, 0);
    if (end <= 0 || count == 0) return {};
    std::string text(static_cast<std::size_t>(end - from), '\0');
    const ssize_t got = pread(log_, text.data(), text.size(), from);
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::size_t begin = text.size();
    while (count-- > 0 && begin != 0 && begin != std::string::npos) begin = text.rfind('\n', begin - 1);
    return begin == std::string::npos || begin == 0 ? text : text.substr(begin + 1);
}

std::vector<std::string> LocalProcess::new_lines() {
    std::string text;
    char part[kLogRead];
    for (ssize_t got = 0;
         (got = pread(log_, part, sizeof part, read_ + static_cast<off_t>(text.size()))) > 0;)
        text.append(part, static_cast<std::size_t>(got));
    std::vector<std::string> lines;
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
        lines.push_back(text.substr(begin, end - begin));
    read_ += static_cast<std::int64_t>(begin);
    return lines;
}

}  // namespace roboss
