// <include>: where files are looked for, what the include overrides, and nested and merged ones.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

std::string model_file(const std::string& name, const std::string& inner,
                       const std::string& version = "1.9") {
    return "<sdf version='" + version + "'>\n<model name='" + name + "'>" + inner + "</model></sdf>";
}

std::string world_file(const std::string& elements) {
    return "<sdf version='1.9'><world name='w'>" + elements + "</world></sdf>";
}

TEST(Include, FindsModelsInTheSearchPathAndOverridesNamePoseAndStatic) {
    const TestFolder folder;
    folder.write("models/car/model.config",
                 "<model><sdf version='1.4'>old.sdf</sdf><sdf version='1.9'>new.sdf</sdf></model>");
    folder.write("models/car/new.sdf", model_file("car", "<pose>9 9 9 0 0 0</pose>" + link("a")));
    folder.write(
        "world.sdf",
        world_file("<include><uri>model://car</uri></include>"
                   "<include><uri>model://car</uri><name>mine</name><pose>1 0 0 0 0 0</pose></include>"
                   "<include><uri>model://car</uri><name>rock</name><static>true</static></include>"));
    const Loaded loaded = folder.load("world.sdf", {{folder.path("models")}});
    ASSERT_TRUE(loaded.world);
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    ASSERT_EQ(loaded.world->instances.size(), 3u);
    EXPECT_EQ(loaded.world->instances[0].name, "car");
    EXPECT_EQ(loaded.world->instances[0].X_WM.p.x, 9);
    EXPECT_EQ(loaded.world->instances[1].name, "mine");
    EXPECT_EQ(loaded.world->instances[1].X_WM.p.x, 1);
    EXPECT_EQ(loaded.world->instances[0].prototype, loaded.world->instances[1].prototype);
    EXPECT_TRUE(loaded.world->prototypes[loaded.world->instances[2].prototype].is_static);
}

TEST(Include, LooksWhereTheEnvironmentSays) {
    const TestFolder folder;
    folder.write("there/ball/model.sdf", model_file("ball", link("a")));
    folder.write("world.sdf", world_file("<include><uri>model://ball</uri></include>"));
    EXPECT_NE(folder.load("world.sdf").find("include-not-found"), nullptr);
    for (const char* variable : {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH"}) {
        setenv(variable, ("/nowhere:" + folder.path("there")).c_str(), 1);
        const Loaded loaded = folder.load("world.sdf");
        unsetenv(variable);
        ASSERT_TRUE(loaded.world);
        EXPECT_EQ(loaded.world->instances.size(), 1u) << variable << "\n" << loaded.text();
    }
}

TEST(Include, DevicesPipesAndFilesWithoutEndAreNotRead) {
    const TestFolder folder;
    ASSERT_EQ(::mkfifo(folder.path("pipe.sdf").c_str(), 0600), 0);
    folder.write("endless.sdf", "<sdf");
    std::filesystem::resize_file(folder.path("endless.sdf"), std::uintmax_t{1} << 40);  // takes no room
    const auto code = [&](const std::string& uri) {
        folder.write("world.sdf", world_file("<include><uri>" + uri + "</uri></include>"));
        const Loaded loaded = folder.load("world.sdf");
        return loaded.find("too-large") != nullptr           ? "too-large"
               : loaded.find("include-not-found") != nullptr ? "include-not-found"
                                                             : "none";
    };
    EXPECT_STREQ(code("/dev/zero"), "include-not-found");
    EXPECT_STREQ(code("pipe.sdf"), "include-not-found");
    EXPECT_STREQ(code("endless.sdf"), "too-large");
}

TEST(Include, LooksInTheFolderModelsBesideTheWorld) {
    const TestFolder folder;
    folder.write("models/ball/model.sdf", model_file("ball", link("a")));
    folder.write("world.sdf", world_file("<include><uri>model://ball</uri></include>"));
    const Loaded loaded = folder.load("world.sdf");
    ASSERT_TRUE(loaded.world);
    EXPECT_EQ(loaded.world->instances.size(), 1u) << loaded.text();
}

TEST(Include, UnderstandsEveryKindOfUri) {
    const TestFolder folder;
    const std::string file = folder.write("parts/ball/model.sdf", model_file("ball", link("a")));
    for (const std::string& uri : {std::string("parts/ball/model.sdf"), std::string("parts/ball"), file,
                                   "file://" + file, std::string("file://parts/ball"),
                                   std::string("package://ball"), std::string("model://ball/model.sdf")}) {
        folder.write("world.sdf", world_file("<include><uri>" + uri + "</uri></include>"));
        const Loaded loaded = folder.load("world.sdf", {{folder.path("parts")}});
        ASSERT_TRUE(loaded.world);
        EXPECT_EQ(loaded.world->instances.size(), 1u) << uri << "\n" << loaded.text();
    }
}

TEST(Include, ThatLeadsNowhereTellsWhereItLooked) {
    const TestFolder folder;
    folder.write("world.sdf", world_file("\n\n<include><uri>model://none</uri></include>"));
    const Loaded loaded = folder.load("world.sdf", {{"/a/place"}});
    const Diagnostic* found = loaded.find("include-not-found");
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->severity, Severity::kError);
    EXPECT_EQ(found->where.line, 3);
    EXPECT_NE(found->message.find("/a/place/none"), std::string::npos);
    EXPECT_NE(found->remedy.find("--path"), std::string::npos);
}

TEST(Include, OfSunAndGroundPlaneNeedsNoFiles) {
    for (const char* prefix : {"model://", "https://fuel.gazebosim.org/1.0/OpenRobotics/models/"}) {
        const bool fuel = prefix[0] == 'h';
        const Loaded loaded = load_elements("<include><uri>" + std::string(prefix) + (fuel ? "Sun" : "sun") +
                                            "</uri></include><include><uri>" + prefix +
                                            (fuel ? "Ground Plane" : "ground_plane") +
                                            "</uri><pose>0 0 -1 0 0 0</pose></include>");
        ASSERT_TRUE(loaded.world);
        EXPECT_EQ(loaded.text(), "") << "not even a warning";
        ASSERT_EQ(loaded.world->instances.size(), 1u);
        EXPECT_EQ(loaded.world->instances[0].name, "ground_plane");
        EXPECT_EQ(loaded.world->instances[0].X_WM.p.z, -1);
        ASSERT_EQ(loaded.world->look.lights.size(), 1u);
        EXPECT_EQ(loaded.world->look.lights[0].direction, (Vec3{-0.5, 0.1, -0.9}));
    }
}

TEST(Include, OfAGroundPlaneThatIsFoundTakesThatFile) {
    const TestFolder folder;
    folder.write("models/ground_plane/model.sdf", model_file("meadow", link("grass")));
    folder.write("world.sdf", world_file("<include><uri>model://ground_plane</uri></include>"));
    const Loaded loaded = folder.load("world.sdf");
    ASSERT_TRUE(loaded.world);
    ASSERT_EQ(loaded.world->instances.size(), 1u) << loaded.text();
    EXPECT_EQ(loaded.world->instances[0].name, "meadow");
}

TEST(Include, OfAFuelModelIsLeftOutWithARemedy) {
    const Loaded loaded = load_elements(
        "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Nowhere To Be "
        "Found</uri></include>");
    const Diagnostic* found = loaded.find("remote-uri");
    ASSERT_NE(found, nullptr) << loaded.text();
    EXPECT_EQ(found->severity, Severity::kWarning);
    EXPECT_FALSE(found->remedy.empty());
}

TEST(Include, OfAFuelModelIsFoundWhereItWasDownloaded) {
    const TestFolder folder;
    folder.write("fuel/fuel.gazebosim.org/me/models/ball/2/model.sdf", model_file("ball", link("a")));
    folder.write("world.sdf",
                 world_file("<include><uri>https://fuel.gazebosim.org/1.0/me/models/ball</uri></include>"));
    setenv("GZ_FUEL_CACHE_PATH", folder.path("fuel").c_str(), 1);
    const Loaded loaded = folder.load("world.sdf");
    unsetenv("GZ_FUEL_CACHE_PATH");
    ASSERT_TRUE(loaded.world);
    EXPECT_EQ(loaded.world->instances.size(), 1u) << loaded.text();
}

TEST(Include, InAModelNestsOrMergesAndKeepsFilesAndLines) {
    const TestFolder folder;
    folder.write(
        "wheel.sdf",
        model_file(
            "wheel",
            "\n" + link("rim",
                        "<collision "
                        "name='c'><geometry><sphere><radius>0.25</radius></sphere></geometry></collision>"),
            "1.6"));
    folder.write("bumper.sdf", model_file("bumper", "<pose>7 0 0 0 0 0</pose>\n\n" + link("plate")));
    folder.write(
        "world.sdf",
        world_file(
            "<model name='car'>" + link("chassis") +
            "<include><uri>wheel.sdf</uri><name>left</name><pose>0 1 0 0 0 0</pose></include>"
            "<include><uri>wheel.sdf</uri><name>right</name><pose>0 -1 0 0 0 0</pose></include>"
            "<include merge='true'><uri>bumper.sdf</uri></include>"
            "<joint name='l' type='continuous'><parent>chassis</parent><child>left::rim</child><axis><xyz>0 "
            "1 0</xyz></axis></joint>"
            "<joint name='r' type='continuous'><parent>chassis</parent><child>right::rim</child><axis><xyz>0 "
            "1 0</xyz></axis></joint></model>"));
    const Loaded loaded = folder.load("world.sdf");
    ASSERT_TRUE(loaded.world);
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const ModelSpec& car = loaded.world->prototypes[0];
    ASSERT_EQ(car.links.size(), 4u);
    const auto named = [&](const std::string& name) {
        return *std::find_if(car.links.begin(), car.links.end(),
                             [&](const LinkSpec& l) { return l.name == name; });
    };
    EXPECT_EQ(named("left::rim").X_ML.p.y, 1);
    EXPECT_EQ(named("right::rim").X_ML.p.y, -1);
    EXPECT_EQ(named("left::rim").collisions[0].geometry.radius, 0.25);
    EXPECT_EQ(named("left::rim").where.line, 3);
    EXPECT_NE(named("left::rim").where.file.find("wheel.sdf"), std::string::npos);
    EXPECT_EQ(named("plate").X_ML.p.x, 7);
    EXPECT_EQ(named("plate").where.line, 4);
}

TEST(Include, OfItselfIsAnErrorNotACrash) {
    const TestFolder folder;
    folder.write("a.sdf", model_file("a", link("l") + "<include><uri>b.sdf</uri></include>"));
    folder.write("b.sdf", model_file("b", link("l") + "<include><uri>a.sdf</uri></include>"));
    folder.write("world.sdf", world_file("<include><uri>a.sdf</uri></include>"));
    EXPECT_NE(folder.load("world.sdf").find("include-cycle"), nullptr);
}

TEST(Include, WithAPlacementFrameStandsOnIt) {
    const TestFolder folder;
    folder.write("mast.sdf",
                 model_file("mast", link("l") + "<frame name='foot'><pose>0 0 -3 0 0 0</pose></frame>"));
    folder.write("world.sdf", world_file("<include><uri>mast.sdf</uri><placement_frame>foot</"
                                         "placement_frame><pose>1 0 0 0 0 0</pose></include>"));
    const Loaded loaded = folder.load("world.sdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.world->instances[0].X_WM.p, (Vec3{1, 0, 3}));
}

}  // namespace
}  // namespace roboss
