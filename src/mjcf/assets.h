// Assets: the meshes, height fields, materials and textures of an MJCF file, by name. Files are read when an
// element first needs them, each once.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "math/solid.h"
#include "mjcf/defaults.h"
#include "mjcf/mesh_solid.h"
#include "mjcf/settings.h"
#include "world/world.h"

namespace roboss::mjcf {

struct MeshAsset {
    std::shared_ptr<const MeshSpec> mesh;  ///< in the frame that geoms place; none: it cannot be read
    std::optional<Solid> solid;            ///< none: no volume
    std::optional<Diagnostic> problem;     ///< why it cannot be read
};

struct MaterialAsset {
    Vec3 rgb{1, 1, 1};
    double alpha = 1;
    std::string texture;  ///< name of the texture; empty: none
};

class Assets {
  public:
    Assets(const Document& document, const Defaults& defaults, const Settings& settings,
           std::vector<std::string> search_paths, Diagnostics& diagnostics);

    /// The mesh of this name, read now if need be; nullptr: it is not there or cannot be read, which is a
    /// finding of this severity.
    const MeshAsset* mesh(const std::string& name, const Attributes& user, Severity severity);
    /// The height field, its heights on a grid from -size to size; nullptr: as above.
    std::shared_ptr<const HeightGridSpec> height_field(const std::string& name, const Attributes& user);
    /// nullptr: the file does not have it (a warning).
    const MaterialAsset* material(const std::string& name, const Attributes& user);

  private:
    /// A file that an asset names, or the finding that it is not there.
    std::optional<std::string> find_file(const std::string& name, const Attributes& asset,
                                         Diagnostic& problem) const;
    void load(const Attributes& source, MeshAsset& asset);
    std::optional<MeshSpec> triangles_of(const Attributes& source, Diagnostic& problem);

    const Document& document_;
    const Settings& settings_;
    std::vector<std::string> search_paths_;
    Diagnostics& diagnostics_;
    std::map<std::string, Attributes> mesh_sources_, height_sources_;
    std::map<std::string, MaterialAsset> materials_;
    std::map<std::string, MeshAsset> meshes_;
    std::map<std::string, std::shared_ptr<const HeightGridSpec>> heights_;
};

}  // namespace roboss::mjcf
