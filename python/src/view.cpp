// Views: a simulation in browsers, and what worlds look like.
#include <nanobind/stl/array.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <array>

#include "bindings.h"
#include "looks.h"
#include "roboss/core/hash.h"
#include "roboss/math/array_rows.h"
#include "roboss/scene/placed_copies.h"
#include "roboss/scene/scene_file.h"
#include "simulation.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

std::shared_ptr<LocalView> open(const std::string& listen, const std::string& page_folder,
                                const std::string& role, const std::string& program, bool insecure) {
    LocalViewOptions options;
    options.listen = listen;
    options.page_folder = page_folder;
    options.role = parse_page_role(role).value_or(PageRole::kWatch);
    options.program = program;
    options.insecure = insecure;
    return value_or_raise(LocalView::open(options), "ViewError");
}

/// The looks of a world to which copies of another one are added.
LooksOf with_copies(const LooksOf& looks, const LooksOf& addition, const Model& added,
                    const std::vector<std::string>& names, const std::vector<std::array<double, 7>>& poses) {
    std::vector<CopyPlace> places;
    for (std::size_t i = 0; i < names.size(); ++i) places.push_back({names[i], pose_at(poses[i].data())});
    LooksOf all{looks.worlds, {}};
    for (const auto& world : addition.worlds)
        all.worlds.push_back(std::make_shared<const World>(placed_copies(*world, added, places)));
    return all;
}

/// The scene of a Model (docs/viewer-protocol.md): its JSON, the bytes of its meshes, and those of its images
/// by their hash.
nb::tuple scene_of(const LooksOf& looks, const Model& model) {
    std::vector<const World*> worlds;
    for (const auto& world : looks.worlds) worlds.push_back(world.get());
    const SceneFile file = scene_file(make_scene(model, worlds), model, 0);
    nb::list meshes;
    for (const auto& mesh : file.meshes) meshes.append(nb::bytes(mesh.data(), mesh.size()));
    nb::dict textures;
    for (const TextureFile& texture : file.textures)
        textures[nb::cast(to_hex(texture.hash))] = nb::bytes(texture.bytes.data(), texture.bytes.size());
    return nb::make_tuple(file.json, meshes, textures);
}

}  // namespace

void bind_view(nb::module_& module) {
    nb::class_<LooksOf>(module, "Looks")
        .def(nb::init<>())
        .def("with_copies", &with_copies, nb::arg("addition"), nb::arg("added"), nb::arg("names"),
             nb::arg("poses"))
        .def("scene", &scene_of, nb::arg("model"));
    nb::class_<LocalView>(module, "View")
        .def_prop_ro("url", [](const LocalView& view) { return view.url(); })
        .def_prop_ro("fingerprint", [](const LocalView& view) { return view.fingerprint(); })
        .def_prop_ro("pages", &LocalView::pages)
        .def("take_notices", &LocalView::take_notices)
        .def("say_farewell", &LocalView::say_farewell, nb::arg("reason"),
             nb::call_guard<nb::gil_scoped_release>());
    module.def("open_view", &open, nb::arg("listen"), nb::arg("page_folder"), nb::arg("role"),
               nb::arg("program"), nb::arg("insecure"));
}

}  // namespace roboss_python
