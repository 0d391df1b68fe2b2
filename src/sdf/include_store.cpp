// Finds, reads and caches included files.
#include "sdf/include_store.h"

#include "sdf/include_changes.h"
#include "sdf/urdf.h"

namespace roboss::sdf_import {

Element first_model(const SourceFile& file) {
    if (const auto model = file.root().child("model")) return {&file, model};
    return {&file, file.root().child("world").child("model")};
}

bool holds_scenery_only(const SourceFile& file) {
    const pugi::xml_node root = file.root();
    return std::string_view(root.name()) == "sdf" && !first_model(file) && !root.child("world") &&
           root.child("light");
}

namespace {

void report_no_model(const SourceFile& file, Diagnostics& diagnostics) {
    diagnostics.error(file.where(file.root()), "no-model", "the file is included, but holds no <model>",
                      "Include a file with a <model>.");
}

}  // namespace

IncludeStore::IncludeStore(const ResourcePaths& paths, Diagnostics& diagnostics)
    : paths_(paths), diagnostics_(diagnostics) {}

void IncludeStore::report_not_found(const Element& include, const Resolved& tried) {
    const std::string uri = include.text("uri");
    if (tried.remote)
        diagnostics_.warning(
            include.where(), "remote-uri",
            "'" + uri + "' is on the network; nothing is fetched, the model is left out",
            "Download it (gz fuel download -u URI) and run again, or give its folder with --path.");
    else
        diagnostics_.error(include.where(), "include-not-found",
                           "<include> of '" + uri + "' leads to no file; the model is left out; searched: " +
                               list_of(tried.searched),
                           "Give the folder that holds it with --path, or in GZ_SIM_RESOURCE_PATH.");
}

std::unique_ptr<SourceFile> IncludeStore::read(const std::string& path) {
    auto file = read_source(path, diagnostics_);
    if (file && std::string(file->root().name()) == "robot") file = urdf_to_sdf(*file, diagnostics_);
    return file;
}

IncludeStore::Found IncludeStore::find(const Element& include) const {
    const std::string uri = include.text("uri");
    Found found{paths_.resolve_model(uri, include.source->folder()), std::nullopt};
    if (!found.file.path) found.built_in = standard_model(uri);
    return found;
}

std::optional<std::string> IncludeStore::Found::path() const {
    return built_in ? built_in->path : file.path;
}

const SourceFile* IncludeStore::file_of(const Element& include) {
    const Found found = find(include);
    if (!found.path()) {
        report_not_found(include, found.file);
        return nullptr;
    }
    const std::string path = *found.path();
    const auto [entry, is_new] = files_.try_emplace(path);
    if (is_new) {
        auto file =
            found.built_in ? SourceFile::from_text(path, found.built_in->text, {}, diagnostics_) : read(path);
        if (file && !first_model(*file)) {
            // model://sun is in nearly every world of Gazebo's older version: a file with a light.
            const bool lights = holds_scenery_only(*file);
            if (!lights) report_no_model(*file, diagnostics_);
            if (lights) lights_[path] = std::move(file);
            file = nullptr;
        }
        if (file) check_version(*file, diagnostics_);
        entry->second = std::move(file);
    }
    return entry->second.get();
}

Element IncludeStore::model_of(const Element& include) {
    const SourceFile* file = file_of(include);
    if (file == nullptr) return {};
    const std::string changes = changes_in(include);
    if (changes.empty()) return first_model(*file);
    const auto [entry, is_new] = changed_.try_emplace({file->path(), changes});
    if (is_new)
        entry->second = changed_file(
            first_model(*file), include, [this](const Element& nested) { return model_of(nested); },
            diagnostics_);
    return entry->second ? first_model(*entry->second) : Element{};
}

const SourceFile* IncludeStore::lights_of(const Element& include) {
    const auto known = lights_.find(find(include).path().value_or(""));
    return known == lights_.end() ? nullptr : known->second.get();
}

}  // namespace roboss::sdf_import
