// Wrong names and frames of models are reported with their line. tests/corpus compares right ones with
// libsdformat.
#include "sdf/model_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

struct WrongModel {
    const char* name;
    std::string inner;  // of the model; its second line is what is wrong
    const char* code;
    const char* version = "1.9";
};
void PrintTo(const WrongModel& model, std::ostream* out) {
    *out << model.name;
}

const std::string kTwo = link("a") + link("b");

std::string revolute(const std::string& inner, const std::string& attributes = "name='j' type='revolute'") {
    return "<joint " + attributes + "><parent>a</parent><child>b</child>" + inner + "</joint>";
}

const WrongModel kWrong[] = {
    {"LinkRelativeToNothing", kTwo + "\n<link name='c'><pose relative_to='x'/></link>", "unknown-frame"},
    {"FrameAttachedToNothing", kTwo + "\n<frame name='f' attached_to='x'><pose relative_to='a'/></frame>",
     "unknown-frame"},
    {"AxisInNothing", kTwo + revolute("<axis>\n<xyz expressed_in='x'>0 0 1</xyz></axis>"), "unknown-frame"},
    {"CircleOfFrames", kTwo + "\n<frame name='f' attached_to='g'/><frame name='g' attached_to='f'/>",
     "frame-cycle"},
    {"SameNames", kTwo + "\n<frame name='a'/>", "duplicate-name"},
    {"SameNamesNow", kTwo + "\n" + revolute("<axis/>", "name='a' type='revolute'"), "duplicate-name"},
    {"ReservedName", kTwo + "\n<frame name='__f__'/>", "reserved-name"},
    {"TwoColons", kTwo + "\n<frame name='f::g'/>", "reserved-name"},
    {"NoName", kTwo + "\n<frame/>", "no-name"},
    {"NoChild", kTwo + "\n<joint name='j' type='fixed'><parent>a</parent></joint>", "missing-element"},
    {"NoSuchType", kTwo + "\n" + revolute("", "name='j' type='hinge'"), "joint-type"},
    {"NestedWithoutLinks", kTwo + "\n<model name='n'><frame name='f'/></model>", "no-links"},
    {"PlacedByNothing", kTwo + "\n<model name='n' placement_frame='x'>" + link("c") + "</model>",
     "unknown-frame"},
};

class WrongModels : public testing::TestWithParam<WrongModel> {};

TEST_P(WrongModels, AreToldWithTheirLine) {
    const WrongModel& each = GetParam();
    const Loaded loaded = load_elements("<model name='m'>" + each.inner + "</model>", each.version);
    const Diagnostic* const found = loaded.find(each.code);
    ASSERT_NE(found, nullptr) << loaded.text();
    EXPECT_EQ(found->severity, Severity::kError);
    EXPECT_EQ(found->where.line, 2) << loaded.text();
    EXPECT_FALSE(found->remedy.empty());
}

INSTANTIATE_TEST_SUITE_P(Models, WrongModels, testing::ValuesIn(kWrong),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(ModelTree, FramesMayStandInALongChain) {
    constexpr int kFrames = 100'000;
    std::string chain;
    for (int i = 0; i < kFrames; ++i)
        chain += "<frame name='f" + std::to_string(i) + "' attached_to='f" + std::to_string(i + 1) + "'/>";
    chain += "<frame name='f" + std::to_string(kFrames) + "' attached_to='b'/>";
    const Loaded loaded =
        load_elements("<model name='m'>" + kTwo + chain +
                      "<joint name='j' type='fixed'><parent>a</parent><child>f0</child></joint></model>");
    ASSERT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_EQ(loaded.world->prototypes[0].joints.at(0).child, "b");
}

TEST(ModelTree, NamesThatClashInAnOldFileGetAnEnding) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + kTwo + revolute("<axis/>", "name='a' type='revolute'") + "</model>", "1.6");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("renamed"), nullptr);
    EXPECT_EQ(loaded.world->prototypes[0].joints.at(0).name, "a_joint");
}

TEST(ModelTree, APoseOfAPartInAnUnknownFrameIsThatInItsLink) {
    const Loaded loaded =
        load_elements("<model name='m'>" +
                      link("a",
                           "<collision name='c'>\n<pose relative_to='x'>1 2 3 0 0 0</pose><geometry>"
                           "<sphere><radius>1</radius></sphere></geometry></collision>") +
                      "</model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_NE(loaded.find("unknown-frame"), nullptr);
    EXPECT_EQ(loaded.find("unknown-frame")->where.line, 2);
    EXPECT_EQ(loaded.world->prototypes[0].links[0].collisions.at(0).X_LS.p, (Vec3{1, 2, 3}));
}

TEST(ModelTree, TheFrameOfAPoseHasItsOldNameInOldFilesOnly) {
    const std::string model = "<model name='m'>" + link("a", "<pose>1 0 0 0 0 0</pose>") +
                              link("b", "\n<pose frame='a'>1 0 0 0 0 0</pose>") + "</model>";
    const Loaded old = load_elements(model, "1.6"), now = load_elements(model, "1.7");
    EXPECT_EQ(old.world->prototypes[0].links[1].X_ML.p.x, 2) << old.text();
    EXPECT_EQ(now.world->prototypes[0].links[1].X_ML.p.x, 1);
    EXPECT_EQ(old.find("unknown-element"), nullptr) << old.text();
    ASSERT_NE(now.find("unknown-element"), nullptr);
    EXPECT_EQ(now.find("unknown-element")->where.line, 2);
}

TEST(ModelTree, AStaticModelMayHaveFramesAndNoLinks) {
    const Loaded loaded =
        load_elements("<model name='m'><static>1</static><frame name='f'/></model><model name='n'>" +
                      link("a") + "</model>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_NE(loaded.find("no-links"), nullptr);
}

TEST(ModelTree, TheFrameThatPlacesAMergedModelStandsAtThePose) {
    const TestFolder folder;
    folder.write("part.sdf", "<sdf version='1.9'><model name='part'>" +
                                 link("p", "<pose>1 2 3 .4 .5 .6</pose>") +
                                 link("q", "<pose>0 0 1 1 0 0</pose>") + "</model></sdf>");
    folder.write("world.sdf",
                 "<sdf version='1.9'><world name='w'><model name='m'>" + link("a") +
                     "<include merge='true'><uri>part.sdf</uri><placement_frame>q</placement_frame>"
                     "<pose relative_to='a'>3 0 0 0 1 0</pose></include></model></world></sdf>");
    const Loaded loaded = folder.load("world.sdf");
    ASSERT_TRUE(loaded.world && loaded.world->prototypes.size() == 1) << loaded.text();
    const Pose& X_MQ = loaded.world->prototypes[0].links.at(2).X_ML;
    EXPECT_NEAR(norm(X_MQ.p - Vec3{3, 0, 0}), 0, 1e-12);
    EXPECT_NEAR(std::fabs(X_MQ.q.y), std::sin(0.5), 1e-12);
}

}  // namespace
}  // namespace roboss
