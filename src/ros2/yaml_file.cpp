// See yaml_file.h.
#include "ros2/yaml_file.h"

#include <fstream>

namespace roboss::ros2 {

Result<std::string> read_yaml_text(const std::filesystem::path& file, const std::string& code,
                                   const std::string& remedy) {
    constexpr std::size_t kBytesMost = 1'000'000;
    std::ifstream in(file, std::ios::binary);
    std::string text(kBytesMost + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!in.is_open() || in.bad()) return Error{file.string() + ": it cannot be read", remedy, code};
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() > kBytesMost) return Error{file.string() + ": it has more than 1 MB", remedy, code};
    return text;
}

}  // namespace roboss::ros2
