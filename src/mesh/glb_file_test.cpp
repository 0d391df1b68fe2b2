// glTF files (GLB) written by the test: triangles under nodes, colours, a picture inside the file.
#include <gtest/gtest.h>

#include <cstring>

#include <support/folder.h>

#include "mesh/image_file.h"
#include "mesh/mesh_file.h"
#include "mesh/picture_file.h"

namespace roboss {
namespace {

class GlbFile : public testing::Test {
  protected:
    std::string write(const std::string& bytes) const { return folder_.write("part.glb", bytes); }

  private:
    test::Folder folder_;
};

std::string word(std::size_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    std::string bytes(4, ' ');
    std::memcpy(bytes.data(), &bits, 4);
    return bytes;
}

std::string chunk(const char* kind, std::string bytes, char padding) {
    while (bytes.size() % 4 != 0) bytes += padding;
    return word(bytes.size()) + std::string(kind, 4) + bytes;
}

/// One triangle with corners at the origin, 1 m along x and 1 m along y, in a node 2 m up the z axis.
std::string glb(const std::string& material, const std::string& picture) {
    const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, uv[6] = {0, 0, 1, 0, 0, 1};
    const std::uint16_t faces[4] = {0, 1, 2, 0};
    std::string data;
    data.append(reinterpret_cast<const char*>(corners), sizeof corners);
    data.append(reinterpret_cast<const char*>(uv), sizeof uv);
    data.append(reinterpret_cast<const char*>(faces), sizeof faces);
    data += picture;
    const std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"translation":[0,0,2]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],
"accessors":[
{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},
{"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},
{"buffer":0,"byteOffset":60,"byteLength":6},{"buffer":0,"byteOffset":68,"byteLength":)" +
        std::to_string(picture.size()) + R"(}],
"images":[{"bufferView":3,"mimeType":"image/png"}],"textures":[{"source":0}],
"buffers":[{"byteLength":)" +
        std::to_string(data.size()) + R"(}],"materials":[)" + material + "]}";
    const std::string body = chunk("JSON", json, ' ') + chunk(std::string("BIN\0", 4).data(), data, '\0');
    return "glTF" + word(2) + word(12 + body.size()) + body;
}

const std::string kRed = R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,0.5]}})";
const std::string kPictured = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";

std::string small_png() {
    const auto bytes = encode_png(2, 1, 3, {255, 0, 0, 0, 0, 255});
    return bytes ? std::string(bytes.value().begin(), bytes.value().end()) : "";
}

TEST_F(GlbFile, TrianglesStandWhereTheirNodesPutThem) {
    const auto file = read_mesh({write(glb(kRed, small_png())), {1, 1, 1}, "", false});
    ASSERT_TRUE(file.ok()) << file.error().message;
    ASSERT_EQ(file.value().mesh.triangles.size(), 1u);
    ASSERT_EQ(file.value().mesh.vertices.size(), 3u);
    for (const Vec3& vertex : file.value().mesh.vertices) EXPECT_EQ(vertex.z, 2);
    EXPECT_EQ(file.value().mesh.vertices[2].y, 1);
}

TEST_F(GlbFile, AMaterialGivesItsColour) {
    const auto parts = read_mesh_parts({write(glb(kRed, small_png())), {1, 1, 1}, "", false});
    ASSERT_TRUE(parts.ok()) << parts.error().message;
    ASSERT_EQ(parts.value().size(), 1u);
    ASSERT_TRUE(parts.value()[0].rgb.has_value());
    EXPECT_EQ(parts.value()[0].rgb->x, 1);
    EXPECT_EQ(parts.value()[0].rgb->y, 0);
    EXPECT_NEAR(parts.value()[0].alpha, 0.5, 1e-6);
    EXPECT_TRUE(parts.value()[0].colour.name.empty());
}

TEST_F(GlbFile, APictureInsideTheFileIsTakenOut) {
    const std::string png = small_png();
    auto parts = read_mesh_parts({write(glb(kPictured, png)), {1, 1, 1}, "", false});
    ASSERT_TRUE(parts.ok()) << parts.error().message;
    ASSERT_EQ(parts.value().size(), 1u);
    const MeshPicture& colour = parts.value()[0].colour;
    EXPECT_EQ(std::string(colour.bytes.begin(), colour.bytes.end()), png);
    ASSERT_EQ(parts.value()[0].mesh.uv.size(), 3u);
    EXPECT_EQ(parts.value()[0].mesh.uv[0][1], 1) << "as in OBJ files, v counts upwards";
    const auto picture = picture_in(colour.bytes, "part.glb");
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_EQ(picture.value().width, 2u);
}

TEST_F(GlbFile, DamagedFilesAreErrorsAndNeverCrash) {
    const std::string whole = glb(kPictured, small_png());
    for (const std::size_t size : {4u, 12u, 40u, 400u}) {
        const auto cut = read_mesh({write(whole.substr(0, size)), {1, 1, 1}, "", false});
        ASSERT_FALSE(cut.ok()) << size;
        EXPECT_FALSE(cut.error().remedy.empty());
    }
    std::uint64_t seed = 1;
    const auto next = [&] {
        return seed = seed * 6364136223846793005ull + 1442695040888963407ull, seed >> 33;
    };
    for (int round = 0; round < 200; ++round) {
        std::string bytes = whole;
        for (int k = 0; k < 3; ++k) bytes[next() % bytes.size()] = static_cast<char>(next());
        const auto parts = read_mesh_parts({write(bytes), {1, 1, 1}, "", false});
        if (!parts) continue;
        for (const MeshPart& part : parts.value())
            for (const Vec3& v : part.mesh.vertices) EXPECT_TRUE(is_finite(v));
    }
}

}  // namespace
}  // namespace roboss
