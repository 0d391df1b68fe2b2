// Numbers in text: no locale, and the same double for the same text everywhere.
#pragma once

#include <optional>
#include <string_view>

namespace roboss {

/// The number that the whole text is, with an optional sign; a number too small for a double is 0, one too
/// large is none. "inf" and "nan" are numbers here.
std::optional<double> parse_number(std::string_view text);

/// The same if it is finite.
std::optional<double> read_number(std::string_view text);

}  // namespace roboss
