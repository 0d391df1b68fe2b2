// ModelFolders: descriptions of models in folders that a user names: what may be spawned by name, and nothing
// else on this computer is ever read for a node elsewhere.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace roboss::ros2 {

/// A description that may be spawned.
struct ModelFile {
    std::string uri;          ///< "model://box", or "file:///models/arm.urdf"
    std::string description;  ///< for people
};

/// The text of a description.
struct ModelContent {
    std::string file;  ///< its name, for messages
    std::string text;  ///< SDF, URDF or MJCF
};

/// See the top of the file.
class ModelFolders {
  public:
    /// These folders, in the order in which they are looked at.
    explicit ModelFolders(const std::vector<std::string>& folders);

    /// All that there are now, by name.
    std::vector<ModelFile> list() const;
    /// The text at a URI. model:// and package:// are looked up by the run, so such a text only names them;
    /// others must lead to a file in one of the folders. Codes: "no-file", "bad-format".
    Result<ModelContent> read(const std::string& uri) const;

  private:
    std::vector<std::filesystem::path> folders_;
};

}  // namespace roboss::ros2
