// IncludeStore: every file that a world includes, read once. A nested <include> (of a model in a model) is
// left to libsdformat, which knows merging and placement frames; it gets the included file's skeleton as a
// temporary file.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "sdf/resource_paths.h"
#include "sdf/skeleton.h"
#include "sdf/source_file.h"
#include "sdf/standard_models.h"

namespace roboss::sdf_import {

class IncludeStore : public SkeletonIncludes {
  public:
    IncludeStore(const ResourcePaths& paths, Diagnostics& diagnostics);
    ~IncludeStore() override;
    IncludeStore(const IncludeStore&) = delete;
    IncludeStore& operator=(const IncludeStore&) = delete;

    /// The model that an <include> names, or nothing (reported). URDF files are converted.
    Element model_of(const Element& include);

    /// The file of an <include> that holds lights and no model; nullptr: it holds something else.
    const SourceFile* lights_of(const Element& include);

    /// For a nested include: the file with the skeleton of the included model, for libsdformat to read.
    std::optional<std::string> skeleton_file(const Element& include) override;

    /// The skeleton behind a file that skeleton_file() wrote; nullptr for others.
    const Skeleton* skeleton_of(const std::string& written_file) const;

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
    std::optional<std::string> folder();

    const ResourcePaths& paths_;
    Diagnostics& diagnostics_;
    std::map<std::string, std::unique_ptr<SourceFile>> files_;   // by path; nullptr: cannot be read
    std::map<std::string, std::unique_ptr<SourceFile>> lights_;  // by path: files without a model
    std::map<std::string, std::string> written_;                 // source path to skeleton file
    std::map<std::string, Skeleton> skeletons_;                  // by skeleton file
    std::vector<std::string> open_;  // sources whose skeletons are being written: cycles
    std::string folder_;
};

/// The first <model> of a file: under the root, or in its first world.
Element first_model(const SourceFile& file);

/// Whether a file has no model but lights.
bool holds_scenery_only(const SourceFile& file);

}  // namespace roboss::sdf_import
