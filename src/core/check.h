// ROBOSS_CHECK: a broken invariant of ours. Always on; prints the values and ends the program. Never for bad
// input.
#pragma once

#include <string>

namespace roboss {

[[noreturn]] void check_failed(const char* file, int line, const char* condition, const std::string& detail);

}  // namespace roboss

#define ROBOSS_CHECK(condition, detail)                                       \
    do {                                                                      \
        if (!(condition)) [[unlikely]]                                        \
            ::roboss::check_failed(__FILE__, __LINE__, #condition, (detail)); \
    } while (false)
