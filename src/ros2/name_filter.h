// NameFilter: a POSIX extended regular expression that a stranger sends, to be looked for in names.
// Expressions that could take much time or memory are refused: long ones, back references, and large
// repetition counts.
#pragma once

#include <memory>
#include <string>

#include "core/result.h"

namespace roboss::ros2 {

/// See the top of the file.
class NameFilter {
  public:
    /// The longest expression, bytes.
    static constexpr std::size_t kLongest = 256;
    /// The product of all its repetition counts, at most.
    static constexpr std::size_t kMostRepeats = 1'000;

    /// An empty expression fits every name. Code "bad-filter".
    static Result<NameFilter> of(const std::string& expression);
    /// True if a part of the name fits; ^ and $ stand for its ends.
    bool fits(const std::string& name) const;

  private:
    struct Compiled;
    std::shared_ptr<const Compiled> compiled_;  // null: all names fit
};

}  // namespace roboss::ros2
