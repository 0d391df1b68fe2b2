// Mesh files and pictures written by the test: each kind read to the same triangles, each fault named.
#include "mesh/mesh_file.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <filesystem>
#include <limits>

#include <support/folder.h>

#include "mesh/image_file.h"

namespace roboss {
namespace {

using test::Folder;

// A tetrahedron with corners at the origin and one metre along each axis.
constexpr float kCorners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string ascii_stl(const std::string& first_number = "0") {
    std::string text = "solid tetrahedron\n";
    for (const auto& face : kFaces) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int v : face) {
            text += "vertex " + (v == 0 ? first_number : std::to_string(kCorners[v][0]));
            text += " " + std::to_string(kCorners[v][1]) + " " + std::to_string(kCorners[v][2]) + "\n";
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid tetrahedron\n";
}

std::string binary_stl() {
    std::string bytes(80, ' ');
    const auto add = [&](const void* data, std::size_t count) {
        bytes.append(static_cast<const char*>(data), count);
    };
    const std::uint32_t count = 4;
    add(&count, 4);
    for (const auto& face : kFaces) {
        const float normal[3] = {0, 0, 0};
        add(normal, 12);
        for (const int v : face) add(kCorners[v], 12);
        const std::uint16_t attribute = 0;
        add(&attribute, 2);
    }
    return bytes;
}

const std::string kObj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string dae(const std::string& unit, const std::string& up) {
    return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
           "version='1.4.1'>"
           "<asset><unit meter='" +
           unit + "'/><up_axis>" + up +
           "</up_axis></asset>"
           "<library_geometries><geometry id='g' name='part'><mesh>"
           "<source id='p'><float_array id='pa' count='12'>0 0 0 1 0 0 0 1 0 0 0 1</float_array>"
           "<technique_common><accessor source='#pa' count='4' stride='3'><param name='X' type='float'/>"
           "<param name='Y' type='float'/><param name='Z' "
           "type='float'/></accessor></technique_common></source>"
           "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
           "<triangles count='4'><input semantic='VERTEX' source='#v' offset='0'/><p>0 2 1 0 1 3 0 3 2 1 2 "
           "3</p>"
           "</triangles></mesh></geometry></library_geometries>"
           "<library_visual_scenes><visual_scene id='s'><node id='n' name='node'><translate>0 0 2</translate>"
           "<instance_geometry url='#g'/></node></visual_scene></library_visual_scenes>"
           "<scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

double volume_of(const MeshSpec& mesh) {
    double six = 0;
    for (const auto& t : mesh.triangles)
        six += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]]));
    return six / 6.0;
}

void expect_tetrahedron(const Result<MeshFile>& file, double volume) {
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ(file.value().mesh.vertices.size(), 4u);
    EXPECT_EQ(file.value().mesh.triangles.size(), 4u);
    EXPECT_NEAR(volume_of(file.value().mesh), volume, 1e-9);
    EXPECT_EQ(file.value().dropped, 0u);
}

TEST(MeshFile, StlObjAndDaeGiveTheSameSolid) {
    const Folder folder;
    expect_tetrahedron(read_mesh({folder.write("a.stl", ascii_stl()), {1, 1, 1}, "", false}), 1.0 / 6);
    expect_tetrahedron(read_mesh({folder.write("b.STL", binary_stl()), {1, 1, 1}, "", false}), 1.0 / 6);
    expect_tetrahedron(read_mesh({folder.write("c.obj", kObj), {1, 1, 1}, "", false}), 1.0 / 6);
    expect_tetrahedron(read_mesh({folder.write("d.dae", dae("1", "Z_UP")), {1, 1, 1}, "", false}), 1.0 / 6);
}

TEST(MeshFile, PlyGivesTheSameSolid) {
    const Folder folder;
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& v : kCorners)
        text += std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]) + "\n";
    for (const auto& f : kFaces)
        text += "3 " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
    expect_tetrahedron(read_mesh({folder.write("a.ply", text), {1, 1, 1}, "", false}), 1.0 / 6);
}

TEST(MeshFile, FbxKeepsItsNumbersWhateverItsUpAxis) {
    const Folder folder;
    for (const std::string up : {"1", "2"}) {
        const std::string front = up == "1" ? "2" : "1";
        const std::string text =
            "; FBX 7.3.0 project file\nFBXHeaderExtension: {\n FBXHeaderVersion: 1003\n FBXVersion: 7300\n}\n"
            "GlobalSettings: {\n Properties70: {\n  P: \"UpAxis\", \"int\", \"Integer\", \"\"," +
            up + "\n  P: \"FrontAxis\", \"int\", \"Integer\", \"\"," + front +
            "\n }\n}\nObjects: {\n Geometry: 100, \"Geometry::part\", \"Mesh\" {\n"
            "  Vertices: *12 {\n   a: 0,0,0,1,0,0,0,1,0,0,0,3\n  }\n"
            "  PolygonVertexIndex: *12 {\n   a: 0,2,-2,0,1,-4,0,3,-3,1,2,-4\n  }\n }\n"
            " Model: 200, \"Model::node\", \"Mesh\" {\n }\n}\n"
            "Connections: {\n C: \"OO\",200,0\n C: \"OO\",100,200\n}\n";
        const auto file = read_mesh({folder.write("a.fbx", text), {1, 1, 1}, "", false});
        expect_tetrahedron(file, 3.0 / 6);
        double top = 0;
        for (const Vec3& v : file.value().mesh.vertices) top = std::max(top, v.z);
        EXPECT_EQ(top, 3.0) << up;
    }
}

TEST(MeshFile, AnObjFileWithoutItsMaterialsIsReadByAWayThroughItsParentFolder) {
    const Folder folder;
    const std::string path = folder.write("leg1.obj", "mtllib leg1.mtl\n" + kObj);
    const std::filesystem::path place = std::filesystem::path(path).parent_path();
    std::filesystem::create_directory(place / "robots");
    std::filesystem::create_directory(place / "meshes");
    std::filesystem::rename(path, place / "meshes" / "leg1.obj");
    const std::string way = (place / "robots" / ".." / "meshes" / "leg1.obj").string();
    expect_tetrahedron(read_mesh({way, {1, 1, 1}, "", false}), 1.0 / 6);
}

/// A cube with a corner that is raised by half: its top is a saddle, or a roof along one diagonal.
TEST(MeshFile, QuadranglesOfObjAreSplitFromTheirFirstCorner) {
    const Folder folder;
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1.5\nv 0 1 1\n";
    const std::string sides = "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    const auto volume = [&](const std::string& top) {
        const auto read = read_mesh({folder.write("cube.obj", corners + sides + top), {1, 1, 1}, "", false});
        return read.ok() ? volume_of(read.value().mesh) : 0;
    };
    EXPECT_NEAR(volume("f 5 6 7 8\n"), 1 + 1.0 / 6, 1e-6);
    EXPECT_NEAR(volume("f 6 7 8 5\n"), 1 + 1.0 / 12, 1e-6);
}

TEST(MeshFile, ScaleMirrorsAndStretches) {
    const Folder folder;
    const std::string path = folder.write("a.stl", binary_stl());
    expect_tetrahedron(read_mesh({path, {2, 3, 4}, "", false}), 24.0 / 6);
    expect_tetrahedron(read_mesh({path, {-1, 1, 1}, "", false}), 1.0 / 6);
}

TEST(MeshFile, ColladaKeepsItsAxesAndAppliesUnitAndNodes) {
    const Folder folder;
    for (const char* up : {"Z_UP", "Y_UP"}) {
        const auto file = read_mesh({folder.write("a.dae", dae("0.01", up)), {1, 1, 1}, "", false});
        expect_tetrahedron(file, 1e-6 / 6);
        double top = 0;
        for (const Vec3& v : file.value().mesh.vertices) top = std::max(top, v.z);
        EXPECT_NEAR(top, 0.03, 1e-8) << up;
    }
}

TEST(MeshFile, ColladaWithSpaceBeforeItsNumbersIsRead) {
    const Folder folder;
    std::string text = dae("1", "Z_UP");
    const std::size_t geometries = text.find("<library_geometries>");
    ASSERT_NE(geometries, std::string::npos);
    text.insert(
        geometries,
        "<library_effects><effect id='e'><profile_COMMON><technique sid='t'><phong><diffuse><color> 0.3 "
        "0.3 0.3 1</color></diffuse></phong></technique></profile_COMMON></effect></library_effects>");
    expect_tetrahedron(read_mesh({folder.write("space.dae", text), {1, 1, 1}, "", false}), 1.0 / 6);
}

TEST(MeshFile, ASkinOfColladaIsItsMeshWhateverItsWeightsAre) {
    const Folder folder;
    std::string text = dae("1", "Z_UP");
    const std::string geometry = "<instance_geometry url='#g'/>", scenes = "<library_visual_scenes>";
    text.replace(text.find(geometry), geometry.size(),
                 "<instance_controller url='#k'></instance_controller>");
    text.insert(
        text.find(scenes),
        "<library_controllers><controller id='k'><skin source='#g'>"
        "<source id='j'><Name_array id='ja' count='1'>bone</Name_array><technique_common><accessor "
        "source='#ja' "
        "count='1' stride='1'><param name='JOINT' type='Name'/></accessor></technique_common></source>"
        "<source id='w'><float_array id='wa' count='1'>1</float_array><technique_common><accessor "
        "source='#wa' "
        "count='1' stride='1'><param name='WEIGHT' type='float'/></accessor></technique_common></source>"
        "<source id='b'><float_array id='ba' count='16'>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</float_array>"
        "<technique_common><accessor source='#ba' count='1' stride='16'><param name='T' "
        "type='float4x4'/></accessor>"
        "</technique_common></source>"
        "<joints><input semantic='JOINT' source='#j'/><input semantic='INV_BIND_MATRIX' "
        "source='#b'/></joints>"
        "<vertex_weights count='4'><input semantic='JOINT' source='#j' offset='0'/><input semantic='WEIGHT' "
        "source='#w' offset='1'/><vcount>1 1 1 1</vcount><v>0 0 0 0 0 90000000 90000000 "
        "0</v></vertex_weights>"
        "</skin></controller></library_controllers>");
    expect_tetrahedron(read_mesh({folder.write("skin.dae", text), {1, 1, 1}, "", false}), 1.0 / 6);
}

TEST(MeshFile, ASubmeshIsTakenByNameAndCentred) {
    const Folder folder;
    const std::string path = folder.write("a.dae", dae("1", "Z_UP"));
    for (const char* name : {"part", "node"})
        expect_tetrahedron(read_mesh({path, {1, 1, 1}, name, false}), 1.0 / 6);
    const auto centred = read_mesh({path, {1, 1, 1}, "part", true});
    expect_tetrahedron(centred, 1.0 / 6);
    for (const Vec3& v : centred.value().mesh.vertices) EXPECT_NEAR(std::fabs(v.z), 0.5, 1e-7);
    const auto none = read_mesh({path, {1, 1, 1}, "wheel", false});
    ASSERT_FALSE(none.ok());
    EXPECT_NE(none.error().message.find("'wheel'"), std::string::npos);
    EXPECT_NE(none.error().message.find("'part'"), std::string::npos) << none.error().message;
}

TEST(MeshFile, TrianglesWithoutAreaAreDroppedAndCounted) {
    const Folder folder;
    const auto file =
        read_mesh({folder.write("a.obj", kObj + "f 1 2 2\nv 2 0 0\nf 1 2 5\n"), {1, 1, 1}, "", false});
    ASSERT_TRUE(file.ok());
    EXPECT_EQ(file.value().mesh.triangles.size(), 4u);
    EXPECT_GE(file.value().dropped, 1u);
}

TEST(MeshFile, EveryFaultIsNamed) {
    const Folder folder;
    const auto expect_error = [&](const std::string& name, const std::string& bytes, const std::string& word,
                                  const Vec3& scale = {1, 1, 1}) {
        const auto file = read_mesh({folder.write(name, bytes), scale, "", false});
        ASSERT_FALSE(file.ok()) << name;
        EXPECT_NE(file.error().message.find(word), std::string::npos) << file.error().message;
        EXPECT_FALSE(file.error().remedy.empty());
    };
    expect_error("empty.stl", "", "empty");
    expect_error("words.obj", "nothing of use\n", "mesh");
    expect_error("cut.stl", binary_stl().substr(0, 90), "mesh");
    expect_error("cut.dae", dae("1", "Z_UP").substr(0, 300), "mesh");
    std::string word = dae("1", "Z_UP");
    expect_error("word.dae", word.insert(word.find("<p>") + 3, "1e9 "), "'1e9'");
    expect_error("cloud.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "");
    expect_error("kind.xyz", "1 2 3", "xyz");
    expect_error("nan.stl", ascii_stl("nan"), "");
    expect_error("far.stl", binary_stl(), "1000 km", {1e9, 1, 1});
    expect_error("infinite.stl", binary_stl(), "finite", {std::numeric_limits<double>::infinity(), 1, 1});
    expect_error("flat.stl", binary_stl(), "without area", {1, 0, 0});
    EXPECT_FALSE(read_mesh({"/no/such/file.stl", {1, 1, 1}, "", false}).ok());
}

TEST(MeshFile, VrmlIsAnErrorWithTheWaysToConvertIt) {
    const Folder folder;
    const auto file = read_mesh({folder.write("hand.wrl", "#VRML V2.0 utf8\n"), {1, 1, 1}, "", false});
    ASSERT_FALSE(file.ok());
    EXPECT_NE(file.error().remedy.find("Blender"), std::string::npos) << file.error().text();
}

TEST(MeshFile, BytesChangedAtRandomNeverCrash) {
    const Folder folder;
    std::uint64_t seed = 1;
    const auto next = [&] {
        return seed = seed * 6364136223846793005ull + 1442695040888963407ull, seed >> 33;
    };
    for (int round = 0; round < 200; ++round) {
        std::string bytes = round % 2 == 0 ? binary_stl() : ascii_stl();
        for (int k = 0; k < 3; ++k) bytes[next() % bytes.size()] = static_cast<char>(next());
        const auto file = read_mesh({folder.write("a.stl", bytes), {1, 1, 1}, "", false});
        if (!file) continue;
        for (const Vec3& v : file.value().mesh.vertices) EXPECT_TRUE(is_finite(v));
    }
}

std::string write_png(const Folder& folder, const std::string& name, unsigned format, unsigned columns,
                      unsigned rows, const void* samples) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = columns, image.height = rows, image.format = format;
    const std::string path = folder.write(name, "");
    EXPECT_NE(png_image_write_to_file(&image, path.c_str(), 0, samples, 0, nullptr), 0) << image.message;
    return path;
}

TEST(ImageFile, EightAndSixteenBitGreysComeAsTheyStandInTheFile) {
    const Folder folder;
    const std::uint8_t grey[6] = {0, 51, 102, 153, 204, 255};
    const auto image = read_png(write_png(folder, "a.png", PNG_FORMAT_GRAY, 3, 2, grey));
    ASSERT_TRUE(image.ok()) << image.error().message;
    ASSERT_EQ(image.value().columns, 3u);
    ASSERT_EQ(image.value().rows, 2u);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(image.value().values[i], 0.2 * static_cast<double>(i), 1e-12);
    const std::uint16_t wide[4] = {0, 1000, 30000, 65535};
    const auto deep = read_png(write_png(folder, "b.png", PNG_FORMAT_LINEAR_Y, 2, 2, wide));
    ASSERT_TRUE(deep.ok());
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(deep.value().values[i], wide[i] / 65535.0, 1e-12);
}

TEST(ImageFile, ATiffIsAnErrorWithTheWayToConvertIt) {
    const Folder folder;
    const auto picture = read_png(folder.write("height.tif", std::string("II*\0\x08\0\0\0", 8)));
    ASSERT_FALSE(picture.ok());
    EXPECT_NE(picture.error().remedy.find("gdal_translate"), std::string::npos);
}

TEST(ImageFile, WhatIsNoPictureIsAnError) {
    const Folder folder;
    EXPECT_FALSE(read_png(folder.write("a.png", "")).ok());
    EXPECT_FALSE(read_png(folder.write("b.png", "GIF89a something else")).ok());
    EXPECT_FALSE(read_png("/no/such.png").ok());
    const std::uint8_t one = 7;
    const auto small = read_png(write_png(folder, "c.png", PNG_FORMAT_GRAY, 1, 1, &one));
    ASSERT_FALSE(small.ok());
    EXPECT_NE(small.error().message.find("1 x 1"), std::string::npos);
}

}  // namespace
}  // namespace roboss
