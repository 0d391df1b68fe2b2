// Flags that one thread sets when a result is there, and for which others wait.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace roboss {

class ReadyFlags {
  public:
    /// Clears the flags 0 .. count-1; no thread may be at work with them.
    void clear(std::size_t count);
    void set(std::size_t flag);
    /// Returns when the flag is set; what was written before that is visible. The thread that sets it must be
    /// running.
    void wait_for(std::size_t flag);

  private:
    std::vector<std::uint64_t> rounds_;  // by flag: the last one in which it was set
    std::uint64_t round_ = 0;
};

}  // namespace roboss
