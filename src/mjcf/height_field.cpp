// Height fields: numbers in the file, or a PNG picture. MuJoCo scales them to 0 .. 1, then to the elevation
// of <hfield size>. Its own binary format is not read.
#include <algorithm>
#include <cmath>

#include "core/similar.h"
#include "mesh/image_file.h"
#include "mjcf/assets.h"

namespace roboss::mjcf {
namespace {

/// Numbers by rows, from -y on.
bool read_elevation(const Attributes& source, HeightGridSpec& grid) {
    grid.rows = static_cast<std::size_t>(std::max(0, source.integer("nrow", 0)));
    grid.columns = static_cast<std::size_t>(std::max(0, source.integer("ncol", 0)));
    grid.heights = source.list("elevation");
    if (grid.heights.empty()) grid.heights.assign(grid.rows * grid.columns, 0.0);
    // The file writes rows from the top (+y) down.
    if (grid.heights.size() != grid.rows * grid.columns || grid.rows < 2 || grid.columns < 2) return false;
    for (std::size_t row = 0; row < grid.rows / 2; ++row)
        std::swap_ranges(
            grid.heights.begin() + static_cast<std::ptrdiff_t>(row * grid.columns),
            grid.heights.begin() + static_cast<std::ptrdiff_t>((row + 1) * grid.columns),
            grid.heights.begin() + static_cast<std::ptrdiff_t>((grid.rows - 1 - row) * grid.columns));
    return true;
}

bool read_picture_heights(const std::string& path, const Attributes& source, HeightGridSpec& grid) {
    const auto image = read_png(path);
    if (!image) {
        source.diagnostics().error(source.where(), "bad-heightmap",
                                   "the height field '" + path + "' " + image.error().message,
                                   image.error().remedy);
        return false;
    }
    grid.columns = image.value().columns, grid.rows = image.value().rows;
    for (std::size_t row = grid.rows; row-- > 0;)
        for (std::size_t column = 0; column < grid.columns; ++column)
            grid.heights.push_back(image.value().values[row * grid.columns + column]);
    return true;
}

}  // namespace

std::shared_ptr<const HeightGridSpec> Assets::height_field(const std::string& name, const Attributes& user) {
    const auto found = height_sources_.find(name);
    if (found == height_sources_.end()) {
        diagnostics_.error(user.where(), "unknown-asset",
                           "<geom> names the height field '" + name + "', which the file does not have",
                           "Add it to <asset>.");
        return nullptr;
    }
    const auto [entry, is_new] = heights_.try_emplace(name);
    if (!is_new) return entry->second;
    const Attributes& source = found->second;
    HeightGridSpec grid;
    double size[4] = {1, 1, 1, 1};
    if (!source.numbers("size", size)) return nullptr;
    const std::string file = source.text("file");
    if (file.empty()) {
        if (!read_elevation(source, grid)) {
            source.bad_value("elevation", "nrow * ncol numbers, at least 2 rows and 2 columns");
            return nullptr;
        }
    } else {
        Diagnostic problem{Severity::kError, source.where(), "", "", ""};
        const auto path = find_file(file, source, problem);
        if (!path) diagnostics_.add(problem);
        if (!path || !read_picture_heights(*path, source, grid)) return nullptr;
    }
    const auto [low, high] = std::ranges::minmax(grid.heights);
    for (double& height : grid.heights) height = high > low ? (height - low) / (high - low) * size[2] : 0.0;
    grid.size_x = 2 * size[0], grid.size_y = 2 * size[1];
    grid.source = name;
    entry->second = std::make_shared<const HeightGridSpec>(std::move(grid));
    return entry->second;
}

}  // namespace roboss::mjcf
