// Text that is written piece by piece, for files of many megabytes.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace roboss {

using Text = fmt::memory_buffer;

/// Appends formatted text.
template <class... Args>
void add(Text& text, fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

}  // namespace roboss
