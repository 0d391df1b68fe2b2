// Each rule says what ColladaParser and ColladaLoader (5.2.5) take for granted.
#include "mesh/collada_faces.h"

#include <cctype>
#include <cstring>
#include <limits>

#include "xml/source_file.h"

namespace roboss::collada {
namespace {

constexpr std::uint64_t kCountMax = std::numeric_limits<std::uint32_t>::max();

bool is_digits(std::string_view word) {
    return !word.empty() && std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Some exporters write negative indices, which assimp takes for 0.
bool is_index(std::string_view word) {
    if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.remove_prefix(1);
    return is_digits(word);
}

std::optional<std::uint64_t> count_of(std::string_view word) {
    if (!is_digits(word)) return std::nullopt;
    std::uint64_t value = 0;
    for (const char c : word) {
        value = 10 * value + static_cast<std::uint64_t>(c - '0');
        if (value > kCountMax) return std::nullopt;
    }
    return value;
}

std::string quoted(std::string_view word) {
    return "'" + std::string(word.substr(0, 40)) + "'";
}

std::string tag(Node element) {
    return "<" + std::string(element.name()) + ">";
}

std::string id_behind(const char* reference) {
    return *reference == '#' ? reference + 1 : reference;
}

}  // namespace

void Faces::read_library(Node geometries) {
    for (const Node geometry : geometries.children("geometry")) {
        const std::string id = geometry.attribute("id").value();
        if (corners_.contains(id)) continue;  // assimp passes over it, too
        Mesh mesh;
        for (const Node element : geometry.children("mesh")) read_mesh(element, mesh);
        corners_[id] = mesh.corners;
    }
}

std::uint64_t Faces::corners_of(const std::string& geometry) const {
    const auto found = corners_.find(geometry);
    return found == corners_.end() ? 0 : found->second;
}

void Faces::read_mesh(Node element, Mesh& mesh) {
    each_below(element, [&](Node node) {
        if (is(node, {"source"})) read_source(node);
        if (is(node, {"vertices"})) {
            mesh.vertices = node.attribute("id").value();
            for (const Node input : node.children("input"))
                if (auto read = input_of(input)) mesh.inputs.push_back(*read);
        }
        if (is(node, {"triangles", "lines", "linestrips", "polygons", "polylist", "trifans", "tristrips"}))
            read_faces(node, mesh);
    });
}

void Faces::read_source(Node source) {
    const std::string id = source.attribute("id").value();
    each_below(source, [&](Node node) {
        if (is(node, {"float_array", "Name_array", "IDREF_array"})) read_array(node);
        if (is(node, {"technique_common"}) && node.child("accessor"))
            read_accessor(node.child("accessor"), id);
    });
}

/// Room is made for as many numbers as are announced before they are read.
void Faces::read_array(Node array) {
    const Count count = number(array, "count", 0).value_or(0);
    if (count > std::strlen(array.text().get()))
        refuse_(array, tag(array) + " announces " + std::to_string(count) + " numbers and has fewer");
    arrays_[array.attribute("id").value()] = is(array, {"float_array"}) ? count : 0;
}

void Faces::read_accessor(Node element, const std::string& id) {
    Accessor accessor;
    accessor.element = element;
    accessor.array = id_behind(element.attribute("source").value());
    accessor.count = number(element, "count", 0).value_or(0);
    accessor.stride = number(element, "stride", 1).value_or(0);
    accessor.offset = number(element, "offset", 0).value_or(0);
    each_below(element, [&](Node parameter) {
        if (!is(parameter, {"param"})) return;
        ++accessor.parameters;
        if (const auto type = parameter.attribute("type"))
            accessor.size += std::strcmp(type.value(), "float4x4") == 0 ? 16 : 1;
    });
    accessors_[id] = accessor;
}

std::optional<Faces::Input> Faces::input_of(Node element) {
    static const std::set<std::string> kKnown{"POSITION", "TEXCOORD",    "NORMAL",  "COLOR",     "VERTEX",
                                              "BINORMAL", "TEXBINORMAL", "TANGENT", "TEXTANGENT"};
    const auto offset = number(element, "offset", 0);
    const std::string semantic = element.attribute("semantic").value();
    if (!offset || !kKnown.contains(semantic)) return std::nullopt;
    return Input{element, semantic, id_behind(element.attribute("source").value()), *offset, false};
}

void Faces::read_faces(Node element, Mesh& mesh) {
    Primitives faces;
    faces.element = element;
    faces.count = number(element, "count", 0).value_or(0);
    each_below(element, [&](Node node) {
        if (is(node, {"input"}))
            if (auto read = input_of(node)) faces.inputs.push_back(*read);
        if (is(node, {"vcount"}) && faces.count > 0) read_counts(node, faces);
        if (is(node, {"p"})) read_indices(node, mesh, faces);
    });
    // It asserts that the lists hold as many faces as are announced.
    if (is(element, {"triangles", "polylist", "polygons"}) && faces.read != faces.count)
        refuse_(element, tag(element) + " announces " + std::to_string(faces.count) + " faces and has " +
                             std::to_string(faces.read));
}

void Faces::read_counts(Node vcount, Primitives& faces) {
    Count read = 0;
    for (const std::string_view word : xml::words_of(vcount.text().get())) {
        const auto corners = count_of(word);
        if (!corners) return refuse_(vcount, quoted(word) + " stands among the numbers of corners");
        if (read++ < faces.count) faces.corners.push_back(*corners);
    }
    if (read < faces.count)
        refuse_(vcount, "<vcount> has " + std::to_string(read) + " of " + std::to_string(faces.count) +
                            " numbers of corners");
}

void Faces::read_indices(Node list, Mesh& mesh, Primitives& faces) {
    Count indices = 0, each = 1;
    // assimp does not go on behind a word that is no integer, and takes all memory.
    for (const std::string_view word : xml::words_of(list.text().get())) {
        if (!is_index(word)) return refuse_(list, quoted(word) + " stands among the indices of its faces");
        ++indices;
    }
    for (const Input& input : faces.inputs) each = std::max(each, input.offset + 1);
    if (faces.count == 0) indices = 0;  // it does not read them
    const auto read = faces_of(list, indices, each, faces);
    if (!read) return;
    faces.read += *read;
    const bool has_corners = indices / each > 0 && *read > 0;
    check_inputs(list, mesh, faces, has_corners);
    if (!has_corners) return;
    Count corners = *read * 3;
    if (is(faces.element, {"lines", "linestrips"})) corners = *read * 2;
    if (is(faces.element, {"polylist", "polygons", "trifans"})) corners = indices / each;
    mesh.corners += corners;
}

/// How many faces a list of indices has; none: it is refused.
std::optional<Faces::Count> Faces::faces_of(Node list, Count indices, Count each, const Primitives& faces) {
    const Count points = indices / each;
    const auto refuse = [&](const std::string& what) -> std::optional<Count> {
        refuse_(list, what);
        return std::nullopt;
    };
    if (indices % each != 0)
        return refuse("<p> has " + std::to_string(indices) + " indices, which is no multiple of " +
                      std::to_string(each));
    if (is(faces.element, {"lines"})) {  // wrong counts are common; room is made for as many
        if (faces.count > points + 100'000) return refuse("<lines> announces far more lines than it has");
        return faces.count == 0 ? 0 : points / 2;
    }
    if (is(faces.element, {"polygons", "trifans"})) return 1;
    // From the corners of a strip it subtracts these, without asking.
    const Count fewest = is(faces.element, {"tristrips"}) ? 3 : is(faces.element, {"linestrips"}) ? 2 : 0;
    if (points < fewest) return refuse("a strip of " + tag(faces.element) + " has too few corners");
    if (fewest > 0) return points - fewest + 1;
    Count expected = 3 * faces.count;
    if (is(faces.element, {"polylist"})) {
        if (faces.corners.size() < faces.count) return refuse("<polylist> has no <vcount> before its <p>");
        expected = 0;
        for (const Count corners : faces.corners) expected += corners;
    }
    if (points != expected)
        return refuse("<p> has " + std::to_string(indices) + " indices instead of " +
                      std::to_string(expected) + " times " + std::to_string(each));
    return faces.count;
}

void Faces::check_inputs(Node list, Mesh& mesh, Primitives& faces, bool has_corners) {
    std::size_t vertices = 0, positions = 0;
    for (std::vector<Input>* inputs : {&mesh.inputs, &faces.inputs}) {
        for (Input& input : *inputs) {
            if (input.semantic == "POSITION") ++positions;
            if (input.semantic != "VERTEX") {
                check_input(input, has_corners);
            } else if (inputs == &faces.inputs) {
                ++vertices;
                if (input.accessor != mesh.vertices)
                    refuse_(input.element, "there is no <vertices> with the id " + quoted(input.accessor));
            }
        }
    }
    if (!has_corners) return;
    // It takes the index before the first, or the corners of other faces.
    if (vertices == 0) refuse_(list, "its faces have no <input> with the semantic VERTEX before them");
    if (positions != 1)
        refuse_(list, "its corners have " + std::to_string(positions) + " positions instead of one");
}

/// It compares an index with the accessor's count, and not with how many numbers there are.
void Faces::check_input(Input& input, bool has_corners) {
    const auto found = accessors_.find(input.accessor);
    if (found == accessors_.end())
        return refuse_(input.element, "there is no <source> with the id " + quoted(input.accessor));
    Accessor& accessor = found->second;
    // It looks for the array once for each input, though the accessor may have been read anew since.
    if (!input.resolved) accessor.resolved = true;
    input.resolved = true;
    const auto array = arrays_.find(accessor.array);
    if (!accessor.resolved || array == arrays_.end())
        return refuse_(accessor.element, "there is no array with the id " + quoted(accessor.array));
    // A colour has four numbers.
    if (input.semantic == "COLOR" && (accessor.parameters > 4 || accessor.size > 4))
        return refuse_(accessor.element, "the <accessor> of a colour has more than four numbers");
    const Count each = std::max<Count>(accessor.parameters, 1), there = array->second;
    if (accessor.count == 0 || !has_corners) return;  // no index is below it
    // Without overflow: there >= offset + (count - 1) * stride + each.
    const bool fits =
        accessor.offset <= there && each <= there - accessor.offset &&
        (accessor.count == 1 || accessor.stride <= (there - accessor.offset - each) / (accessor.count - 1));
    if (!fits)
        refuse_(accessor.element, "its <accessor> reads " + std::to_string(accessor.count) + " times " +
                                      std::to_string(accessor.stride) + " numbers of '" + accessor.array +
                                      "', which has " + std::to_string(there));
}

std::optional<Faces::Count> Faces::number(Node element, const char* attribute, Count otherwise) {
    const auto value = element.attribute(attribute);
    if (!value) return otherwise;
    const auto words = xml::words_of(value.value());
    const auto count = words.size() == 1 ? count_of(words[0]) : std::nullopt;
    if (!count)
        refuse_(element, "the " + std::string(attribute) + " of " + tag(element) + " is " +
                             quoted(value.value()) + ", which is no number from 0 to 4294967295");
    return count;
}

}  // namespace roboss::collada
