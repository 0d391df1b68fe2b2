// Ends the program on a broken invariant, with what was broken and where.
#include "core/check.h"

#include <cstdio>
#include <cstdlib>

namespace roboss {

void check_failed(const char* file, int line, const char* condition, const std::string& detail) {
    std::fprintf(stderr, "roboss: internal error at %s:%d: %s is false (%s)\n", file, line, condition,
                 detail.c_str());
    std::abort();
}

}  // namespace roboss
