// Bad input gets clear words with file and line, and never brings the loader down.
#include <gtest/gtest.h>

#include <random>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

const std::string kBox = "<geometry><box><size>1 1 1</size></box></geometry>";

/// Loads a model of these lines (the first on line 2) and expects an error with the code on the line.
void expect_error(const std::string& model, const std::string& code, int line, const std::string& words) {
    const Loaded loaded = load_elements("\n" + model);
    const Diagnostic* found = loaded.find(code);
    ASSERT_NE(found, nullptr) << code << " expected; found:\n" << loaded.text();
    EXPECT_EQ(found->severity, Severity::kError);
    EXPECT_EQ(found->where.line, line) << to_text(*found);
    EXPECT_NE(found->where.file.find("world.sdf"), std::string::npos);
    EXPECT_NE(found->message.find(words), std::string::npos) << to_text(*found);
    EXPECT_FALSE(found->remedy.empty());
}

TEST(BadInput, AMissingFileIsAnError) {
    Loaded loaded;
    loaded.world = load_world("/no/such/file.sdf", {}, loaded.diagnostics);
    EXPECT_TRUE(loaded.diagnostics.has_errors());
    ASSERT_NE(loaded.find("cannot-read"), nullptr);
    EXPECT_EQ(loaded.find("cannot-read")->where.file, "/no/such/file.sdf");
}

TEST(BadInput, MalformedXmlNamesLineAndColumn) {
    const Loaded loaded =
        load_text("<sdf version='1.9'>\n<world name='w'>\n  <model name='m'></world></sdf>");
    EXPECT_TRUE(loaded.diagnostics.has_errors());
    ASSERT_NE(loaded.find("malformed-xml"), nullptr) << loaded.text();
    EXPECT_EQ(loaded.find("malformed-xml")->where.line, 3);
    EXPECT_NE(loaded.find("malformed-xml")->message.find("column"), std::string::npos);
}

TEST(BadInput, OtherXmlIsNotTakenForAWorld) {
    EXPECT_NE(load_text("<html><body/></html>").find("not-sdf"), nullptr);
    EXPECT_NE(load_text("<sdf version='1.9'></sdf>").find("no-world"), nullptr);
    for (const char* text : {"", "\n ", "hello", "#usda 1.0\n", "PK\3\4"}) {
        const Loaded loaded = load_text(text);
        EXPECT_FALSE(loaded.world);
        EXPECT_TRUE(loaded.find("not-xml")) << loaded.text();
    }
    EXPECT_TRUE(load_text("\xEF\xBB\xBF<sdf version='1.9'><world name='w'/></sdf>").world);
    EXPECT_FALSE(load_text("\xEF\xBB\xBFhello").world);
}

TEST(BadInput, AJointToNowhereIsAnError) {
    expect_error(
        "<model name='m'>" + link("a") +
            "\n<joint name='j' type='fixed'><parent>a</parent><child>nowhere</child></joint></model>",
        "joint-to-nowhere", 3, "'nowhere'");
}

TEST(BadInput, AJointToNowhereIsReportedOnce) {
    const Loaded loaded =
        load_elements("<model name='m'>" + link("a") + link("b") +
                      "<joint name='j' type='fixed'><parent>gone</parent><child>b</child></joint></model>");
    EXPECT_EQ(loaded.diagnostics.count(Severity::kError), 1u) << loaded.text();
}

TEST(BadInput, NegativeMassIsAnError) {
    expect_error(
        "<model name='m'>\n\n<link "
        "name='a'><inertial><mass>-1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></"
        "inertial></link></model>",
        "bad-mass", 4, "mass of -1");
}

TEST(BadInput, NotANumberIsAnError) {
    expect_error("<model name='m'><link name='a'><inertial>\n<mass>nan</mass></inertial></link></model>",
                 "bad-value", 3, "nan");
    expect_error(
        "<model name='m'>" +
            link("a",
                 "<collision name='c'><geometry><box>\n<size>1 two 3</size></box></geometry></collision>") +
            "</model>",
        "bad-value", 3, "1 two 3");
    expect_error("<model name='m'>\n<pose>1 2 3 0 0</pose>" + link("a") + "</model>", "bad-value", 3,
                 "6 finite numbers");
    expect_error(
        "<model name='m'>" + link("a") + link("b") +
            "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>\n"
            "<limit><upper>1e999</upper></limit></axis></joint></model>",
        "bad-value", 3, "1e999");
}

TEST(BadInput, ALinkPoseThatIsNoPoseIsAnError) {
    const Loaded loaded = load_elements("\n<model name='m'><link name='a'>\n<pose>1 2 x 0 0 0</pose>" +
                                        kInertial + "</link></model>");
    EXPECT_TRUE(loaded.diagnostics.has_errors());
    EXPECT_NE(loaded.text().find("world.sdf:3: error"), std::string::npos) << loaded.text();
}

TEST(BadInput, AnInertiaOfNoBodyIsAWarningWithItsNumbers) {
    const Loaded loaded = load_elements(
        "<model name='m'><link "
        "name='a'><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>5</izz></inertia></"
        "inertial></link></model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_NE(loaded.find("unreal-inertia"), nullptr) << loaded.text();
    EXPECT_NE(loaded.find("unreal-inertia")->message.find("izz 5"), std::string::npos);
}

TEST(BadInput, AMissingInertiaIsAWarningThatSaysTheDefault) {
    const Loaded loaded = load_elements("<model name='m'><link name='a'/></model>");
    ASSERT_NE(loaded.find("missing-inertia"), nullptr);
    EXPECT_EQ(loaded.find("missing-inertia")->severity, Severity::kWarning);
    EXPECT_NE(loaded.find("missing-inertia")->message.find("1 kg"), std::string::npos);
    EXPECT_EQ(loaded.world->prototypes[0].links[0].mass, 1.0);
}

TEST(BadInput, AMissingMeshThatShouldCollideIsAnErrorWithThePathsSearched) {
    const TestFolder folder;
    folder.write(
        "world.sdf",
        "<sdf version='1.9'><world name='w'><model name='m'>" +
            link("a",
                 "<collision "
                 "name='c'><geometry><mesh><uri>model://car/body.stl</uri></mesh></geometry></collision>") +
            "</model></world></sdf>");
    const Loaded loaded = folder.load("world.sdf", {{"/some/where"}});
    ASSERT_NE(loaded.find("file-not-found"), nullptr) << loaded.text();
    EXPECT_EQ(loaded.find("file-not-found")->severity, Severity::kError);
    EXPECT_NE(loaded.find("file-not-found")->message.find("/some/where/car/body.stl"), std::string::npos);
    EXPECT_TRUE(loaded.diagnostics.has_errors());
}

TEST(BadInput, TwoModelsOfOneNameAreAnError) {
    expect_error("<model name='m'>" + link("a") + "</model>\n<model name='m'>" + link("a") + "</model>",
                 "duplicate-name", 3, "'m'");
}

TEST(BadInput, UnknownElementsAreReportedWithTheirLine) {
    const Loaded loaded = load_elements("<model name='m'>\n" +
                                        link("a", "<collision name='c'>" + kBox + "\n<surfce/></collision>") +
                                        "</model>\n<modle/>");
    std::string text = loaded.text();
    EXPECT_NE(text.find("world.sdf:3: warning: <surfce> in <collision>"), std::string::npos) << text;
    EXPECT_NE(text.find("world.sdf:4: warning: <modle> in <world>"), std::string::npos) << text;
    EXPECT_FALSE(loaded.diagnostics.has_errors());
}

TEST(BadInput, UnknownElementsOfBlocksOfTheWorldAreReported) {
    for (const char* block : {"physics", "wind", "atmosphere", "spherical_coordinates"}) {
        const std::string tag = block;
        const Loaded loaded = load_elements("<" + tag + ">\n<slip>1</slip></" + tag + ">");
        EXPECT_NE(loaded.text().find("world.sdf:2: warning: <slip> in <" + tag + "> is not known"),
                  std::string::npos)
            << loaded.text();
        const Loaded foreign = load_elements("<" + tag + ">\n<other:word/></" + tag + ">");
        EXPECT_NE(foreign.text().find("world.sdf:2: note: <other:word> in <" + tag + ">"), std::string::npos)
            << foreign.text();
    }
}

TEST(BadInput, MisspeltElementsOfOurOwnInAWorldAreNotTakenForForeign) {
    const Loaded loaded = load_elements("<roboss:slep>false</roboss:slep>\n<other:word/>");
    EXPECT_NE(loaded.text().find("world.sdf:1: warning: <roboss:slep> in <world> is not known"),
              std::string::npos)
        << loaded.text();
    EXPECT_NE(loaded.text().find("world.sdf:2: note: <other:word> in <world>"), std::string::npos)
        << loaded.text();
}

TEST(BadInput, UnknownElementsOfOurOwnBlocksAreReported) {
    const auto load = [](const std::string& in_link, const std::string& in_joint) {
        return load_elements("<model name='m'>" + link("a", in_link) + link("b") +
                             "<joint name='j' type='universal'><parent>a</parent><child>b</child>" +
                             in_joint +
                             "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint></model>");
    };
    const Loaded drag = load("<roboss:drag>\n<linaer>1</linaer></roboss:drag>", "");
    EXPECT_NE(drag.text().find("world.sdf:2: warning: <linaer> in <roboss:drag>"), std::string::npos)
        << drag.text();
    const Loaded motor = load("", "<roboss:motor>\n<gain>1</gain></roboss:motor>");
    EXPECT_NE(motor.text().find("world.sdf:2: warning: <gain> in <roboss:motor>"), std::string::npos)
        << motor.text();
    EXPECT_EQ(motor.diagnostics.items().size(), 1u) << motor.text();
}

TEST(BadInput, BlocksAsOthersWriteThemGiveNoWarning) {
    const Loaded loaded = load_elements(
        "<physics name='p' default='1' type='ode'><max_step_size>0.001</max_step_size><real_time_factor>1"
        "</real_time_factor><real_time_update_rate>1000</real_time_update_rate><max_contacts>20</"
        "max_contacts>"
        "<ode><solver><type>quick</type><iters>50</iters></solver><constraints><erp>.2</erp></constraints></"
        "ode>"
        "<bullet><solver><type>sequential_impulse</type></solver></bullet><simbody><contact><stiffness>1"
        "</stiffness></contact></simbody><dart><solver><solver_type>pgs</solver_type></solver></dart></"
        "physics>"
        "<wind><linear_velocity>0 0 0</linear_velocity></wind><atmosphere type='adiabatic'><temperature>288"
        "</temperature><pressure>101325</pressure></"
        "atmosphere><spherical_coordinates><surface_model>EARTH_WGS84"
        "</surface_model><world_frame_orientation>ENU</world_frame_orientation><latitude_deg>1</latitude_deg>"
        "<longitude_deg>2</longitude_deg><elevation>3</elevation><heading_deg>0</heading_deg>"
        "</spherical_coordinates>");
    EXPECT_EQ(loaded.diagnostics.count(Severity::kWarning), 0u) << loaded.text();
    EXPECT_EQ(loaded.diagnostics.count(Severity::kNote), 4u) << "one for each engine\n" << loaded.text();
}

TEST(BadInput, AxesOfACustomSurfaceHaveNoEffect) {
    const Loaded loaded = load_elements(
        "<spherical_coordinates>\n<surface_axis_polar>1</surface_axis_polar></spherical_coordinates>",
        "1.10");
    EXPECT_NE(loaded.text().find("world.sdf:2: note: <surface_axis_polar> has no effect"), std::string::npos)
        << loaded.text();
}

TEST(BadInput, EqualFindingsAreOneWithTheirNumber) {
    std::string models;
    for (int i = 0; i < 7; ++i) {
        models += "\n<model name='m" + std::to_string(i) + "'><pose>" + std::to_string(i) +
                  " 0 0 0 0 0</pose>" + link("l" + std::to_string(i)) +
                  "<plugin name='drive' filename='x'/></model>";
    }
    const Loaded loaded = load_elements(models);
    EXPECT_EQ(loaded.diagnostics.items().size(), 1u) << loaded.text();
    EXPECT_NE(loaded.text().find("world.sdf:2: note: plugin 'drive' is not run (7 times"), std::string::npos)
        << loaded.text();
}

TEST(BadInput, AllErrorsComeAtOnce) {
    const Loaded loaded = load_elements(
        "<model name='a'><link "
        "name='l'><inertial><mass>-1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></"
        "inertial></link></model>"
        "<model name='b'>" +
        link("l",
             "<collision name='c'><geometry><sphere><radius>-2</radius></sphere></geometry></collision>") +
        "</model>"
        "<model name='c'><pose relative_to='nobody'/>" +
        link("l") + "</model>");
    EXPECT_NE(loaded.find("bad-mass"), nullptr);
    EXPECT_NE(loaded.find("bad-size"), nullptr);
    EXPECT_NE(loaded.find("unknown-frame"), nullptr);
}

const std::string kValid =
    "<?xml version='1.0'?>\n<sdf version='1.6' xmlns:roboss='urn:roboss:1'>\n<world name='w'>\n<physics "
    "name='p' type='ode'><max_step_size>0.002</max_step_size></physics>\n"
    "<model name='car'><pose>1 2 3 0 0 0</pose>\n<link "
    "name='a'><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>"
    "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision>\n"
    "<sensor name='s' "
    "type='ray'><ray><scan><horizontal><samples>3</samples><min_angle>0</min_angle><max_angle>1</max_angle></"
    "horizontal></scan>"
    "<range><min>0.1</min><max>9</max></range></ray></sensor></link>\n"
    "<link "
    "name='b'><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></"
    "link>\n"
    "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 "
    "1</xyz></axis></joint></model>\n"
    "<population name='p'><model name='x'><link name='l'/></model><pose>0 0 0 0 0 0</pose><box><size>1 1 "
    "1</size></box>"
    "<model_count>3</model_count><distribution><type>random</type></distribution></population>\n</world></"
    "sdf>\n";

TEST(BadInput, ATruncatedWorldIsAlwaysAnError) {
    ASSERT_FALSE(load_text(kValid).diagnostics.has_errors()) << load_text(kValid).text();
    for (std::size_t length = 0; length + 8 < kValid.size(); length += 7) {
        const Loaded loaded = load_text(kValid.substr(0, length));
        EXPECT_TRUE(loaded.diagnostics.has_errors()) << "cut at " << length;
    }
}

TEST(BadInput, AGarbledWorldNeverBringsTheLoaderDown) {
    std::mt19937 random(7);  // seed: print it with the failing round
    const std::string bytes = "<>/'\"= &;x09-.\n\0\xff";
    for (int round = 0; round < 300; ++round) {
        std::string text = kValid;
        const int changes = 1 + static_cast<int>(random() % 4);
        for (int i = 0; i < changes; ++i) {
            const std::size_t at = random() % text.size();
            switch (random() % 3) {
                case 0:
                    text[at] = bytes[random() % bytes.size()];
                    break;
                case 1:
                    text.erase(at, random() % 20);
                    break;
                default:
                    text.insert(at, text.substr(random() % text.size(), random() % 60));
                    break;
            }
        }
        const Loaded loaded = load_text(text);
        EXPECT_TRUE(loaded.world || loaded.diagnostics.has_errors()) << "seed 7, round " << round;
    }
}

TEST(BadInput, DeepNestingIsAnErrorNotACrash) {
    std::string text = "<sdf version='1.9'><world name='w'>";
    for (int i = 0; i < 20000; ++i) text += "<model name='m'>";
    for (int i = 0; i < 20000; ++i) text += "</model>";
    EXPECT_TRUE(load_text(text + "</world></sdf>").diagnostics.has_errors());
}

TEST(BadInput, NothingIsPrinted) {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    load_elements("<model name='m'><badly/><link name='a'><pose>x</pose></link></model>");
    load_text("<robot name='r'><link name='a'><inertial/></link></robot>", "r.urdf");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace roboss
