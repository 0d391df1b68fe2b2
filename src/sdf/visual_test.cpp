// What visuals look like: pictures of pbr materials, of meshes and of heightmaps; what is missing is a
// warning with file and line.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;
using namespace std::string_literals;

/// A PNG's header and end; its size is all that is read here.
std::string picture(char width = 4) {
    return "\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR\0\0\0"s + width + "\0\0\0\4\x08\2\0\0\0crc!\0\0\0\0IENDcrc!"s;
}

const std::string kObj =
    "mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0.25 1\n"
    "usemtl painted\nf 1/1 2/2 3/3\nf 1/1 2/3 4/2\nusemtl plain\nf 2/1 3/2 4/3\n";

Loaded load(const TestFolder& folder, const std::string& visual, const LoadOptions& options = {}) {
    folder.write("world.sdf", "<sdf version='1.11'><world name='w'><model name='m'>" +
                                  link("a", "\n<visual name='v'>\n" + visual + "\n</visual>") +
                                  "</model></world></sdf>");
    return folder.load("world.sdf", options);
}

const std::vector<VisualSpec>& visuals_of(const Loaded& loaded) {
    return loaded.world->prototypes[0].links[0].visuals;
}

const std::string kBox = "<geometry><box><size>1 1 1</size></box></geometry>";

std::string pbr(const std::string& inner) {
    return kBox + "\n<material><pbr><metal>" + inner + "</metal></pbr></material>";
}

TEST(SdfVisuals, APbrMaterialHasItsPicturesAndNumbers) {
    const TestFolder folder;
    folder.write("wood.png", picture());
    folder.write("media/bumps.png", picture(8));
    const Loaded loaded =
        load(folder, pbr("<albedo_map>wood.png</albedo_map><normal_map>media/bumps.png</normal_map>"
                         "<roughness_map>wood.png</roughness_map><roughness>0.3</roughness>"));
    EXPECT_EQ(loaded.diagnostics.items().size(), 0u) << loaded.text();
    ASSERT_EQ(visuals_of(loaded).size(), 1u);
    const VisualSpec& visual = visuals_of(loaded)[0];
    ASSERT_NE(visual.finish.colour, nullptr);
    EXPECT_EQ(visual.finish.colour->width, 4u);
    EXPECT_EQ(visual.finish.colour, visual.finish.roughness_map) << "one file is read once";
    ASSERT_NE(visual.finish.normal, nullptr);
    EXPECT_EQ(visual.finish.normal->width, 8u);
    EXPECT_EQ(visual.finish.metalness_map, nullptr);
    EXPECT_EQ(visual.finish.roughness, 0.3);
    EXPECT_EQ(visual.finish.metalness, 0.5) << "SDFormat's own";
    EXPECT_EQ(visual.rgb.x, 1) << "the picture alone, for no <diffuse> is given";
}

TEST(SdfVisuals, VisibilityFlagsMayBeHexadecimal) {
    const TestFolder folder;
    const Loaded loaded = load(folder, kBox + "<visibility_flags>0x1F</visibility_flags>");
    EXPECT_EQ(loaded.diagnostics.items().size(), 0u) << loaded.text();
    EXPECT_EQ(visuals_of(loaded).at(0).visibility_flags, 0x1Fu);
    EXPECT_TRUE(load(folder, kBox + "<visibility_flags>0x1G</visibility_flags>").find("bad-value"));
}

TEST(SdfVisuals, AMissingOrUnreadablePictureIsAWarningWithItsLine) {
    const TestFolder folder;
    folder.write("broken.png", picture().substr(0, 20));
    folder.write("secret.png", "root:x:0:0");
    const struct {
        const char* file;
        const char* code;
        const char* words;
    } cases[] = {{"nowhere.png", "file-not-found", "'nowhere.png' was not found"},
                 {"broken.png", "bad-picture", "is damaged or cut off"},
                 {"secret.png", "bad-picture", "is no picture"}};
    for (const auto& c : cases) {
        const Loaded loaded = load(folder, pbr("\n\n<albedo_map>"s + c.file + "</albedo_map>"));
        ASSERT_TRUE(loaded.world);
        EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
        const Diagnostic* found = loaded.find(c.code);
        ASSERT_NE(found, nullptr) << loaded.text();
        EXPECT_EQ(found->severity, Severity::kWarning);
        EXPECT_EQ(found->where.line, 6) << loaded.text();
        EXPECT_NE(found->message.find(c.words), std::string::npos) << found->message;
        EXPECT_NE(found->remedy.find("plain colour"), std::string::npos);
        EXPECT_EQ(visuals_of(loaded)[0].finish.colour, nullptr);
        EXPECT_EQ(visuals_of(loaded)[0].rgb.x, 0.7);
    }
}

TEST(SdfVisuals, AMeshIsAVisualForEachOfItsMaterials) {
    const TestFolder folder;
    folder.write("models/part.obj", kObj);
    folder.write("models/part.mtl",
                 "newmtl painted\nKd 0 0 0\nmap_Kd paint.png\nnewmtl plain\nKd 0.1 0.2 0.3\n");
    folder.write("materials/textures/paint.png", picture());
    const std::string mesh =
        "<geometry><mesh><uri>models/part.obj</uri><scale>2 2 2</scale></mesh></geometry>";
    const Loaded loaded = load(folder, mesh);
    EXPECT_EQ(loaded.diagnostics.items().size(), 0u) << loaded.text();
    ASSERT_EQ(visuals_of(loaded).size(), 2u);
    const VisualSpec &painted = visuals_of(loaded)[0], &plain = visuals_of(loaded)[1];
    ASSERT_NE(painted.geometry.mesh, nullptr);
    EXPECT_EQ(painted.geometry.mesh->triangles.size(), 2u);
    EXPECT_EQ(painted.geometry.mesh->vertices.size(), 5u) << "a corner with two places in the picture is two";
    ASSERT_EQ(painted.geometry.mesh->uv.size(), 5u);
    EXPECT_EQ(painted.geometry.mesh->uv[2], (std::array<float, 2>{0.25f, 1.0f}));
    EXPECT_EQ(painted.geometry.mesh->vertices[1].x, 2.0);
    ASSERT_NE(painted.finish.colour, nullptr) << "found where Gazebo's models have it";
    EXPECT_EQ(painted.rgb.x, 1) << "black would hide the picture";
    EXPECT_EQ(plain.geometry.mesh->triangles.size(), 1u);
    EXPECT_EQ(plain.finish.colour, nullptr);
    EXPECT_NEAR(plain.rgb.y, 0.2, 1e-6);
    const Loaded covered = load(folder, mesh + "<material><diffuse>1 0 0 1</diffuse></material>");
    ASSERT_EQ(visuals_of(covered).size(), 2u);
    EXPECT_EQ(visuals_of(covered)[0].finish.colour, nullptr)
        << "the visual's own material lies over the file's";
    EXPECT_EQ(visuals_of(covered)[1].rgb.x, 1);
}

TEST(SdfVisuals, AMeshWhosePictureIsMissingOrThatCannotBeReadIsAWarning) {
    const TestFolder folder;
    folder.write("part.obj", kObj);
    folder.write("part.mtl", "newmtl painted\nKd 1 1 1\nmap_Kd paint.png\nnewmtl plain\n");
    folder.write("bad.obj", "nothing of use\n");
    const Loaded loaded = load(folder, "<geometry>\n<mesh><uri>part.obj</uri></mesh></geometry>");
    ASSERT_NE(loaded.find("file-not-found"), nullptr) << loaded.text();
    EXPECT_EQ(loaded.find("file-not-found")->where.line, 4);
    EXPECT_EQ(visuals_of(loaded).size(), 2u);
    const Loaded bad = load(folder, "<geometry>\n<mesh><uri>bad.obj</uri></mesh></geometry>");
    EXPECT_FALSE(bad.diagnostics.has_errors()) << bad.text();
    ASSERT_NE(bad.find("bad-mesh"), nullptr) << bad.text();
    EXPECT_EQ(bad.find("bad-mesh")->severity, Severity::kWarning);
}

TEST(SdfVisuals, AHeightmapIsDrawnInItsFirstTexture) {
    const TestFolder folder;
    folder.write("grass.png", picture());
    const std::string texture =
        "<texture><diffuse>grass.png</diffuse><normal></normal><size>2</size></texture>";
    const Loaded loaded = load(folder, "<geometry><heightmap><uri>nowhere.png</uri><size>4 4 1</size>" +
                                           texture + texture + "</heightmap></geometry>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("second-texture"), nullptr) << loaded.text();
    EXPECT_NE(visuals_of(loaded)[0].finish.colour, nullptr);
    EXPECT_EQ(visuals_of(loaded)[0].geometry.texture_size, 2);
}

TEST(SdfVisuals, WithoutLooksNoFileIsOpenedButMissingOnesAreTold) {
    const TestFolder folder;
    folder.write("broken.png", "none");
    LoadOptions blind;
    blind.looks = false;
    const Loaded loaded =
        load(folder, pbr("<albedo_map>broken.png</albedo_map><normal_map>nowhere.png</normal_map>"), blind);
    EXPECT_EQ(loaded.find("bad-picture"), nullptr) << loaded.text();
    EXPECT_NE(loaded.find("file-not-found"), nullptr) << loaded.text();
}

}  // namespace
}  // namespace roboss
