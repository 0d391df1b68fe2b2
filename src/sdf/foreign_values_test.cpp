// Files of others: values that Gazebo takes and that are not quite right.
#include <gtest/gtest.h>

#include <limits>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

TEST(ForeignValues, ADecimalCommaIsAPointWithAWarning) {
    const Loaded loaded = load_elements(
        "<model name='m'><link name='l'><pose>0,5 0 1 0 0 0</pose><inertial><mass>1</mass><inertia>"
        "<ixx>0,01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>"
        "<collision name='c'><pose>0 0 1,5 0 0 0</pose><geometry><sphere><radius>0,25</radius></sphere>"
        "</geometry></collision></link></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("decimal-comma"), nullptr);
    const LinkSpec& link = loaded.world->prototypes.at(0).links.at(0);
    EXPECT_EQ(link.X_ML.p.x, 0.5);
    EXPECT_EQ(link.inertia_C(0, 0), 0.01);
    EXPECT_EQ(link.collisions.at(0).X_LS.p.z, 1.5);
    EXPECT_EQ(link.collisions[0].geometry.radius, 0.25);
    for (const std::string bad : {"1,000.5", "1,2,3", ",5", "x,5"})
        EXPECT_TRUE(load_elements("<model name='m'><link name='l'><inertial><mass>" + bad +
                                  "</mass></inertial></link></model>")
                        .diagnostics.has_errors())
            << bad;
}

TEST(ForeignValues, CollisionsOfOneNameAllCountWithAWarning) {
    const auto box = [](const std::string& name, const std::string& pose) {
        return "<collision name='" + name + "'>" + pose +
               "<geometry><box><size>1 1 1</size></box></geometry></collision>";
    };
    const Loaded loaded =
        load_elements("<model name='m'>" + link("a") +
                      link("l", box("c", "<pose>1 0 0 0 0 0</pose>") + box("c_1", "") +
                                    box("c", "<pose relative_to='a'>2 0 0 0 0 0</pose>")) +
                      "<joint name='j' type='fixed'><parent>a</parent><child>l</child></joint></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("repeated-name"), nullptr);
    const auto& collisions = loaded.world->prototypes.at(0).links.at(1).collisions;
    ASSERT_EQ(collisions.size(), 3u);
    EXPECT_EQ(collisions[0].X_LS.p.x, 1);
    EXPECT_EQ(collisions[2].X_LS.p.x, 2) << "each has its own pose";
}

TEST(ForeignValues, AnAxisWithoutDirectionMattersOnlyWhereTheJointMoves) {
    const auto model = [](const std::string& type, const std::string& limit) {
        return load_elements("<model name='m'>" + link("a") + link("b") + "<joint name='j' type='" + type +
                             "'><parent>a</parent><child>b</child><axis><xyz>0 0 0</xyz>" + limit +
                             "</axis></joint></model>");
    };
    const std::string locked = "<limit><lower>0</lower><upper>0</upper></limit>";
    for (const Loaded& loaded : {model("fixed", ""), model("revolute", locked)}) {
        ASSERT_TRUE(loaded.world) << loaded.text();
        EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
        ASSERT_NE(loaded.find("zero-axis"), nullptr) << loaded.text();
        EXPECT_EQ(loaded.find("zero-axis")->severity, Severity::kWarning);
    }
    for (const Loaded& loaded : {model("revolute", ""), model("continuous", locked)}) {
        ASSERT_NE(loaded.find("zero-axis"), nullptr) << loaded.text();
        EXPECT_EQ(loaded.find("zero-axis")->severity, Severity::kError);
        EXPECT_NE(loaded.find("zero-axis")->message.find("'j'"), std::string::npos);
    }
}

TEST(ForeignValues, PackagesExportFoldersForModelsAndMedia) {
    const TestFolder folder;
    const auto package = [&](const std::string& name, const std::string& paths) {
        folder.write(name + "/package.xml", "<package><name>" + name + "</name><export><gazebo_ros " + paths +
                                                "/></export></package>");
    };
    package("own", "gazebo_media_path='${prefix}/share'");
    package("other", "gazebo_model_path='${prefix}/none:${prefix}/things'");
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    folder.write("own/share/media/part.obj", obj);
    folder.write("other/things/cup/model.sdf",
                 "<sdf version='1.6'><model name='cup'>" + link("a") + "</model></sdf>");
    const auto mesh = [](const std::string& uri) {
        return "<model name='m'>" +
               link("l", "<collision name='c'><geometry><mesh><uri>" + uri +
                             "</uri></mesh></geometry></collision>") +
               "</model>";
    };
    folder.write("own/worlds/w.sdf", "<sdf version='1.6'><world name='w'>" + mesh("file://media/part.obj") +
                                         "<include><uri>model://cup</uri></include></world></sdf>");
    const Loaded loaded = folder.load("own/worlds/w.sdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_EQ(loaded.world->instances.size(), 2u);
    folder.write("own/worlds/bad.sdf",
                 "<sdf version='1.6'><world name='w'>" + mesh("file://media/gone.obj") + "</world></sdf>");
    EXPECT_NE(folder.load("own/worlds/bad.sdf").find("file-not-found"), nullptr);
}

TEST(ForeignValues, NegativeFrictionHasNoBoundAsInGazeboClassic) {
    const Loaded loaded = load_elements(
        "<model name='m'>" +
        link("l",
             "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry><surface><friction>"
             "<ode><mu>-1.000000</mu><mu2>-1.000000</mu2></ode></friction></surface></collision>") +
        "</model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    const SurfaceSpec& surface = loaded.world->prototypes.at(0).links.at(0).collisions.at(0).surface;
    EXPECT_EQ(surface.mu, std::numeric_limits<double>::infinity());
    EXPECT_EQ(surface.mu2, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace roboss
