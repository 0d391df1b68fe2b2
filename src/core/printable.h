// Text from files and other processes, as terminals and logs may show it. A name in a world file, or a peer's
// words, may hold escape sequences that move the cursor, change the window's title or reverse the text.
#pragma once

#include <string>
#include <string_view>

namespace roboss {

/// The same text with '?' for everything that is no printable character: control characters other than line
/// breaks and tabs, bytes that are no UTF-8, and characters that turn the direction of writing.
std::string printable(std::string_view text);
/// The same in one line: ' ' for line breaks and tabs.
std::string printable_line(std::string_view text);

}  // namespace roboss
