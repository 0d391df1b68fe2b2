// Our reader of SDFormat beside libsdformat, on every world of the repository and on small files for frames,
// nesting, merging and versions.
#include "corpus/sdf_oracle.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace roboss::corpus {
namespace {

namespace fs = std::filesystem;

std::string text_of(const Verdict& verdict) {
    std::string text = verdict.refusal;
    for (const std::string& difference : verdict.differences) text += "\n" + difference;
    return text;
}

TEST(SdfOracle, WorldsOfTheRepositoryReadAsLibsdformatReadsThem) {
    std::size_t compared = 0;
    for (const char* folder : {"worlds", "examples", "tests/cases", "web/e2e", "src/app/templates"}) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(ROBOSS_SOURCE) / folder)) {
            const fs::path file = entry.path();
            if (file.extension() != ".sdf" && file.extension() != ".world") continue;
            if (fs::file_size(file) > 100'000) continue;           // libsdformat takes minutes
            if (file.filename() == "decimal_comma.sdf") continue;  // libsdformat reads 0,5 as 0
            const Verdict verdict = ask_libsdformat(file.string(), {ROBOSS_SOURCE "/worlds/models"});
            if (!verdict.refusal.empty()) continue;
            EXPECT_TRUE(verdict.differences.empty()) << file << text_of(verdict);
            compared += verdict.models;
        }
    }
    EXPECT_GT(compared, 50u);
}

struct Case {
    const char* name;
    const char* version;
    std::string text;  // in <world>
};
void PrintTo(const Case& each, std::ostream* out) {
    *out << each.name;
}

std::string link(const std::string& name, const std::string& inner = "") {
    return "<link name='" + name +
           "'><inertial><pose>.1 .2 .3 .4 .5 .6</pose><mass>2</mass><inertia><ixx>1</ixx>"
           "<iyy>1.2</iyy><izz>1.3</izz><ixy>.1</ixy><ixz>.2</ixz><iyz>.3</iyz></inertia></inertial>" +
           inner + "</link>";
}

std::string posed(const std::string& name, const std::string& pose) {
    return link(name, "<pose" + pose + "</pose>");
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& inner = "<axis><xyz>0 .6 .8</xyz></axis>") {
    return "<joint name='" + name + "' type='revolute'><parent>" + parent + "</parent><child>" + child +
           "</child>" + inner + "</joint>";
}

const std::string kPart = "<model name='part'><pose>7 8 9 .1 .2 .3</pose>" + posed("p", ">1 2 3 .4 .5 .6") +
                          posed("q", " relative_to='j'>0 0 1 1 0 0") +
                          "<frame name='f' attached_to='q'><pose "
                          "relative_to='p'>3 2 1 .3 .2 .1</pose></frame>" +
                          joint("j", "p", "f",
                                "<pose relative_to='__model__'>1 1 1 .5 0 0</pose><axis>"
                                "<xyz expressed_in='__model__'>1 0 0</xyz></axis>") +
                          "</model>";

// An outer model that uses the part's frames, whether it is nested, included or merged.
std::string outer(const std::string& part, const std::string& prefix) {
    return "<model name='outer' canonical_link='a'><pose>1 2 3 .3 .4 .5</pose>" +
           posed("a", ">.1 .2 .3 .1 .1 .1") + part +
           posed("b", " relative_to='" + prefix + "q'>1 0 0 0 .7 0") + "<frame name='g' attached_to='" +
           prefix + "f'><pose>0 1 0 0 0 1</pose></frame>" + joint("k", "a", prefix + "f") +
           joint("l", "b", "g", "<axis><xyz expressed_in='" + prefix + "p'>0 0 1</xyz></axis>") + "</model>";
}

const Case kCases[] = {
    {"Nested", "1.9", outer(kPart, "part::")},
    {"Placed", "1.9",
     outer("<model name='part' placement_frame='f'><pose relative_to='a'>1 2 3 .3 .2 .1</pose>" + link("p") +
               "<frame name='f'><pose>3 2 1 .5 .6 .7</pose></frame><frame name='q'/></model>",
           "part::")},
    {"Included", "1.9",
     outer("<include><uri>part</uri><name>other</name><pose>3 0 0 0 1 0</pose></include>", "other::")},
    {"IncludedByAFrame", "1.9",
     outer("<include><uri>part</uri><placement_frame>f</placement_frame><pose relative_to='a'>3 0 0 0 1 "
           "0</pose>"
           "</include>",
           "part::")},
    {"Merged", "1.9", outer("<include merge='true'><uri>part</uri><pose>3 0 0 0 1 0</pose></include>", "")},
    // A merged model with a placement frame is not here: libsdformat 12.3 puts the frame elsewhere than at
    // the pose.
    {"MergedTwice", "1.9",
     outer("<include merge='true'><uri>whole</uri><pose>3 0 0 0 1 0</pose></include>", "")},
    {"Turned", "1.9",
     "<model name='m'>" + posed("a", ">0 0 0 0 1.5707963267948966 0") +
         posed("b", " relative_to='a'>0 0 1 3 1.57 2") +
         joint("j", "a", "b", "<pose>0 0 0 .1 1.5707963267948966 .2</pose><axis><xyz>.1 .2 .3</xyz></axis>") +
         "</model>"},
    {"Degrees", "1.9",
     "<model name='m'>" + posed("a", " degrees='true'>0 0 1 90 45 30") +
         posed("b", " rotation_format='quat_xyzw'>0 0 1 .5 .5 .5 .5") + joint("j", "world", "a") +
         "</model>"},
    {"AxisOf14", "1.4",
     "<model name='m'>" + posed("a", ">0 0 1 0 0 1") + posed("b", ">0 0 2 1 .2 .3") + joint("j", "a", "b") +
         "</model>"},
    {"AxisOf15", "1.5",
     "<model name='m'>" + posed("a", ">0 0 1 0 0 1") + posed("b", ">0 0 2 1 .2 .3") + joint("j", "a", "b") +
         "</model>"},
    {"AxisOf16", "1.6",
     "<model name='m'>" + posed("a", ">0 0 1 0 0 1") + posed("b", " frame='a'>0 0 2 1 .2 .3") +
         joint("j", "a", "b",
               "<axis><xyz>1 0 0</xyz><use_parent_model_frame>true</use_parent_model_frame></axis>") +
         "</model>"},
    {"NamesOf16", "1.6",
     "<model name='m'>" + link("x") + posed("a::b", ">0 0 2 1 .2 .3") + joint("x", "x", "a::b") + "</model>"},
    {"WorldFrames", "1.9",
     "<frame name='w'><pose>1 2 3 .1 .2 .3</pose></frame><model name='m'><pose relative_to='w'>1 0 0 0 0 "
     "1</pose>" +
         link("a") +
         "</model><model name='n' placement_frame='b'><pose relative_to='m::a'>0 1 0 .3 0 0</pose>" +
         posed("b", ">1 2 3 .3 .2 .1") + "</model>"},
    {"SensorsAndCollisions", "1.9",
     "<model name='m'><frame name='f'><pose>1 2 3 .1 .2 .3</pose></frame>" +
         link("a",
              "<pose>0 0 1 1 0 0</pose><sensor name='s' type='imu'><pose relative_to='f'>1 0 0 0 0 "
              "1</pose></sensor>"
              "<collision name='c'><pose relative_to='f'>0 1 0 1 0 "
              "0</pose><geometry><sphere><radius>1</radius>"
              "</sphere></geometry></collision>") +
         "</model>"},
};

class SdfOracleCase : public testing::TestWithParam<Case> {};

TEST_P(SdfOracleCase, ReadsAsLibsdformatReadsIt) {
    const Case& each = GetParam();
    std::string folder = (fs::temp_directory_path() / "roboss-oracle-XXXXXX").string();
    ASSERT_NE(mkdtemp(folder.data()), nullptr);
    const auto write = [&](const std::string& file, const std::string& version, const std::string& text) {
        fs::create_directories(fs::path(folder) / fs::path(file).parent_path());
        std::ofstream(folder + "/" + file) << "<sdf version='" << version << "'>" << text << "</sdf>";
    };
    const std::string config = "<model><name>m</name><sdf version='1.9'>model.sdf</sdf></model>";
    for (const char* model : {"part", "whole"}) {
        write(std::string(model) + "/model.sdf", "1.9",
              model == std::string("part") ? kPart
                                           : "<model name='whole'>" + posed("w", ">1 0 0 0 0 1") +
                                                 "<include merge='true'><uri>model://part</uri><pose "
                                                 "relative_to='w'>0 1 0 1 0 0</pose></include></model>");
        std::ofstream(folder + "/" + model + "/model.config") << config;
    }
    write("world.sdf", each.version, "<world name='w'>" + each.text + "</world>");
    setenv("SDF_PATH", folder.c_str(), 1);  // all that libsdformat has where an included file includes
    const Verdict verdict = ask_libsdformat(folder + "/world.sdf", {});
    unsetenv("SDF_PATH");
    fs::remove_all(folder);
    EXPECT_TRUE(verdict.refusal.empty() && verdict.differences.empty()) << text_of(verdict);
    EXPECT_GE(verdict.links, 1u);
}

INSTANTIATE_TEST_SUITE_P(Files, SdfOracleCase, testing::ValuesIn(kCases),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace roboss::corpus
