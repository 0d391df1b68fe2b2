// fork, exec and two pipes.
#include "app/cluster/remote_shell.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace roboss {
namespace {

constexpr const char* kBegins = "roboss-script-begins";

/// Both ends are closed when this process goes on to another program.
struct Pipe {
    std::array<int, 2> ends{-1, -1};
    bool open() { return pipe2(ends.data(), O_CLOEXEC) == 0; }
    void close_end(std::size_t i) {
        if (ends[i] >= 0) ::close(ends[i]);
        ends[i] = -1;
    }
    ~Pipe() { close_end(0), close_end(1); }
};

void write_all(int to, const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t n = ::write(to, text.data() + done, text.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return;  // it stopped reading: its exit code gives the reason
        done += static_cast<std::size_t>(n);
    }
}

std::string read_all(int from) {
    std::string text;
    std::array<char, 4096> buffer{};
    for (;;) {
        const ssize_t n = ::read(from, buffer.data(), buffer.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return text;
        text.append(buffer.data(), static_cast<std::size_t>(n));
    }
}

/// Removes output from before the script began (of ssh, the host or .bashrc). False if the script never
/// began.
bool drop_greeting(std::string& output) {
    const std::size_t at = output.find(kBegins);
    if (at == std::string::npos) return false;
    output.erase(0, at + std::strlen(kBegins) + 1);
    return true;
}

}  // namespace

std::string quoted(const std::string& word) {
    std::string result = "'";
    for (const char c : word) result += c == '\'' ? "'\\''" : std::string(1, c);
    return result + "'";
}

Result<std::string> run_script(const std::vector<std::string>& words, const std::string& script) {
    Pipe in, out;
    if (!in.open() || !out.open())
        return Error{std::string("no pipe: ") + std::strerror(errno), "see the limits (ulimit -n)"};
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    const pid_t id = fork();
    if (id < 0)
        return Error{std::string("a process could not be started: ") + std::strerror(errno),
                     "see the limits (ulimit -u)"};
    if (id == 0) {
        dup2(in.ends[0], STDIN_FILENO);
        dup2(out.ends[1], STDOUT_FILENO);
        dup2(out.ends[1], STDERR_FILENO);
        ::signal(SIGPIPE, SIG_DFL);
        execvp(pointers[0], pointers.data());
        _exit(127);
    }
    in.close_end(0), out.close_end(1);
    ::signal(SIGPIPE, SIG_IGN);
    write_all(in.ends[1], "echo " + std::string(kBegins) + "\n" + script);
    in.close_end(1);
    std::string output = read_all(out.ends[0]);
    int status = 0;
    while (waitpid(id, &status, 0) < 0 && errno == EINTR) {
    }
    const bool is_shell = drop_greeting(output);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && is_shell) return output;
    while (!output.empty() && output.back() == '\n') output.pop_back();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127 && output.empty())
        return Error{"'" + words[0] + "' is not found here",
                     "install it, or set another command with reach = [...]", "no-shell"};
    if (output.empty()) output = "ended with exit code " + std::to_string(WEXITSTATUS(status));
    if (is_shell) return Error{output, ""};
    std::string command;
    for (const std::string& word : words) command += " " + word;
    return Error{output, "this command must start a shell without a prompt:" + command, "no-shell"};
}

}  // namespace roboss
