// What files of other people hold, one small file for each cause that refused them once: lights as models,
// Gazebo's and ROS's ways to name files, Fuel's caches, sizes of 0, stray characters, and models with errors
// among good ones.
#include <gtest/gtest.h>

#include <cstdlib>

#include "mesh/image_file.h"
#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

const std::string kFace = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string world_file(const std::string& elements) {
    return "<sdf version='1.6'><world name='w'>" + elements + "</world></sdf>";
}

std::string model_with_mesh(const std::string& uri) {
    return "<model name='m'>" +
           link("a",
                "<collision name='c'><geometry><mesh><uri>" + uri + "</uri></mesh></geometry></collision>") +
           "</model>";
}

std::string model_file(const std::string& model) {
    return "<sdf version='1.6'>" + model + "</sdf>";
}

/// Loads with an environment variable set.
Loaded load_with(const TestFolder& folder, const std::string& file, const char* variable,
                 const std::string& value) {
    setenv(variable, value.c_str(), 1);
    Loaded loaded = folder.load(file);
    unsetenv(variable);
    return loaded;
}

/// One model came through without an error, with its mesh.
void expect_mesh(const Loaded& loaded, const std::string& what) {
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << what << "\n" << loaded.text();
    ASSERT_TRUE(loaded.world) << what;
    ASSERT_EQ(loaded.world->instances.size(), 1u) << what;
    const LinkSpec& part = loaded.world->prototypes[0].links[0];
    ASSERT_EQ(part.collisions.size(), 1u) << what;
    EXPECT_NE(part.collisions[0].geometry.mesh, nullptr) << what;
}

TEST(ForeignFiles, AnIncludedLightShines) {
    const TestFolder folder;
    folder.write("models/sun/model.sdf", model_file("<light name='sun' type='directional'/>"));
    folder.write("world.sdf", world_file("<include><uri>model://sun</uri></include><model name='m'>" +
                                         link("a") + "</model>"));
    const Loaded loaded = folder.load("world.sdf");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_TRUE(loaded.world);
    EXPECT_EQ(loaded.world->instances.size(), 1u);
    ASSERT_EQ(loaded.world->look.lights.size(), 1u);
    EXPECT_EQ(loaded.world->look.lights[0].kind, LightKind::kDirectional);
}

TEST(ForeignFiles, AFileWithALightOnlyIsAnEmptyWorld) {
    const Loaded loaded = load_text(model_file("<light name='sun' type='directional'/>"));
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_TRUE(loaded.world);
    EXPECT_TRUE(loaded.world->instances.empty());
    EXPECT_EQ(loaded.world->name, "sun");
    EXPECT_NE(loaded.find("no-model"), nullptr);
}

TEST(ForeignFiles, PathsOfAnotherComputerAreFoundByTheirEnd) {
    const TestFolder folder;
    folder.write("car/meshes/part.obj", kFace);
    for (const char* uri : {"file:///home/ada/car/meshes/part.obj", "/home/ada/projects/meshes/part.obj"}) {
        folder.write("car/model.sdf", world_file(model_with_mesh(uri)));
        expect_mesh(folder.load("car/model.sdf"), uri);
    }
    folder.write("car/model.sdf", world_file(model_with_mesh("file:///home/ada/car/other/part.obj")));
    EXPECT_NE(folder.load("car/model.sdf").find("file-not-found"), nullptr) << "a name alone says too little";
}

TEST(ForeignFiles, FileUrisAreLookedForInEveryResourceFolder) {
    const TestFolder folder;
    folder.write("share/media/part.obj", kFace);
    folder.write("world/world.sdf", world_file(model_with_mesh("file://media/part.obj")));
    EXPECT_NE(folder.load("world/world.sdf").find("file-not-found"), nullptr);
    for (const char* variable : {"GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "GZ_SIM_RESOURCE_PATH",
                                 "IGN_GAZEBO_RESOURCE_PATH", "GZ_FILE_PATH", "IGN_FILE_PATH", "SDF_PATH"})
        expect_mesh(load_with(folder, "world/world.sdf", variable, "/nowhere:" + folder.path("share")),
                    variable);
}

TEST(ForeignFiles, GazeboClassicHasMeshesInMediaModels) {
    const TestFolder folder;
    folder.write("share/Media/models/part.obj", kFace);
    folder.write("world/world.sdf", world_file(model_with_mesh("file://part.obj")));
    EXPECT_NE(folder.load("world/world.sdf").find("file-not-found"), nullptr);
    expect_mesh(load_with(folder, "world/world.sdf", "GAZEBO_RESOURCE_PATH", folder.path("share")), "Media");
}

TEST(ForeignFiles, FilesAreFoundInFoldersAboveTheModel) {
    const TestFolder folder;
    folder.write("repo/models/part/meshes/part.obj", kFace);
    for (const std::string uri : {"file://models/part/meshes/part.obj", "model://part/meshes/part.obj",
                                  "model:///part/meshes/part.obj", "package://part/meshes/part.obj"}) {
        folder.write("repo/models/part/model.sdf", model_file(model_with_mesh(uri)));
        expect_mesh(folder.load("repo/models/part/model.sdf"), uri);
    }
}

TEST(ForeignFiles, FoldersAboveARepositoryAreNotSearched) {
    const TestFolder folder;
    folder.write("part/part.obj", kFace);
    folder.write("repo/.git", "");
    folder.write("repo/worlds/world.sdf", world_file(model_with_mesh("model://part/part.obj")));
    EXPECT_NE(folder.load("repo/worlds/world.sdf").find("file-not-found"), nullptr);
}

TEST(ForeignFiles, APackageIsFoundByTheNameInItsPackageXml) {
    const TestFolder folder;
    folder.write("some_folder/package.xml", "<package><name>arm_description</name></package>");
    folder.write("some_folder/meshes/part.obj", kFace);
    folder.write("some_folder/urdf/world.sdf",
                 world_file(model_with_mesh("package://arm_description/meshes/part.obj")));
    expect_mesh(folder.load("some_folder/urdf/world.sdf"), "package.xml");
    folder.write("install/share/arm_description/meshes/part.obj", kFace);
    folder.write("away/world.sdf", world_file(model_with_mesh("package://arm_description/meshes/part.obj")));
    expect_mesh(load_with(folder, "away/world.sdf", "AMENT_PREFIX_PATH", folder.path("install")), "ament");
}

TEST(ForeignFiles, NamesInAnotherCaseAreFoundLast) {
    const TestFolder folder;
    folder.write("Models/Part/Part.OBJ", kFace);
    folder.write("world.sdf", world_file(model_with_mesh("models/part/part.obj")));
    expect_mesh(folder.load("world.sdf"), "another case");
}

TEST(ForeignFiles, PercentSignsStandForCharacters) {
    const TestFolder folder;
    folder.write("my models/part.obj", kFace);
    folder.write("world.sdf", world_file(model_with_mesh("my%20models/part.obj")));
    expect_mesh(folder.load("world.sdf"), "%20");
}

TEST(ForeignFiles, FuelModelsAreFoundInWhateverCaseAndVersion) {
    const TestFolder folder;
    const std::string model = "fuel/fuel.gazebosim.org/openrobotics/models/red ball/";
    folder.write(model + "2/model.sdf", model_file("<model name='old'>" + link("a") + "</model>"));
    folder.write(model + "3/model.sdf", model_file("<model name='new'>" + link("a") + "</model>"));
    folder.write(model + "3/meshes/part.obj", kFace);
    const std::string address = "https://fuel.ignitionrobotics.org/1.0/OpenRobotics/models/Red Ball";
    for (const auto& [ending, name] : {std::pair<std::string, std::string>{"", "new"},
                                       {"/tip", "new"},
                                       {"/2", "old"},
                                       {"/3/", "new"},
                                       {"/tip/files", "new"}}) {
        folder.write("world.sdf", world_file("<include><uri>" + address + ending + "</uri></include>"));
        const Loaded loaded = load_with(folder, "world.sdf", "GZ_FUEL_CACHE_PATH", folder.path("fuel"));
        ASSERT_TRUE(loaded.world && loaded.world->instances.size() == 1) << ending << "\n" << loaded.text();
        EXPECT_EQ(loaded.world->instances[0].name, name) << ending;
    }
    folder.write("world.sdf", world_file(model_with_mesh(
                                  "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Red%20Ball/tip/"
                                  "files/meshes/part.obj")));
    expect_mesh(load_with(folder, "world.sdf", "GZ_FUEL_CACHE_PATH", folder.path("fuel")), "file of a model");
}

TEST(ForeignFiles, AModelMayNameItsOwnFilesByTheirAddressOnFuel) {
    const TestFolder folder;
    folder.write("models/Coke/meshes/coke.obj", kFace);
    folder.write("models/Coke/model.sdf",
                 model_file(model_with_mesh(
                     "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Coke/2/files/meshes/coke.obj")));
    expect_mesh(folder.load("models/Coke/model.sdf"), "own file");
}

TEST(ForeignFiles, ASizeOfZeroIsAMillimetre) {
    const Loaded loaded = load_elements(
        "<model name='m'>" +
        link("a",
             "<collision name='point'><geometry><sphere><radius>0</radius></sphere></geometry></collision>"
             "<collision name='plate'><geometry><box><size>1 2 0</size></box></geometry></collision>") +
        "</model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_NE(loaded.find("no-size"), nullptr);
    const auto& collisions = loaded.world->prototypes[0].links[0].collisions;
    EXPECT_EQ(collisions[0].geometry.radius, 1e-3);
    EXPECT_EQ(collisions[1].geometry.size, (Vec3{1, 2, 1e-3}));
}

TEST(ForeignFiles, TextBehindANumberIsIgnoredWithAWarning) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a") + link("b") +
        "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>"
        "<limit><velocity>2.5\"</velocity></limit></axis></joint></model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("trailing-text"), nullptr);
    EXPECT_EQ(loaded.world->prototypes[0].joints[0].axes[0].max_velocity, 2.5);
}

TEST(ForeignFiles, ASecondPointInANumberOfAPoseEndsIt) {
    const Loaded loaded =
        load_elements("<model name='m'><pose>0 0 2.286.0 0 0 0</pose>" + link("a") + "</model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("trailing-text"), nullptr);
    EXPECT_EQ(loaded.world->instances[0].X_WM.p.z, 2.286);
}

TEST(ForeignFiles, OfSeveralNumbersWhereOneBelongsTheFirstCounts) {
    const Loaded loaded = load_elements("<model name='m'>" +
                                        link("a",
                                             "<collision name='c'><geometry><sphere><radius>0.5 2 "
                                             "3</radius></sphere></geometry></collision>") +
                                        "</model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("trailing-text"), nullptr);
    EXPECT_EQ(loaded.world->prototypes[0].links[0].collisions[0].geometry.radius, 0.5);
}

TEST(ForeignFiles, ALensThatIsNotKnownCostsNoModel) {
    const Loaded loaded = load_elements(
        "<model name='m'>" +
        link("a",
             "<sensor name='eye' type='wideanglecamera'><camera><horizontal_fov>2</horizontal_fov>"
             "<lens><type>sterographic</type></lens></camera></sensor>") +
        "</model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_NE(loaded.find("sensor"), nullptr) << loaded.text();
    EXPECT_NE(loaded.find("sensor")->message.find("'sterographic'"), std::string::npos);
    EXPECT_EQ(loaded.world->prototypes[0].links[0].sensors.size(), 1u);
}

TEST(ForeignFiles, AModelThatIsAHeightmapStandsStill) {
    const TestFolder folder;
    ASSERT_TRUE(write_png16(folder.path("hills.png"), 3, 3, std::vector<std::uint16_t>(9, 0)).ok());
    folder.write("hills.sdf", model_file("<model name='hills'><link name='a'><collision name='c'><geometry>"
                                         "<heightmap><uri>hills.png</uri><size>4 4 1</size></heightmap>"
                                         "</geometry></collision></link></model>"));
    const Loaded loaded = folder.load("hills.sdf");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("movable-heightmap"), nullptr) << loaded.text();
    ASSERT_TRUE(loaded.world);
    EXPECT_TRUE(loaded.world->prototypes.at(0).is_static);
}

TEST(ForeignFiles, AnEmptyElementIsItsDefaultWithAWarning) {
    const Loaded loaded = load_elements(
        "<model name='m'>" +
        link("a",
             "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry><surface><bounce>"
             "<restitution_coefficient/></bounce></surface></collision>") +
        "</model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("empty-value"), nullptr);
    EXPECT_EQ(loaded.world->prototypes[0].links[0].collisions[0].surface.restitution, 0);
}

TEST(ForeignFiles, BitmasksHaveThirtyTwoBits) {
    const Loaded loaded = load_elements(
        "<model name='m'>" +
        link("a",
             "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry><surface><contact>"
             "<collide_bitmask>0xFFFF0001</collide_bitmask></contact></surface></collision>") +
        "</model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_EQ(loaded.world->prototypes[0].links[0].collisions[0].surface.collide_bitmask, 0xFFFF0001u);
}

TEST(ForeignFiles, AGearboxWithoutAReferenceIsLeftOut) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a") + link("b") +
        "<joint name='g' type='gearbox'><parent>a</parent><child>b</child><gearbox_ratio>2</gearbox_ratio>"
        "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 0 1</xyz></axis2></joint></model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_NE(loaded.find("gearbox-reference"), nullptr);
    EXPECT_TRUE(loaded.world->prototypes[0].joints.empty());
}

TEST(ForeignFiles, AVisualOfUrdfIsKeptThoughItsMaterialHasNoName) {
    const Loaded loaded = load_text(
        "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
        "ixz='0' iyz='0'/></inertial><visual><geometry><box size='1 1 1'/></geometry><material/></visual>"
        "</link></robot>",
        "r.urdf");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_TRUE(loaded.world);
    EXPECT_EQ(loaded.world->prototypes.at(0).links.at(0).visuals.size(), 1u);
}

TEST(ForeignFiles, InertialsThatUrdfdomWouldDropKeepTheirLinks) {
    const auto robot = [](const std::string& inertia) {
        return load_text("<robot name='r'><link name='a'><inertial><mass value='2'/>" + inertia +
                             "</inertial></link></robot>",
                         "r.urdf");
    };
    const Loaded broken_line = robot("<inertia ixx='1' iyy='2' izz='2.5\n' ixy='0' ixz='0' iyz='0'/>");
    EXPECT_FALSE(broken_line.diagnostics.has_errors()) << broken_line.text();
    ASSERT_TRUE(broken_line.world);
    EXPECT_EQ(broken_line.world->prototypes.at(0).links.at(0).inertia_C(2, 2), 2.5);
    const Loaded no_moments = robot("");
    EXPECT_FALSE(no_moments.diagnostics.has_errors()) << no_moments.text();
    ASSERT_TRUE(no_moments.world);
    EXPECT_EQ(no_moments.world->prototypes.at(0).links.at(0).mass, 2);
}

TEST(ForeignFiles, ANestedStaticModelDoesNotMove) {
    const std::string inner = "<model name='inner'><static>true</static>" + link("a") + "</model>";
    const Loaded alone = load_elements("<model name='m'>" + inner + "</model>");
    EXPECT_FALSE(alone.diagnostics.has_errors()) << alone.text();
    ASSERT_TRUE(alone.world && alone.world->prototypes.size() == 1);
    EXPECT_TRUE(alone.world->prototypes[0].is_static);
    const Loaded beside = load_elements("<model name='m'>" + inner + link("b") + "</model>");
    EXPECT_FALSE(beside.diagnostics.has_errors()) << beside.text();
    ASSERT_TRUE(beside.world && beside.world->prototypes.size() == 1);
    const ModelSpec& model = beside.world->prototypes[0];
    EXPECT_FALSE(model.is_static);
    ASSERT_EQ(model.joints.size(), 1u);
    EXPECT_EQ(model.joints[0].parent, "world");
    EXPECT_EQ(model.joints[0].child, "inner::a");
    EXPECT_NE(beside.find("nested-static"), nullptr);
}

TEST(ForeignFiles, TwoAxesOfAJointAreNeverParallel) {
    const Loaded loaded =
        load_elements("<model name='m'>" + link("a") + link("b") +
                      "<joint name='j' type='universal'><parent>a</parent><child>b</child></joint></model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("parallel-axes"), nullptr);
    const auto& axes = loaded.world->prototypes.at(0).joints.at(0).axes;
    EXPECT_NEAR(dot(axes.at(0).xyz, axes.at(1).xyz), 0, 1e-12);
}

TEST(ForeignFiles, AJointOfUrdfMayHaveTheNameOfALink) {
    const std::string inertial =
        "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
    const Loaded loaded =
        load_text("<robot name='r'><link name='base'>" + inertial + "</link><link name='arm'>" + inertial +
                      "</link><link name='tip'>" + inertial +
                      "</link><joint name='arm' type='continuous'><parent link='base'/><child link='arm'/>"
                      "<axis xyz='0 0 1'/></joint><joint name='follow' type='continuous'><parent link='arm'/>"
                      "<child link='tip'/><axis xyz='0 0 1'/><mimic joint='arm'/></joint></robot>",
                  "r.urdf");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    ASSERT_TRUE(loaded.world && loaded.world->prototypes.size() == 1);
    ASSERT_EQ(loaded.world->prototypes[0].joints.size(), 2u);
    for (const JointSpec& joint : loaded.world->prototypes[0].joints) {
        EXPECT_TRUE(joint.name == "arm" || joint.name == "follow") << joint.name;
        if (joint.name == "follow") {
            ASSERT_TRUE(joint.axes.at(0).mimic);
            EXPECT_EQ(joint.axes[0].mimic->joint, "arm");
        }
    }
}

TEST(ForeignFiles, AModelWithErrorsIsLeftOutAndNamed) {
    const std::string broken =
        "<model name='broken'><link name='a'><inertial><mass>-1</mass></inertial></link></model>";
    const std::string good = "<model name='good'>" + link("a") + "</model>";
    const Loaded both = load_elements(broken + "\n" + good);
    ASSERT_TRUE(both.world);
    ASSERT_EQ(both.world->instances.size(), 1u) << both.text();
    EXPECT_EQ(both.world->instances[0].name, "good");
    EXPECT_TRUE(both.diagnostics.has_errors());
    EXPECT_FALSE(both.diagnostics.refuses()) << both.text();
    const Diagnostic* found = both.find("left-out");
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->severity, Severity::kError);
    EXPECT_NE(found->message.find("'broken'"), std::string::npos);
    const Loaded alone = load_elements(broken);
    EXPECT_TRUE(alone.diagnostics.refuses()) << "nothing is left";
    const Loaded elsewhere = load_elements(good + "<gravity>0 0</gravity>");
    EXPECT_TRUE(elsewhere.diagnostics.refuses()) << "the error is the world's";
}

TEST(ForeignFiles, EveryModelWithABadFileIsLeftOut) {
    const TestFolder folder;
    folder.write("bad.obj", "");
    const std::string mesh =
        "<collision name='c'><geometry><mesh><uri>bad.obj</uri></mesh></geometry></collision>";
    folder.write("world.sdf",
                 world_file("<model name='a'>" + link("l", mesh) + "</model><model name='b'>" +
                            link("other", mesh) + "</model><model name='c'>" + link("l") + "</model>"));
    const Loaded loaded = folder.load("world.sdf");
    ASSERT_TRUE(loaded.world);
    ASSERT_EQ(loaded.world->instances.size(), 1u) << loaded.text();
    EXPECT_EQ(loaded.world->instances[0].name, "c");
}

TEST(ForeignFiles, AnIncludeThatLeadsNowhereLeavesTheRest) {
    const Loaded loaded =
        load_elements("<include><uri>model://none</uri></include><model name='m'>" + link("a") + "</model>");
    ASSERT_TRUE(loaded.world);
    EXPECT_EQ(loaded.world->instances.size(), 1u);
    EXPECT_NE(loaded.find("include-not-found"), nullptr);
    EXPECT_FALSE(loaded.diagnostics.refuses()) << loaded.text();
}

}  // namespace
}  // namespace roboss
