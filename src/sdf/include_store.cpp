// Finds, reads and caches included files.
#include "sdf/include_store.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "sdf/newer_versions.h"
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

IncludeStore::~IncludeStore() {
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

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
    return file ? first_model(*file) : Element{};
}

const SourceFile* IncludeStore::lights_of(const Element& include) {
    const auto known = lights_.find(find(include).path().value_or(""));
    return known == lights_.end() ? nullptr : known->second.get();
}

std::optional<std::string> IncludeStore::folder() {
    if (!folder_.empty()) return folder_;
    std::error_code ignored;
    std::string pattern = (std::filesystem::temp_directory_path(ignored) / "roboss-sdf-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) return std::nullopt;
    return folder_ = pattern;
}

std::optional<std::string> IncludeStore::skeleton_file(const Element& include) {
    const Element model = model_of(include);
    if (!model) return std::nullopt;
    const std::string& source = model.source->path();
    if (std::find(open_.begin(), open_.end(), source) != open_.end()) {
        diagnostics_.error(include.where(), "include-cycle", "'" + source + "' includes itself",
                           "Remove one of the <include>s in the circle.");
        return std::nullopt;
    }
    if (const auto known = written_.find(source); known != written_.end()) return known->second;
    const auto in = folder();
    if (!in) {
        diagnostics_.error(include.where(), "no-temporary-folder",
                           "no temporary folder can be made for included models",
                           "Check that the folder in TMPDIR (else /tmp) can be written.");
        return std::nullopt;
    }
    open_.push_back(source);
    Skeleton skeleton = make_skeleton(model, TopPose::kKept, *this);
    open_.pop_back();
    const std::string file = *in + "/" + std::to_string(written_.size()) + ".sdf";
    std::ofstream(file) << skeleton.text();
    written_.emplace(source, file);
    skeletons_.emplace(file, std::move(skeleton));
    return file;
}

const Skeleton* IncludeStore::skeleton_of(const std::string& written_file) const {
    const auto found = skeletons_.find(written_file);
    return found == skeletons_.end() ? nullptr : &found->second;
}

}  // namespace roboss::sdf_import
