// MemoryGuard: notices that this process is at its memory limit while there is still enough left to say so.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace roboss {

class MemoryGuard {
  public:
    /// From now on some memory is kept in reserve. The allocation that fails first gets it; one that fails
    /// after that ends the process with a message and exit code 3. One guard in a process.
    MemoryGuard();
    ~MemoryGuard();
    MemoryGuard(const MemoryGuard&) = delete;
    MemoryGuard& operator=(const MemoryGuard&) = delete;

    /// The reason for which this process has to end; nothing while there is memory. Callers ask often: every
    /// half second it looks at the limits of the control group (of a container, say).
    std::optional<std::string> exceeded();

  private:
    std::int64_t looked_ms_ = 0, near_ms_ = 0;
};

/// Bytes that a control group may use, and uses; nothing: it has no limit, or is none. `folder`: its files,
/// of version 2 of control groups.
struct MemoryUse {
    std::uint64_t used = 0, limit = 0;
};
std::optional<MemoryUse> memory_of_group(const std::string& folder);
/// The folder of the control group that `text` (/proc/self/cgroup) names, below `root`.
std::string folder_of_group(const std::string& text, const std::string& root);

}  // namespace roboss
