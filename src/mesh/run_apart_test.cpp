// What a reader does to its process stays there.
#include "mesh/run_apart.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <vector>

#include <support/folder.h>

#include "mesh/mesh_bytes.h"
#include "mesh/mesh_file.h"

namespace roboss {
namespace {

TEST(RunApart, GivesWhatTheWorkGives) {
    for (const std::size_t size : {0, 1, 100'000, 3'000'000}) {
        const auto result = run_apart([&] { return std::string(size, 'x'); });
        ASSERT_TRUE(result.ok()) << result.error().text();
        EXPECT_EQ(result.value(), std::string(size, 'x'));
    }
}

TEST(RunApart, AProcessThatEndsIsAnError) {
    const std::vector<std::function<std::string()>> endings{
        [] { return _exit(0), ""; },
        [] { return raise(SIGSEGV), ""; },
        [] { return raise(SIGABRT), ""; },
        [] { return raise(SIGKILL), ""; },
        []() -> std::string { throw std::runtime_error("of no avail"); },
    };
    for (const auto& work : endings) {
        const auto result = run_apart(work);
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().code, "reader-ended");
        EXPECT_FALSE(result.error().remedy.empty());
    }
}

TEST(RunApart, ALoopWithoutEndIsAnError) {
    const auto result = run_apart([] { return pause(), ""; }, {1, std::size_t{1} << 30});
    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.error().message.find("1 s"), std::string::npos);
}

TEST(RunApart, TooMuchMemoryIsAnError) {
    const auto result = run_apart([] { return std::string(std::size_t{3} << 30, 'x'); }, {60, 1u << 30});
    EXPECT_FALSE(result.ok());
}

TEST(MeshBytes, ComeBackAsTheyWere) {
    MeshPart part{{"a.fbx", {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}, {{0, 1, 2}}, {{0, 1}, {1, 0}, {1, 1}}},
                  Vec3{0.5, 0, 1},
                  0.25,
                  {"p.png", {1, 2, 3}},
                  {}};
    const auto parts = parts_from_bytes(parts_to_bytes(std::vector<MeshPart>{part, {}}));
    ASSERT_TRUE(parts.ok()) << parts.error().text();
    ASSERT_EQ(parts.value().size(), 2u);
    const MeshPart& back = parts.value()[0];
    EXPECT_EQ(back.mesh.source, "a.fbx");
    EXPECT_EQ(back.mesh.vertices[2].z, 10);
    EXPECT_EQ(back.mesh.triangles, part.mesh.triangles);
    EXPECT_EQ(back.mesh.uv, part.mesh.uv);
    EXPECT_EQ(back.rgb->z, 1);
    EXPECT_EQ(back.alpha, 0.25);
    EXPECT_EQ(back.colour.bytes, part.colour.bytes);
    EXPECT_FALSE(parts.value()[1].rgb);
    const auto failed = mesh_from_bytes(mesh_to_bytes(Error{"what", "remedy", "code"}));
    ASSERT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().text(), "what [code]\n  remedy: remedy");
}

TEST(MeshBytes, DamagedOnesAreAnError) {
    const MeshFile file{{"a.ply", {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}, {{0, 1, 2}}, {}}, 7};
    const std::string whole = mesh_to_bytes(file);
    EXPECT_EQ(mesh_from_bytes(whole).value().dropped, 7u);
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_FALSE(mesh_from_bytes(whole.substr(0, size)).ok()) << size;
    MeshFile wrong = file;
    wrong.mesh.triangles[0][1] = 3;
    EXPECT_FALSE(mesh_from_bytes(mesh_to_bytes(wrong)).ok());
}

// assimp 5.2 writes to the material that does not exist.
TEST(MeshFile, AnObjFileWhosePicturesHaveNoMaterialIsAnError) {
    const test::Folder folder;
    folder.write("a.mtl", "map_Kd a.png\n");
    const std::string path =
        folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    const auto file = read_mesh({path, {1, 1, 1}, "", false});
    ASSERT_FALSE(file.ok());
    EXPECT_EQ(file.error().code, "reader-ended");
    folder.write("a.mtl", "newmtl m\nmap_Kd a.png\n");
    EXPECT_TRUE(read_mesh({path, {1, 1, 1}, "", false}).ok());
}

// assimp 5.2 frees a picture twice whose text is no picture.
TEST(MeshFile, AnFbxFileThatEndsItsReaderIsAnError) {
    const test::Folder folder;
    const std::string text =
        "; FBX 7.3.0 project file\nFBXHeaderExtension: {\n FBXHeaderVersion: 1003\n FBXVersion: 7300\n}\n"
        "Objects: {\n Geometry: 100, \"Geometry::part\", \"Mesh\" {\n  Vertices: *9 {\n   a: "
        "0,0,0,1,0,0,0,1,0\n  }\n  PolygonVertexIndex: *3 {\n   a: 0,1,-3\n  }\n }\n"
        " Model: 200, \"Model::node\", \"Mesh\" {\n }\n Material: 300, \"Material::m\", \"\" {\n }\n"
        " Texture: 400, \"Texture::t\", \"\" {\n }\n"
        " Video: 500, \"Video::v\", \"Clip\" {\n  Type: \"Clip\"\n  Content: , \"AAAAAAAAA===\"\n }\n}\n"
        "Connections: {\n C: \"OO\",200,0\n C: \"OO\",100,200\n C: \"OO\",300,200\n"
        " C: \"OP\",400,300, \"DiffuseColor\"\n C: \"OO\",500,400\n}\n";
    EXPECT_FALSE(read_mesh({folder.write("a.fbx", text), {1, 1, 1}, "", false}).ok());
}

}  // namespace
}  // namespace roboss
