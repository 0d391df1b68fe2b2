// fork and exec of this same executable.
#include "app/local_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

namespace roboss {

std::string place_name(pid_t process) {
    char host[256] = {};
    gethostname(host, sizeof host - 1);
    return std::string(host) + "/" + std::to_string(process);
}

Result<LocalProcess> LocalProcess::start(const std::vector<std::string>& arguments) {
    std::vector<char*> words;
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    const pid_t parent = getpid();
    const pid_t id = fork();
    if (id < 0)
        return Error{std::string("a process could not be started: ") + std::strerror(errno),
                     "see the limits (ulimit -u)"};
    if (id == 0) {  // only calls that are safe between fork and exec
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) _exit(1);
        setpgid(0, 0);  // Ctrl-C is for the parent, which ends this one
        close_range(3, ~0u, 0);
        execv("/proc/self/exe", words.data());
        _exit(127);
    }
    return LocalProcess(id);
}

LocalProcess::LocalProcess(LocalProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)), ended_(std::move(other.ended_)) {}

LocalProcess& LocalProcess::operator=(LocalProcess&& other) noexcept {
    std::swap(id_, other.id_);  // the other one ends what this one had
    std::swap(ended_, other.ended_);
    return *this;
}

LocalProcess::~LocalProcess() {
    if (id_ < 0 || ended()) return;
    kill();
    waitpid(id_, nullptr, 0);
}

void LocalProcess::kill() {
    if (!ended()) ::kill(id_, SIGKILL);
}

std::optional<std::string> LocalProcess::ended() {
    int status = 0;
    if (ended_ || waitpid(id_, &status, WNOHANG) != id_) return ended_;
    if (WIFSIGNALED(status))
        ended_ = "was killed by signal " + std::to_string(WTERMSIG(status));
    else
        ended_ = "ended with exit code " + std::to_string(WEXITSTATUS(status));
    return ended_;
}

bool LocalProcess::wait(int ms_max) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(ms_max);
    while (!ended() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return ended().has_value();
}

}  // namespace roboss
