// Keys name all that the result depends on.
#include "sdf/shape_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "mesh/image_file.h"
#include "mesh/mesh_file.h"

namespace roboss::sdf_import {
namespace {

std::string key_of(std::initializer_list<double> numbers) {
    std::string key;
    for (const double x : numbers) {
        char text[32];
        std::snprintf(text, sizeof text, "|%.17g", x);
        key += text;
    }
    return key;
}

/// The picture's rows run down, the grid's up; between pixels heights are interpolated.
HeightGridSpec grid_of(const GreyImage& image, int sampling, const Vec3& size) {
    const auto s = static_cast<std::size_t>(sampling);
    HeightGridSpec grid;
    grid.columns = (image.columns - 1) * s + 1;
    grid.rows = (image.rows - 1) * s + 1;
    grid.size_x = size.x;
    grid.size_y = size.y;
    grid.heights.reserve(grid.columns * grid.rows);
    const auto at = [&](std::size_t i, std::size_t row) { return image.values[row * image.columns + i]; };
    for (std::size_t j = 0; j < grid.rows; ++j) {
        const std::size_t down = grid.rows - 1 - j, row = std::min(down / s, image.rows - 2);
        const double v = static_cast<double>(down - row * s) / static_cast<double>(s);
        for (std::size_t i = 0; i < grid.columns; ++i) {
            const std::size_t column = std::min(i / s, image.columns - 2);
            const double u = static_cast<double>(i - column * s) / static_cast<double>(s);
            const double upper = at(column, row) * (1 - u) + at(column + 1, row) * u;
            const double lower = at(column, row + 1) * (1 - u) + at(column + 1, row + 1) * u;
            grid.heights.push_back((upper * (1 - v) + lower * v) * size.z);
        }
    }
    return grid;
}

}  // namespace

MeshRequest mesh_request(const Element& mesh, const GeometrySpec& spec) {
    const Element submesh = mesh.child("submesh");
    return {spec.uri, spec.scale, submesh ? submesh.text("name") : "",
            submesh && submesh.node.child("center").text().as_bool()};
}

std::string key_of(const MeshRequest& request) {
    return request.path + "|" + request.submesh + (request.centre_submesh ? "|centred" : "|") +
           key_of({request.scale.x, request.scale.y, request.scale.z});
}

void ShapeFiles::read_mesh(const Element& mesh, Diagnostics& diagnostics, GeometrySpec& spec) {
    const std::string optimization = mesh.node.attribute("optimization").as_string();
    spec.as_hull = optimization == "convex_hull" || optimization == "convex_decomposition";
    if (optimization == "convex_decomposition" || mesh.child("convex_decomposition")) {
        diagnostics.note(mesh.where(), "convex-decomposition",
                         "a mesh is not cut into convex parts: its one convex hull collides",
                         "If hollows matter, give several convex meshes, or make the model static.");
        spec.as_hull = true;
    }
    const MeshRequest request = mesh_request(mesh, spec);
    const auto [entry, is_new] = meshes_.try_emplace(key_of(request));
    if (is_new) {
        auto file = roboss::read_mesh(request);
        if (!file) {
            entry->second.error = file.error();
        } else {
            if (file.value().dropped > 0) {
                diagnostics.note(mesh.where(), "flat-triangles",
                                 std::to_string(file.value().dropped) + " triangles without area in '" +
                                     spec.uri + "' are left out");
            }
            entry->second.content = std::make_shared<const MeshSpec>(std::move(file.value().mesh));
        }
    }
    if (const auto& error = entry->second.error)
        diagnostics.error(mesh.where(), "bad-mesh", "the mesh '" + spec.uri + "' " + error->message,
                          error->remedy);
    spec.mesh = entry->second.content;
}

void ShapeFiles::read_heightmap(const Element& heightmap, const ElementReader& reader, GeometryUse use,
                                GeometrySpec& spec) {
    const Vec3 centre = reader.vector(heightmap, "pos", {});
    const int sampling = std::clamp(reader.integer(heightmap, "sampling", 1), 1, 8);
    const Severity severity = use == GeometryUse::kCollide ? Severity::kError : Severity::kWarning;
    const auto report = [&](const char* code, const std::string& message, const std::string& remedy) {
        reader.diagnostics().add({severity, heightmap.where(), code, message, remedy});
    };
    const Vec3& size = spec.size;
    if (!(size.x > 0 && size.y > 0 && size.z >= 0 && is_finite(size))) {
        report("bad-size",
               "the <size> of a heightmap must be greater than 0 along x and y, and not below 0 along z",
               "Correct it.");
        return;
    }
    const std::string key = (use == GeometryUse::kCollide ? "" : "seen|") + spec.uri +
                            key_of({size.x, size.y, size.z, centre.x, centre.y, centre.z, 1.0 * sampling});
    const auto [entry, is_new] = heights_.try_emplace(key);
    if (is_new) {
        const auto image = read_png(spec.uri);
        if (!image) {
            entry->second.error = image.error();
        } else {
            HeightGridSpec grid = grid_of(image.value(), sampling, size);
            grid.source = spec.uri;
            grid.centre = centre;
            entry->second.content = std::make_shared<const HeightGridSpec>(std::move(grid));
        }
    }
    if (const auto& error = entry->second.error)
        report("bad-heightmap", "the heightmap '" + spec.uri + "' " + error->message, error->remedy);
    spec.heights = entry->second.content;
}

void read_polyline(const Element& polyline, const ElementReader& reader, GeometrySpec& spec) {
    for (const auto node : polyline.node.children("point")) {
        const auto words = words_of(node.text().get());
        const auto x = words.size() == 2 ? parse_number(words[0]) : std::nullopt;
        const auto y = words.size() == 2 ? parse_number(words[1]) : std::nullopt;
        if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) {
            reader.diagnostics().error(Element{polyline.source, node}.where(), "bad-value",
                                       "a <point> of a polyline is '" + std::string(node.text().get()) +
                                           "', which is not two numbers",
                                       "Write x and y in metres.");
            continue;
        }
        spec.outline.push_back({*x, *y, 0});
    }
    for (auto next = polyline.node.next_sibling("polyline"); next; next = next.next_sibling("polyline")) {
        reader.diagnostics().warning(Element{polyline.source, next}.where(), "second-polyline",
                                     "a second <polyline> of one geometry (an island or a hole) is left out",
                                     "Give each outline a collision of its own; build a hole from several.");
    }
}

}  // namespace roboss::sdf_import
