// One function names the fields of each struct, for writing and for reading.
#include "mesh/mesh_bytes.h"

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace roboss {
namespace {

class Writer {
  public:
    void bytes(const void* data, std::size_t size) { out.append(static_cast<const char*>(data), size); }
    template <class Sequence>
    void sequence(const Sequence& values) {
        const std::uint64_t count = values.size();
        bytes(&count, sizeof count);
        bytes(values.data(), count * sizeof(*values.data()));
    }
    template <class T>
    void plain(const T& value) {
        bytes(&value, sizeof value);
    }

    std::string out;
};

class Reader {
  public:
    explicit Reader(const std::string& in) : in_(in) {}

    void bytes(void* data, std::size_t size) {
        good = good && size <= in_.size() - at_;
        if (!good) return;
        std::memcpy(data, in_.data() + at_, size);
        at_ += size;
    }
    template <class Sequence>
    void sequence(Sequence& values) {
        constexpr std::size_t kSize = sizeof(*values.data());
        std::uint64_t count = 0;
        bytes(&count, sizeof count);
        good = good && count <= (in_.size() - at_) / kSize;
        if (!good) return;
        values.resize(count);
        bytes(values.data(), count * kSize);
    }
    template <class T>
    void plain(T& value) {
        bytes(&value, sizeof value);
    }

    bool good = true;

  private:
    const std::string& in_;
    std::size_t at_ = 0;
};

template <class Stream, class Mesh>
void pass_mesh(Stream& stream, Mesh& mesh) {
    stream.sequence(mesh.source);
    stream.sequence(mesh.vertices);
    stream.sequence(mesh.triangles);
    stream.sequence(mesh.uv);
}

template <class Stream, class Picture>
void pass_picture(Stream& stream, Picture& picture) {
    stream.sequence(picture.name);
    stream.sequence(picture.bytes);
}

template <class Stream, class Part>
void pass_part(Stream& stream, Part& part) {
    pass_mesh(stream, part.mesh);
    Vec3 rgb = part.rgb.value_or(Vec3{});
    bool has_rgb = part.rgb.has_value();
    stream.plain(has_rgb);
    stream.plain(rgb);
    if constexpr (!std::is_const_v<Part>)
        if (has_rgb) part.rgb = rgb;
    stream.plain(part.alpha);
    pass_picture(stream, part.colour);
    pass_picture(stream, part.normal);
}

template <class Stream, class Failure>
void pass_error(Stream& stream, Failure& error) {
    stream.sequence(error.message);
    stream.sequence(error.remedy);
    stream.sequence(error.code);
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
    writer.plain(result.ok());
    if (result.ok())
        pass(writer, result.value());
    else
        pass_error(writer, result.error());
    return std::move(writer.out);
}

template <class T, class Pass>
Result<T> from_bytes(const std::string& bytes, const Pass& pass) {
    Reader reader(bytes);
    char ok = 0;
    reader.plain(ok);
    T value;
    Error error;
    if (ok == 1)
        pass(reader, value);
    else
        pass_error(reader, error);
    if (!reader.good) return damaged();
    if (ok != 1) return error;
    return value;
}

}  // namespace

std::string mesh_to_bytes(const Result<MeshFile>& file) {
    return to_bytes(file, [](Writer& writer, const MeshFile& value) {
        pass_mesh(writer, value.mesh);
        writer.plain(value.dropped);
    });
}

std::string parts_to_bytes(const Result<std::vector<MeshPart>>& parts) {
    return to_bytes(parts, [](Writer& writer, const std::vector<MeshPart>& value) {
        writer.plain(value.size());
        for (const MeshPart& part : value) pass_part(writer, part);
    });
}

Result<MeshFile> mesh_from_bytes(const std::string& bytes) {
    auto file = from_bytes<MeshFile>(bytes, [](Reader& reader, MeshFile& value) {
        pass_mesh(reader, value.mesh);
        reader.plain(value.dropped);
    });
    if (file && !is_whole(file.value().mesh)) return damaged();
    return file;
}

Result<std::vector<MeshPart>> parts_from_bytes(const std::string& bytes) {
    auto parts = from_bytes<std::vector<MeshPart>>(bytes, [](Reader& reader, std::vector<MeshPart>& value) {
        std::size_t count = 0;
        reader.plain(count);
        while (reader.good && value.size() < count) pass_part(reader, value.emplace_back());
    });
    if (!parts) return parts;
    for (const MeshPart& part : parts.value())
        if (!is_whole(part.mesh)) return damaged();
    return parts;
}

}  // namespace roboss
