// The file for the result of a run, which an environment variable names.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace examples {

inline void require_written(const std::ofstream& out, const char* file, const char* variable) {
    if (!out)
        throw std::runtime_error(std::string("cannot write the result to ") + file + "\n  remedy: set " +
                                 variable + " to a file in a writable folder");
}

/// For the start of a run, before it takes hours. Leaves the file as it is.
/// @throws std::runtime_error with a remedy if it cannot be written.
inline void check_result_file(const char* variable) {
    const char* file = std::getenv(variable);
    if (file == nullptr) return;
    std::error_code ignored;
    const bool is_new = !std::filesystem::exists(file, ignored);
    require_written(std::ofstream(file, std::ios::app), file, variable);
    if (is_new) std::filesystem::remove(file, ignored);
}

/// Writes the line to the file, if the variable is set.
/// @throws std::runtime_error with a remedy if it cannot be written.
inline void write_result(const std::string& line, const char* variable) {
    const char* file = std::getenv(variable);
    if (file == nullptr) return;
    std::ofstream out(file);
    out << line << "\n" << std::flush;
    require_written(out, file, variable);
}

}  // namespace examples
