// Materials of OGRE scripts: Gazebo's by name, and scripts beside a model.
#include <gtest/gtest.h>

#include "sdf/ogre_materials.h"
#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;
using namespace std::string_literals;
using sdf_import::gazebo_material;
using sdf_import::parse_material_script;

std::string picture() {
    return "\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR\0\0\0\4\0\0\0\4\x08\2\0\0\0crc!\0\0\0\0IENDcrc!"s;
}

const std::string kScript =
    "// a comment { with a brace\n"
    "material Box/Plain\n{\n technique\n {\n  pass main {\n   ambient 0.1 0.2 0.3 1\n   diffuse 0.4 0.5 0.6 "
    "0.5\n"
    "   specular 0.9 0.9 0.9 1 32\n   emissive 0 0 0.2\n  } } }\n"
    "/* material Box/Gone { technique { pass { diffuse 1 1 1 1 } } } */\n"
    "material Box/Child : Box/Plain\n{ technique { pass { emissive 1 0 0 } } }\n"
    "material Box/Red : Gazebo/Red\n{\n}\n"
    "material Box/Wood { technique { pass { diffuse 1 1 1 1\n texture_unit {\n texture wood.png\n } } } }\n";

TEST(OgreMaterials, AScriptIsReadBlockByBlock) {
    const auto found = parse_material_script(kScript);
    ASSERT_EQ(found.size(), 4u);
    EXPECT_EQ(found.at("Box/Plain").diffuse, (Vec3{0.4, 0.5, 0.6}));
    EXPECT_EQ(found.at("Box/Plain").ambient, (Vec3{0.1, 0.2, 0.3}));
    EXPECT_EQ(found.at("Box/Plain").alpha, 0.5);
    EXPECT_EQ(found.at("Box/Child").diffuse, (Vec3{0.4, 0.5, 0.6})) << "inherited";
    EXPECT_EQ(found.at("Box/Child").emissive, (Vec3{1, 0, 0}));
    EXPECT_EQ(found.at("Box/Red").diffuse, (Vec3{1, 0, 0})) << "inherited from Gazebo's";
    EXPECT_EQ(found.at("Box/Wood").texture, "wood.png");
}

TEST(OgreMaterials, AnyTextIsASafeScript) {
    EXPECT_TRUE(parse_material_script("").empty());
    EXPECT_TRUE(parse_material_script("}}}} { material").empty());
    EXPECT_EQ(parse_material_script("material A { diffuse x y z\n ambient 1").size(), 1u);
}

TEST(OgreMaterials, GazeboHasItsOwn) {
    ASSERT_NE(gazebo_material("Gazebo/Grey"), nullptr);
    EXPECT_EQ(gazebo_material("Gazebo/Grey")->diffuse, (Vec3{0.7, 0.7, 0.7}));
    EXPECT_EQ(gazebo_material("Gazebo/Orange")->diffuse, (Vec3{1, 0.5088, 0.0468}));
    EXPECT_EQ(gazebo_material("Gazebo/BlueTransparent")->alpha, 0.5);
    EXPECT_EQ(gazebo_material("Gazebo/GreenGlow")->emissive, (Vec3{0, 1, 0}));
    EXPECT_EQ(gazebo_material("Gazebo/NoSuch"), nullptr);
}

std::string visual(const std::string& material) {
    return "<visual name='v'><geometry><box/></geometry><material>" + material + "</material></visual>";
}

Loaded load(const TestFolder& folder, const std::string& material) {
    folder.write("world.sdf", "<sdf version='1.6'><world name='w'><model name='m'>" +
                                  link("a", visual(material)) + "</model></world></sdf>");
    return folder.load("world.sdf");
}

const VisualSpec& first(const Loaded& loaded) {
    return loaded.world->prototypes[0].links[0].visuals[0];
}

TEST(OgreMaterials, AVisualHasTheColourOfGazebosName) {
    const TestFolder folder;
    const Loaded loaded = load(folder,
                               "<script><uri>file://media/materials/scripts/gazebo.material</uri>"
                               "<name>Gazebo/Red</name></script>");
    EXPECT_EQ(loaded.diagnostics.items().size(), 0u) << loaded.text();
    EXPECT_EQ(first(loaded).rgb, (Vec3{1, 0, 0}));
}

TEST(OgreMaterials, AScriptBesideTheModelGivesColourAndPicture) {
    const TestFolder folder;
    folder.write("models/box/materials/scripts/box.material", kScript);
    folder.write("models/box/materials/textures/wood.png", picture());
    const std::string uri =
        "<uri>model://box/materials/scripts</uri><uri>model://box/materials/textures</uri>";
    const Loaded plain = load(folder, "<script>" + uri + "<name>Box/Plain</name></script>");
    EXPECT_EQ(plain.diagnostics.items().size(), 0u) << plain.text();
    EXPECT_EQ(first(plain).rgb, (Vec3{0.4, 0.5, 0.6}));
    EXPECT_EQ(first(plain).alpha, 0.5);
    EXPECT_EQ(first(plain).emissive, (Vec3{0, 0, 0.2}));
    const Loaded wood = load(folder, "<script>" + uri + "<name>Box/Wood</name></script>");
    EXPECT_NE(first(wood).finish.colour, nullptr) << wood.text();
    const Loaded own =
        load(folder, "<script>" + uri + "<name>Box/Plain</name></script><diffuse>0 1 0 1</diffuse>");
    EXPECT_EQ(first(own).rgb, (Vec3{0, 1, 0})) << "what the file writes itself comes after the script";
}

TEST(OgreMaterials, AnUnknownNameIsANote) {
    const TestFolder folder;
    const Loaded loaded = load(folder, "<script><name>No/Such</name></script>");
    ASSERT_NE(loaded.find("unknown-material"), nullptr) << loaded.text();
    EXPECT_EQ(loaded.find("unknown-material")->severity, Severity::kNote);
}

TEST(OgreMaterials, AUrdfNamesThemInItsGazeboElement) {
    const TestFolder folder;
    folder.write(
        "robot.urdf",
        "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' "
        "iyy='1' iyz='0' izz='1'/></inertial><visual><geometry><box size='1 1 1'/></geometry></visual>"
        "</link><gazebo reference='a'><material>Gazebo/Blue</material></gazebo></robot>");
    const Loaded loaded = folder.load("robot.urdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(first(loaded).rgb, (Vec3{0, 0, 1})) << loaded.text();
}

}  // namespace
}  // namespace roboss
