// An <include> leads first to the folder of the main file, then to that of the file it stands in, as in
// MuJoCo. A file may be included once by each of its names, as in MuJoCo: links serve as copies.
#include "mjcf/document.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace roboss::mjcf {
namespace {

namespace fs = std::filesystem;

bool is_include(const pugi::xml_node& node) {
    return std::strcmp(node.name(), "include") == 0;
}

std::string links_resolved(const fs::path& path) {
    std::error_code ignored;
    return fs::weakly_canonical(path, ignored).string();
}

}  // namespace

Document::Document(std::unique_ptr<SourceFile> main, Diagnostics& diagnostics) : main_(std::move(main)) {
    const std::string path = fs::path(main_->path()).lexically_normal().string();
    paths_.insert(path);
    open_.push_back(links_resolved(path));
    read_includes(root(), diagnostics);
}

void Document::read_includes(const Element& parent, Diagnostics& diagnostics) {
    for (const auto node : parent.node.children()) {
        if (node.type() != pugi::node_element) continue;
        const Element element{parent.source, node};
        if (is_include(node))
            read_include(element, diagnostics);
        else
            read_includes(element, diagnostics);
    }
}

void Document::read_include(const Element& include, Diagnostics& diagnostics) {
    const std::string name = include.node.attribute("file").value();
    if (name.empty()) {
        diagnostics.error(include.where(), "include-not-found", "an <include> names no file",
                          "Write its file attribute.");
        return;
    }
    fs::path path = fs::path(folder()) / name;
    std::error_code error;
    if (!fs::exists(path, error)) path = fs::path(include.source->folder()) / name;
    if (!fs::is_regular_file(path, error)) {
        diagnostics.error(include.where(), "include-not-found",
                          "<include> of '" + name + "' leads to no file; searched: '" + folder() + "' and '" +
                              include.source->folder() + "'",
                          "Write its path from the folder of the main file on.");
        return;
    }
    const std::string file_itself = links_resolved(path);
    const bool in_itself = std::ranges::find(open_, file_itself) != open_.end();
    if (in_itself || !paths_.insert(path.lexically_normal().string()).second) {
        diagnostics.error(include.where(), "include-twice",
                          "the file '" + name + (in_itself ? "' includes itself" : "' is included twice"),
                          "Include each file once; use <replicate> or <attach> for copies.");
        return;
    }
    auto file = SourceFile::read(path.string(), diagnostics);
    if (!file) return;
    const Element inner{file.get(), file->root()};
    included_[include.node.internal_object()] = std::move(file);
    open_.push_back(file_itself);
    read_includes(inner, diagnostics);
    open_.pop_back();
}

std::vector<Element> Document::children(const Element& parent) const {
    std::vector<Element> all;
    for (const auto node : parent.node.children()) {
        if (node.type() != pugi::node_element) continue;
        if (!is_include(node)) {
            all.push_back({parent.source, node});
            continue;
        }
        const auto file = included_.find(node.internal_object());
        if (file == included_.end()) continue;
        const std::vector<Element> inner = children({file->second.get(), file->second->root()});
        all.insert(all.end(), inner.begin(), inner.end());
    }
    return all;
}

std::vector<Element> Document::children(const Element& parent, const char* name) const {
    std::vector<Element> all = children(parent);
    std::erase_if(all, [&](const Element& element) { return std::strcmp(element.node.name(), name) != 0; });
    return all;
}

std::vector<Element> Document::in_sections(const char* section) const {
    std::vector<Element> all;
    for (const Element& element : children(root(), section)) {
        const std::vector<Element> inner = children(element);
        all.insert(all.end(), inner.begin(), inner.end());
    }
    return all;
}

}  // namespace roboss::mjcf
