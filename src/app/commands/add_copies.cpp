// Rows of columns; the grid is square if nothing else is said.
#include "app/commands/add_copies.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace roboss {
namespace {

struct Grid {
    double dx = 1, dy = 1;
    int columns = 1;
};

Result<Grid> grid_of(const CopyOptions& options) {
    Grid grid;
    grid.columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(options.count))));
    if (options.grid.empty()) return grid;
    std::istringstream in(options.grid);
    in >> grid.dx >> grid.dy;
    bool good = !in.fail() && std::isfinite(grid.dx) && std::isfinite(grid.dy);
    if (good && !(in >> std::ws).eof()) good = static_cast<bool>(in >> grid.columns) && grid.columns > 0;
    std::string rest;
    in.clear();
    if (good && !(in >> rest)) return grid;
    return Error{"'" + options.grid + "' is not a grid", "give \"DX DY\" or \"DX DY COLUMNS\", m",
                 "bad-grid"};
}

Result<std::string> file_content(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::stringstream content;
    if (in && content << in.rdbuf()) return content.str();
    return Error{path + " cannot be read", "check the path", "no-file"};
}

}  // namespace

Result<std::string> copies_text(const CopyOptions& options) {
    if (!options.poses.empty()) return file_content(options.poses);
    const Result<Grid> read = grid_of(options);
    if (!read) return read.error();
    const Grid& grid = read.value();
    double x = 0, y = 0, z = 0;
    std::string angles;
    std::istringstream pose(options.pose);
    if (!(pose >> x >> y >> z) || !std::getline(pose, angles))
        return Error{"'" + options.pose + "' is not a pose", "give \"x y z roll pitch yaw\", m and rad",
                     "bad-pose"};
    const std::string name =
        options.name.empty() ? std::filesystem::path(options.file).stem().string() : options.name;
    std::string text;
    for (int i = 0; i < options.count; ++i)
        text += fmt::format("{}_{} {:.17g} {:.17g} {:.17g}{}\n", name, i, x + grid.dx * (i % grid.columns),
                            y + grid.dy * (i / grid.columns), z, angles);
    return text;
}

}  // namespace roboss
