// See sub_models.h.
#include "mjcf/sub_models.h"

#include <cstring>
#include <filesystem>

#include "core/similar.h"
#include "mjcf/unread.h"

namespace roboss::mjcf {
namespace {

namespace fs = std::filesystem;

/// What <compiler> says in the attached file, and <option> in the main one.
Settings with_options_of(const Settings& main, Settings settings) {
    settings.timestep = main.timestep;
    settings.gravity = main.gravity;
    settings.magnetic = main.magnetic;
    settings.contacts = main.contacts, settings.equalities = main.equalities;
    settings.limits = main.limits, settings.springs = main.springs, settings.dampers = main.dampers;
    settings.friction_loss = main.friction_loss, settings.actuation = main.actuation;
    settings.sleep = main.sleep;
    return settings;
}

}  // namespace

SubModel::SubModel(std::unique_ptr<SourceFile> file, const Settings& main,
                   std::vector<std::string> search_paths, Diagnostics& diagnostics)
    : document_(std::move(file), diagnostics),
      settings_(with_options_of(main, read_settings(document_, diagnostics))),
      defaults_(document_, diagnostics),
      assets_(document_, defaults_, settings_, std::move(search_paths), diagnostics) {
    report_unread(document_, diagnostics);
}

Reading SubModel::reading(const Reading& user) const {
    return {document_,        defaults_,    settings_, assets_, user.sub_models, user.looks,
            user.diagnostics, user.unknown, {},        true,    false,           {}};
}

const SubModel* SubModels::find(const Attributes& attach, const Document& user) {
    const std::string wanted = attach.text("model");
    std::vector<std::string> names;
    for (const Element& asset : user.in_sections("asset")) {
        if (std::strcmp(asset.node.name(), "model") != 0) continue;
        if (asset.name() == wanted) return read(asset, user);
        if (!asset.name().empty()) {
            names.push_back(asset.name());
            continue;
        }
        const SubModel* model = read(asset, user);  // its name stands in the file
        if (model == nullptr) return nullptr;
        names.emplace_back(model->document().root().node.attribute("model").value());
        if (names.back() == wanted) return model;
    }
    diagnostics_.error(attach.where(), "unknown-asset",
                       "<attach> names the model '" + wanted + "', which no <model> in <asset> is",
                       did_you_mean(wanted, names, "Add <model name=\"" + wanted + "\" file=\"...\"/>."));
    return nullptr;
}

const SubModel* SubModels::read(const Element& model, const Document& user) {
    const std::string file = model.node.attribute("file").value();
    std::vector<std::string> folders{user.folder(), model.source->folder()};
    folders.insert(folders.end(), search_paths_.begin(), search_paths_.end());
    fs::path path;
    std::error_code error;
    for (const std::string& folder : folders)
        if (path.empty() && !file.empty() && fs::is_regular_file(fs::path(folder) / file, error))
            path = (fs::path(folder) / file).lexically_normal();
    if (path.empty()) {
        diagnostics_.error(model.where(), "file-not-found",
                           "the file '" + file + "' of a <model> was not found",
                           "Write its path from the folder of this file on, or give its folder with --path.");
        return nullptr;
    }
    const auto known = models_.find(path.string());
    if (known != models_.end()) return known->second.get();
    std::unique_ptr<SubModel>& read = models_[path.string()];
    auto source = SourceFile::read(path.string(), diagnostics_);
    if (source && std::strcmp(source->root().name(), "mujoco") != 0)
        diagnostics_.error(model.where(), "not-mjcf",
                           "the file '" + file + "' of a <model> does not begin with <mujoco>",
                           "Convert it: load it in MuJoCo and save it.");
    else if (source)
        read = std::make_unique<SubModel>(std::move(source), main_, search_paths_, diagnostics_);
    return read.get();
}

}  // namespace roboss::mjcf
