// See output_file.h.
#include "app/output/output_file.h"

#include <unistd.h>

namespace roboss {

OutputFile open_output(const std::string& path) {
    if (path != kStandardOutput) return OutputFile(std::fopen(path.c_str(), "w"));
    std::fflush(stdout);
    const int copy = dup(STDOUT_FILENO);  // closing the table does not close standard output
    return OutputFile(copy < 0 ? nullptr : fdopen(copy, "w"));
}

}  // namespace roboss
