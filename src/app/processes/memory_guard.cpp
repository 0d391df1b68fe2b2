// A new-handler, and the files of the control group.
#include "app/processes/memory_guard.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <fstream>
#include <new>
#include <sstream>

#include "app/commands/exit_codes.h"
#include "bus/bus.h"

namespace roboss {
namespace {

constexpr std::size_t kReserve = std::size_t{16} << 20;
constexpr std::int64_t kLook_ms = 500;
constexpr int kTurns = 8;
constexpr double kMostMemory = .97;  // of the limit of a control group: beyond it the kernel kills soon

std::atomic<char*> g_reserve = nullptr;
std::atomic<bool> g_failed = false;

/// Any thread, in the middle of anything: it may not allocate.
void on_failure() {
    g_failed = true;
    if (char* reserve = g_reserve.exchange(nullptr)) return delete[] reserve;
    constexpr char kText[] = "roboss: the memory is not enough: its limit is reached [out-of-memory]\n";
    (void)!::write(STDERR_FILENO, kText, sizeof kText - 1);
    _exit(kRunFailed);
}

std::string first_line(const std::string& file) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    return line;
}

}  // namespace

MemoryGuard::MemoryGuard() {
    char* reserve = new char[kReserve];
    std::memset(reserve, 1, kReserve);  // the pages are there, whatever the kernel promised
    delete[] g_reserve.exchange(reserve);
    g_failed = false;
    std::set_new_handler(on_failure);
}

MemoryGuard::~MemoryGuard() {
    std::set_new_handler(nullptr);
    delete[] g_reserve.exchange(nullptr);
}

std::string folder_of_group(const std::string& text, const std::string& root) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line.rfind("0::", 0) == 0) return root + line.substr(3);
    return root;
}

std::optional<MemoryUse> memory_of_group(const std::string& folder) {
    MemoryUse use;
    // "max" is no number: no limit.
    if (!(std::istringstream(first_line(folder + "/memory.max")) >> use.limit) || use.limit == 0) return {};
    if (!(std::istringstream(first_line(folder + "/memory.current")) >> use.used)) return {};
    std::ifstream parts(folder + "/memory.stat");  // files that the kernel gives up first do not count
    std::uint64_t bytes = 0;
    for (std::string name; parts >> name >> bytes;)
        if (name == "inactive_file" || name == "active_file") use.used -= std::min(use.used, bytes);
    return use;
}

std::optional<std::string> MemoryGuard::exceeded() {
    if (g_failed) return "its memory is not enough: the limit of the process is reached";
    const std::int64_t now = monotonic_ms();
    if (now - looked_ms_ < kLook_ms) return {};
    looked_ms_ = now;
    std::ifstream groups("/proc/self/cgroup");
    std::ostringstream text;
    text << groups.rdbuf();
    const auto use = memory_of_group(folder_of_group(text.str(), "/sys/fs/cgroup"));
    if (!use || static_cast<double>(use->used) < kMostMemory * static_cast<double>(use->limit))
        return near_ms_ = 0, std::nullopt;
    // Several processes may share the group: when one has left, there may be enough for the others.
    if (near_ms_ == 0) near_ms_ = now;
    if (now - near_ms_ < getpid() % kTurns * kLook_ms) return {};
    return "its memory is not enough: " + std::to_string(use->used >> 20) + " of " +
           std::to_string(use->limit >> 20) + " MiB of its control group are used";
}

}  // namespace roboss
