// For the tests of this layer: worlds given as text, in a folder of their own that goes away with the object.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "sdf/load_world.h"
#include "world/test_loaded.h"

namespace roboss::sdf_test {

using Loaded = world_test::Loaded;

class TestFolder {
  public:
    TestFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "roboss-test-XXXXXX").string();
        if (mkdtemp(pattern.data()) != nullptr) path_ = pattern;
    }
    ~TestFolder() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
    }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    std::string path(const std::string& name) const { return path_ + "/" + name; }

    std::string write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
        std::ofstream(path(name), std::ios::binary) << text;
        return path(name);
    }

    Loaded load(const std::string& name, const LoadOptions& options = {}) const {
        Loaded loaded;
        loaded.world = load_world(path(name), options, loaded.diagnostics);
        return loaded;
    }

  private:
    std::string path_;
};

/// Loads a whole file given as text.
inline Loaded load_text(const std::string& text, const std::string& name = "world.sdf") {
    const TestFolder folder;
    folder.write(name, text);
    return folder.load(name);
}

/// Loads a world of SDFormat `version` with these elements; its first line is line 1 of the file.
inline Loaded load_elements(const std::string& elements, const std::string& version = "1.9") {
    return load_text("<sdf version='" + version + "' xmlns:roboss='urn:roboss:1'><world name='w'>" +
                     elements + "</world></sdf>\n");
}

inline const std::string kInertial =
    "<inertial><mass>2</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>";

/// A link with an inertial and `inner`.
inline std::string link(const std::string& name, const std::string& inner = "") {
    return "<link name='" + name + "'>" + kInertial + inner + "</link>";
}

}  // namespace roboss::sdf_test
