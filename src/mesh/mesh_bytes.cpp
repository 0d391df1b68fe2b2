// One function names the fields of each struct, for writing and for reading.
#include "mesh/mesh_bytes.h"

#include <cstdint>
#include <span>
#include <type_traits>

#include "core/archive.h"

namespace roboss {
namespace {

using wire::field;
using wire::Reader;
using wire::Writer;

/// Items as they lie in memory: the other process is a copy of this one.
template <class Items>
void items(Writer& writer, const Items& values) {
    writer.count(values.size());
    writer.raw(values.data(), values.size() * sizeof(*values.data()));
}
template <class Items>
void items(Reader& reader, Items& values) {
    values.resize(reader.count(sizeof(*values.data())));
    reader.raw(values.data(), values.size() * sizeof(*values.data()));
}

template <class Stream, class Mesh>
void pass_mesh(Stream& stream, Mesh& mesh) {
    items(stream, mesh.source);
    items(stream, mesh.vertices);
    items(stream, mesh.triangles);
    items(stream, mesh.uv);
}

template <class Stream, class Picture>
void pass_picture(Stream& stream, Picture& picture) {
    items(stream, picture.name);
    items(stream, picture.bytes);
}

template <class Stream, class Part>
void pass_part(Stream& stream, Part& part) {
    pass_mesh(stream, part.mesh);
    Vec3 rgb = part.rgb.value_or(Vec3{});
    bool has_rgb = part.rgb.has_value();
    field(stream, has_rgb);
    for (double* x : {&rgb.x, &rgb.y, &rgb.z}) field(stream, *x);
    if constexpr (!std::is_const_v<Part>)
        if (has_rgb) part.rgb = rgb;
    field(stream, part.alpha);
    pass_picture(stream, part.colour);
    pass_picture(stream, part.normal);
}

constexpr auto pass_file = [](auto& stream, auto& file) {
    pass_mesh(stream, file.mesh);
    field(stream, file.dropped);
};

constexpr auto pass_parts = [](auto& stream, auto& parts) {
    constexpr std::size_t kLeast = 64;  // bytes of a part
    if constexpr (std::is_const_v<std::remove_reference_t<decltype(parts)>>)
        stream.count(parts.size());
    else
        parts.resize(stream.count(kLeast));
    for (auto& part : parts) pass_part(stream, part);
};

template <class Stream, class Failure>
void pass_error(Stream& stream, Failure& error) {
    items(stream, error.message);
    items(stream, error.remedy);
    items(stream, error.code);
}

bool is_whole(const MeshSpec& mesh) {
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle)
            if (vertex >= mesh.vertices.size()) return false;
    for (const Vec3& vertex : mesh.vertices)
        if (!is_finite(vertex)) return false;
    return mesh.uv.empty() || mesh.uv.size() == mesh.vertices.size();
}

Error damaged() {
    return {"is no mesh that can be read: its reader gave a damaged mesh", "Export it anew.", "reader-ended"};
}

/// Begins with whether there is a value.
template <class T, class Pass>
std::string to_bytes(const Result<T>& result, const Pass& pass) {
    Writer writer;
    field(writer, result.ok());
    if (result.ok())
        pass(writer, result.value());
    else
        pass_error(writer, result.error());
    const std::vector<std::uint8_t> bytes = writer.take();
    return {bytes.begin(), bytes.end()};
}

template <class T, class Pass>
Result<T> from_bytes(const std::string& bytes, const Pass& pass) {
    Reader reader({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    bool ok = false;
    field(reader, ok);
    T value;
    Error error;
    if (ok)
        pass(reader, value);
    else
        pass_error(reader, error);
    if (reader.failed()) return damaged();
    if (!ok) return error;
    return value;
}

}  // namespace

std::string mesh_to_bytes(const Result<MeshFile>& file) {
    return to_bytes(file, pass_file);
}

std::string parts_to_bytes(const Result<std::vector<MeshPart>>& parts) {
    return to_bytes(parts, pass_parts);
}

Result<MeshFile> mesh_from_bytes(const std::string& bytes) {
    auto file = from_bytes<MeshFile>(bytes, pass_file);
    if (file && !is_whole(file.value().mesh)) return damaged();
    return file;
}

Result<std::vector<MeshPart>> parts_from_bytes(const std::string& bytes) {
    auto parts = from_bytes<std::vector<MeshPart>>(bytes, pass_parts);
    if (!parts) return parts;
    for (const MeshPart& part : parts.value())
        if (!is_whole(part.mesh)) return damaged();
    return parts;
}

}  // namespace roboss
