// See slip_map.h.
#include "sdf/slip_map.h"

#include "mesh/image_file.h"

namespace roboss::sdf_import {

void read_slip_map(const Element& plugin, const Import& import, LookupWheelSlipSpec& spec) {
    const Element element = plugin.child("slip_map");
    if (!element) return;
    const auto words = words_of(element.node.text().get());
    const std::string uri = words.empty() ? std::string() : std::string(words.front());
    const Resolved found = import.paths.resolve(uri, plugin.source->folder());
    if (!found.path) {
        import.diagnostics().warning(
            element.where(), "file-not-found",
            "the slip map '" + uri + "' was not found; searched: " +
                (found.remote ? "Fuel's cache (nothing is fetched)" : list_of(found.searched)),
            "Give the folder that holds it with --path, or in GZ_SIM_RESOURCE_PATH.");
        return;
    }
    const Result<ColourImage> image = read_png_colours(*found.path);
    if (!image) {
        import.diagnostics().warning(element.where(), "bad-slip-map",
                                     "the slip map '" + uri + "' " + image.error().message,
                                     image.error().remedy);
        return;
    }
    const ColourImage& picture = image.value();
    spec.map =
        ColourMap::of(static_cast<int>(picture.columns), static_cast<int>(picture.rows), picture.samples);
}

}  // namespace roboss::sdf_import
