// Checks of numbers on the command line, whose errors say what is wrong with the word that was typed.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/number_text.h"

namespace roboss {

/// A finite number above 0.
CLI::Validator positive_number();
/// A finite number, 0 or above.
CLI::Validator non_negative_number();
/// A whole number from `low` to `high`.
CLI::Validator whole_number(std::int64_t low, std::int64_t high);
/// A finite number above 0, not below `low` or above `high`, or one of the words.
CLI::Validator number_or(const std::vector<std::string>& words, double low = 0,
                         double high = std::numeric_limits<double>::max());

}  // namespace roboss
