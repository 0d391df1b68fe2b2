// LookFiles: the files that only show: pictures, and meshes as they look, each read once. What cannot be read
// is a warning at the first element that names it, and is drawn in plain colour.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh_file.h"
#include "sdf/element_reader.h"
#include "sdf/ogre_materials.h"
#include "sdf/resource_paths.h"
#include "world/world.h"

namespace roboss::sdf_import {

/// The triangles of one material of a mesh file.
struct MeshLook {
    std::shared_ptr<const MeshSpec> mesh;
    std::optional<Vec3> rgb;
    double alpha = 1;
    FinishSpec finish;
};

class LookFiles {
  public:
    /// `opens`: false: files are looked for and not opened.
    LookFiles(const ResourcePaths& paths, bool opens) : paths_(paths), opens_(opens) {}

    bool opens() const { return opens_; }
    /// The picture that a child of `parent` names; nullptr: it names none, or none that can be shown.
    std::shared_ptr<const PictureSpec> picture(const Element& parent, const char* child,
                                               Diagnostics& diagnostics);
    /// The material that the <script> of a <material> names: of one of the script files that it lists, else
    /// one of Gazebo's own; nullopt: it has no <script>, or names a material that is in neither (a note).
    std::optional<OgreMaterial> script_material(const Element& material, Diagnostics& diagnostics);
    /// The picture of such a material, looked for where the <script> says; nullptr: none that can be shown.
    std::shared_ptr<const PictureSpec> picture_of_script(const std::string& name, const Element& material,
                                                         Diagnostics& diagnostics);
    /// The parts of a <mesh> whose file is spec.uri; none: it cannot be read.
    const std::vector<MeshLook>& parts(const Element& mesh, const GeometrySpec& spec,
                                       Diagnostics& diagnostics);

  private:
    std::shared_ptr<const PictureSpec> open(const std::string& path, const SourceLocation& where,
                                            const std::string& whose, Diagnostics& diagnostics);
    /// Keeps what was read, or warns why it could not be.
    std::shared_ptr<const PictureSpec> keep(Result<PictureSpec> picture, const std::string& path,
                                            const SourceLocation& where, const std::string& whose,
                                            Diagnostics& diagnostics);
    std::shared_ptr<const PictureSpec> picture_of_mesh(MeshPicture picture, const Element& mesh,
                                                       const GeometrySpec& spec, Diagnostics& diagnostics);

    const OgreMaterials& scripts_in(const std::string& path);
    std::vector<std::string> script_places(const Element& script) const;

    const ResourcePaths& paths_;
    bool opens_;
    std::size_t bytes_ = 0;  // of all pictures
    std::map<std::string, std::shared_ptr<const PictureSpec>> pictures_;
    std::map<std::string, std::vector<MeshLook>> meshes_;
    std::map<std::string, OgreMaterials> scripts_;  // by file or folder
};

}  // namespace roboss::sdf_import
