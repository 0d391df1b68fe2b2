// say(): what the commands print. Names in world files and the words of other processes reach terminals and
// logs through it, without control characters (core/printable.h).
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "core/printable.h"

namespace roboss {

/// Prints formatted text.
template <class... Args>
void say(std::FILE* to, fmt::format_string<Args...> format, Args&&... args) {
    const std::string text = printable(fmt::format(format, std::forward<Args>(args)...));
    std::fwrite(text.data(), 1, text.size(), to);
}

/// The same to standard output.
template <class... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
    say(stdout, format, std::forward<Args>(args)...);
}

}  // namespace roboss
