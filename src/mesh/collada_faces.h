// What assimp 5.2 reads of the meshes of a COLLADA file, in its order, and where it would read beyond arrays.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesh/collada_elements.h"

namespace roboss::collada {

/// Follows ColladaParser::ReadGeometryLibrary: arrays and accessors are shared by all meshes of a file, and a
/// later one takes the place of an earlier one with its id.
class Faces {
  public:
    /// The first fault ends the run of `refuse`'s caller; it gets the element and what is wrong with it.
    using Refuse = std::function<void(Node, const std::string&)>;
    explicit Faces(Refuse refuse) : refuse_(std::move(refuse)) {}

    void read_library(Node geometries);

    /// Corners of all faces of a geometry; 0: there is no such geometry.
    std::uint64_t corners_of(const std::string& geometry) const;

  private:
    using Count = std::uint64_t;

    struct Accessor {
        Node element;
        std::string array;
        Count count = 0, stride = 1, offset = 0, parameters = 0, size = 0;
        bool resolved = false;  // it knows its array
    };

    struct Input {
        Node element;
        std::string semantic, accessor;
        Count offset = 0;
        bool resolved = false;
    };

    /// The faces of one element, as they are read.
    struct Primitives {
        Node element;
        Count count = 0, read = 0;
        std::vector<Input> inputs;
        std::vector<Count> corners;  // of each face of a <polylist>
    };

    struct Mesh {
        std::string vertices;
        std::vector<Input> inputs;
        Count corners = 0;
    };

    void read_mesh(Node element, Mesh& mesh);
    void read_source(Node source);
    void read_array(Node array);
    void read_accessor(Node element, const std::string& id);
    void read_faces(Node element, Mesh& mesh);
    void read_counts(Node vcount, Primitives& faces);
    void read_indices(Node list, Mesh& mesh, Primitives& faces);
    std::optional<Count> faces_of(Node list, Count indices, Count each, const Primitives& faces);
    void check_inputs(Node list, Mesh& mesh, Primitives& faces, bool has_corners);
    void check_input(Input& input, bool has_corners);
    std::optional<Input> input_of(Node element);
    std::optional<Count> number(Node element, const char* attribute, Count otherwise);

    Refuse refuse_;
    std::map<std::string, Count> arrays_;  // by id: how many numbers
    std::map<std::string, Accessor> accessors_;
    std::map<std::string, Count> corners_;  // by geometry
};

}  // namespace roboss::collada
