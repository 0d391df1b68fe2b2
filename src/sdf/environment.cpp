// See environment.h. The table is comma-separated text whose first row names the columns, as gz-common reads
// it.
#include "sdf/environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include "xml/source_file.h"

#include "sdf/parameter_reader.h"

namespace roboss::sdf_import {
namespace {

constexpr const char* kClasses = "EnvironmentPreload|EnvironmentalSystem";
constexpr const char* kFiles = "environment-preload-system|environmental-sensor-system";
constexpr std::size_t kPointsMax = 1 << 22;  // of a grid: 32 MiB a column

/// Class and file of a kept plugin.
PluginName plugin_in(const ExtensionElement& record, pugi::xml_document& document) {
    document.load_string(record.text.c_str());
    return plugin_name({nullptr, document.document_element()});
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(trimmed(cell));
    return cells;
}

/// Columns of numbers.
struct Table {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;  // by name

    const std::vector<double>* find(const std::string& name) const {
        const auto at = std::ranges::find(names, name);
        return at == names.end() ? nullptr : &columns[static_cast<std::size_t>(at - names.begin())];
    }
};

/// The table, or what is wrong with it.
Result<Table> read_table(const std::string& path) {
    std::ifstream file(path);
    if (!file) return Error{"cannot be opened", ""};
    Table table;
    std::string line;
    std::getline(file, line);
    table.names = cells_of(line);
    table.columns.resize(table.names.size());
    for (int row = 2; std::getline(file, line); ++row) {
        if (trimmed(line).empty()) continue;
        const std::vector<std::string> cells = cells_of(line);
        if (cells.size() != table.names.size())
            return Error{"has " + std::to_string(cells.size()) + " cells in line " + std::to_string(row) +
                             ", and " + std::to_string(table.names.size()) + " columns",
                         ""};
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const std::optional<double> value = parse_number(cells[c]);
            if (!value || !std::isfinite(*value))
                return Error{"has '" + cells[c] + "' in line " + std::to_string(row) + ", which is no number",
                             ""};
            table.columns[c].push_back(*value);
        }
    }
    return table;
}

/// How the plugin names the table's coordinates.
struct Description {
    std::string file, reference = "global";
    std::array<std::string, 4> columns{"t", "x", "y", "z"};
    bool in_degrees = false, ignore_time = false;
};

Description description_of(const pugi::xml_node& plugin) {
    Description d;
    d.file = trimmed(plugin.child("data").text().get());
    const auto dimensions = plugin.child("dimensions"), space = dimensions.child("space");
    const auto take = [](const pugi::xml_node& node, std::string& text) {
        if (node) text = trimmed(node.text().get());
    };
    take(dimensions.child("time"), d.columns[0]);
    take(space.child("x"), d.columns[1]), take(space.child("y"), d.columns[2]);
    take(space.child("z"), d.columns[3]);
    const std::string ignore = trimmed(dimensions.child("ignore_time").text().get());
    d.ignore_time = ignore == "1" || ignore == "true";
    if (const auto reference = space.attribute("reference")) d.reference = reference.value();
    d.in_degrees = std::string_view(space.attribute("units").value()) == "degrees";
    return d;
}

/// The rows of a table as a grid: its axes (time, x, y, z), and the place of each row in it.
struct Grid {
    std::array<std::vector<double>, 4> axes;
    std::vector<std::size_t> place;
};

/// The grid, or why the rows are none.
Result<Grid> grid_of(const Table& table, const Description& d) {
    Grid grid;
    std::array<const std::vector<double>*, 4> columns{};
    std::size_t points = 1;
    for (std::size_t a = 0; a < columns.size(); ++a) {
        columns[a] = table.find(d.columns[a]);
        if (columns[a] == nullptr) return Error{"has no column '" + d.columns[a] + "'", ""};
        const std::set<double> values(columns[a]->begin(), columns[a]->end());
        grid.axes[a].assign(values.begin(), values.end());
        points *= std::max<std::size_t>(values.size(), 1);
        if (points > kPointsMax) return Error{"is no grid, or one of more than 4 million points", ""};
    }
    std::vector<char> seen(points, 0);
    for (std::size_t row = 0; row < columns[0]->size(); ++row) {
        std::size_t at = 0;
        for (std::size_t a = 0; a < columns.size(); ++a) {
            const auto& axis = grid.axes[a];
            at = at * axis.size() +
                 static_cast<std::size_t>(std::ranges::lower_bound(axis, (*columns[a])[row]) - axis.begin());
        }
        seen[at] = 1;
        grid.place.push_back(at);
    }
    const auto there = static_cast<std::size_t>(std::ranges::count(seen, 1));
    if (there != points)
        return Error{"has " + std::to_string(there) + " of the " + std::to_string(points) +
                         " points of the grid that its coordinates span",
                     ""};
    return grid;
}

/// Gives the sensor the columns that it names; the name of one that is not there, else "".
std::string fill(EnvironmentalSpec& spec, const Table& table, const Grid& grid, const Description& d) {
    spec.reference = d.reference, spec.in_degrees = d.in_degrees, spec.is_static = d.ignore_time;
    spec.times = grid.axes[0], spec.xs = grid.axes[1], spec.ys = grid.axes[2], spec.zs = grid.axes[3];
    spec.values.clear();
    for (const std::string& name : spec.columns()) {
        std::vector<double> values(grid.place.empty() ? 0 : spec.points(), 0.0);
        if (!name.empty() || !spec.is_vector()) {
            const std::vector<double>* column = table.find(name);
            if (column == nullptr) return spec.values.clear(), name;
            for (std::size_t row = 0; row < column->size(); ++row) values[grid.place[row]] = (*column)[row];
        }
        spec.values.insert(spec.values.end(), values.begin(), values.end());
    }
    return "";
}

class EnvironmentReader {
  public:
    EnvironmentReader(World& world, const Import& import) : world_(world), import_(import) {}

    void read() {
        for (ExtensionElement& record : world_.extensions) {
            pugi::xml_document document;
            const PluginName name = plugin_in(record, document);
            if (!is_environment_plugin(name)) continue;
            const bool loads =
                name.class_name == "EnvironmentPreload" || name.file == "environment-preload-system";
            if (loads) load(record, document.document_element());
            (loads ? preload_ : system_) = &record;
        }
        for (ModelSpec& model : world_.prototypes)
            for (LinkSpec& link : model.links)
                for (SensorSpec& sensor : link.sensors)
                    if (auto* spec = sensor.as<EnvironmentalSpec>()) serve(sensor, *spec);
        if (system_ == nullptr) return;
        if (grid_)
            system_->fate = PluginFate::kRuns;
        else
            system_->reason = "the world loads no table";
    }

  private:
    void load(ExtensionElement& record, const pugi::xml_node& plugin) {
        description_ = description_of(plugin);
        std::string fault = fault_of_file();
        if (fault.empty()) {
            record.fate = PluginFate::kRuns;
            return;
        }
        record.reason = fault;
        import_.diagnostics().warning(record.where, "environment",
                                      "the table '" + description_.file + "' of EnvironmentPreload " + fault +
                                          "; environmental sensors read nothing",
                                      "Give the path of a file of comma-separated values in <data>.");
    }

    /// Reads table and grid; what is wrong, else "".
    std::string fault_of_file() {
        if (!is_one_of("global|spherical|ecef", description_.reference))
            return "has coordinates of the kind '" + description_.reference + "'";
        const std::string base = std::filesystem::path(world_.file).parent_path().string();
        const Resolved found = import_.paths.resolve(description_.file, base);
        if (description_.file.empty() || !found.path)
            return "is not there (searched: " + list_of(found.searched) + ")";
        Result<Table> table = read_table(*found.path);
        if (!table) return table.error().message;
        Result<Grid> grid = grid_of(table.value(), description_);
        if (!grid) return grid.error().message;
        table_ = std::move(table).value(), grid_ = std::move(grid).value();
        return "";
    }

    void serve(const SensorSpec& sensor, EnvironmentalSpec& spec) {
        if (!grid_) {
            if (preload_ == nullptr)
                import_.diagnostics().warning(
                    sensor.where, "environment",
                    "sensor '" + sensor.name + "' reads a table that no plugin loads",
                    "Add gz::sim::systems::EnvironmentPreload to the world.");
            return;
        }
        const std::string missing = fill(spec, table_, *grid_, description_);
        if (!missing.empty())
            import_.diagnostics().warning(sensor.where, "environment",
                                          "sensor '" + sensor.name + "' reads the column '" + missing +
                                              "', which the table '" + description_.file + "' does not have",
                                          "It has " + list_of(table_.names) + ".");
    }

    World& world_;
    const Import& import_;
    ExtensionElement *preload_ = nullptr, *system_ = nullptr;
    Description description_;
    Table table_;
    std::optional<Grid> grid_;
};

/// Whether compile() makes scenery of it that no robot stands for.
bool is_scenery(const ModelSpec& model) {
    const auto is_steady = [](const OnboardSpec& onboard) {
        const auto* motion = std::get_if<SurfaceVelocitySpec>(&onboard.parameters);
        return motion != nullptr && motion->fixed;
    };
    const auto has_sensors = [](const LinkSpec& link) {
        return std::ranges::any_of(link.sensors, &SensorSpec::measures);
    };
    return model.is_static && std::ranges::all_of(model.onboard, is_steady) &&
           std::ranges::none_of(model.links, has_sensors);
}

}  // namespace

bool is_environment_plugin(const PluginName& name) {
    return is_named(name, kClasses, kFiles);
}

void convert_environment(World& world, const Import& import) {
    EnvironmentReader(world, import).read();
}

void show_scenery(World& world) {
    std::vector<std::string> names;
    std::vector<double> poses;
    for (const ModelInstance& instance : world.instances) {
        if (!is_scenery(world.prototypes[instance.prototype])) continue;
        const Pose& X = instance.X_WM;
        names.push_back(instance.name);
        poses.insert(poses.end(), {X.p.x, X.p.y, X.p.z, X.q.w, X.q.x, X.q.y, X.q.z});
    }
    for (ModelSpec& model : world.prototypes)
        for (LinkSpec& link : model.links)
            for (SensorSpec& sensor : link.sensors)
                if (auto* camera = sensor.as<LogicalCameraSpec>())
                    camera->scenery = names, camera->scenery_poses = poses;
}

}  // namespace roboss::sdf_import
