// IncludeStore: every file that a world or model includes, read once.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "sdf/resource_paths.h"
#include "sdf/source_file.h"
#include "sdf/standard_models.h"

namespace roboss::sdf_import {

class IncludeStore {
  public:
    IncludeStore(const ResourcePaths& paths, Diagnostics& diagnostics);

    /// The model that an <include> names, with what the <include> changes in it; nothing (reported) if there
    /// is none. URDF files are converted.
    Element model_of(const Element& include);

    /// The file of an <include> that holds lights and no model; nullptr: it holds something else.
    const SourceFile* lights_of(const Element& include);

  private:
    /// Where an <include> leads.
    struct Found {
        Resolved file;
        std::optional<StandardModel> built_in;    // where there is no such file
        std::optional<std::string> path() const;  // of either; nullopt: it leads nowhere
    };
    Found find(const Element& include) const;
    const SourceFile* file_of(const Element& include);
    std::unique_ptr<SourceFile> read(const std::string& path);
    void report_not_found(const Element& include, const Resolved& tried);

    const ResourcePaths& paths_;
    Diagnostics& diagnostics_;
    std::map<std::string, std::unique_ptr<SourceFile>> files_;   // by path; nullptr: cannot be read
    std::map<std::string, std::unique_ptr<SourceFile>> lights_;  // by path: files without a model
    // Files with changes by their path and the text of the changes; nullptr: the changes are wrong.
    std::map<std::pair<std::string, std::string>, std::unique_ptr<SourceFile>> changed_;
};

/// The first <model> of a file: under the root, or in its first world.
Element first_model(const SourceFile& file);

/// True if a file has no model but lights.
bool holds_scenery_only(const SourceFile& file);

}  // namespace roboss::sdf_import
