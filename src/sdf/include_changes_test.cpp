// <include> that changes its model: plugins of its own, <experimental:params>.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

const std::string kBall =
    "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>";

class IncludeChanges : public testing::Test {
  protected:
    IncludeChanges() {
        file("part", link("p", kBall) + link("q", kBall));
        file("whole", link("w") + "<include><uri>model://part</uri></include>");
    }
    void file(const std::string& name, const std::string& inner) {
        folder_.write(name + "/model.sdf",
                      "<sdf version='1.9'>\n<model name='" + name + "'>\n" + inner + "</model></sdf>");
        folder_.write(name + "/model.config", "<model><sdf version='1.9'>model.sdf</sdf></model>");
    }
    /// What `change` in <experimental:params>, on line 3 of the world, makes of a model.
    Loaded changed(const std::string& change, const std::string& uri = "part") {
        return world("<include><uri>" + uri + "</uri>\n<experimental:params>\n" + change +
                     "</experimental:params></include>");
    }
    Loaded world(const std::string& elements) {
        folder_.write("world.sdf", "<sdf version='1.9'><world name='w'>" + elements + "</world></sdf>");
        return folder_.load("world.sdf", {{folder_.path(".")}});
    }
    static std::vector<std::string> links_of(const Loaded& loaded) {
        std::vector<std::string> names;
        for (const LinkSpec& each : loaded.world->prototypes.at(0).links) names.push_back(each.name);
        return names;
    }
    using Names = std::vector<std::string>;

    TestFolder folder_;
};

TEST_F(IncludeChanges, AddsRemovesAndReplacesElements) {
    EXPECT_EQ(links_of(changed("<link element_id='' action='add' name='r'/>")), (Names{"p", "q", "r"}));
    EXPECT_EQ(links_of(changed("<link element_id='p' action='remove'/>")), (Names{"q"}));
    EXPECT_EQ(links_of(changed("<link element_id='p' action='replace' name='s'/>")), (Names{"s", "q"}));
    const Loaded less = changed("<link element_id='p'><collision name='c' action='remove'/></link>");
    EXPECT_TRUE(less.world->prototypes[0].links[0].collisions.empty()) << less.text();
    EXPECT_EQ(less.world->prototypes[0].links[1].collisions.size(), 1u);
}

TEST_F(IncludeChanges, ModifiesValuesAndKeepsThePlacesOfBothFiles) {
    const Loaded loaded = changed(
        "<collision element_id='p::c' "
        "action='modify'><geometry><sphere><radius>2</radius></sphere></geometry>"
        "</collision>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    const auto& links = loaded.world->prototypes[0].links;
    EXPECT_EQ(links[0].collisions[0].geometry.radius, 2);
    EXPECT_EQ(links[1].collisions[0].geometry.radius, 1);
    EXPECT_EQ(links[0].collisions[0].where.line, 3);
    EXPECT_NE(links[0].collisions[0].where.file.find("world.sdf"), std::string::npos);
    EXPECT_NE(links[0].where.file.find("part/model.sdf"), std::string::npos);
    EXPECT_EQ(links[0].where.line, 3);
}

TEST_F(IncludeChanges, ReachPartsOfModelsThatTheModelIncludes) {
    EXPECT_EQ(links_of(changed("<link element_id='part::p' action='remove'/>", "whole")),
              (Names{"w", "part::q"}));
}

TEST_F(IncludeChanges, ThatAreWrongAreToldAndLeaveTheModelOut) {
    for (const char* wrong :
         {"<link action='remove'/>", "<link element_id='x' action='remove'/>",
          "<link element_id='p' action='paint'/>", "<link element_id='' action='add' name='p'/>",
          "<link element_id='' action='add'/>",
          "<link element_id='p'><mass action='modify'>1</mass></link>"}) {
        const Loaded loaded = changed(wrong);
        ASSERT_NE(loaded.find("include-params"), nullptr) << wrong << "\n" << loaded.text();
        EXPECT_EQ(loaded.find("include-params")->where.line, 3);
        EXPECT_FALSE(loaded.find("include-params")->remedy.empty());
    }
}

TEST_F(IncludeChanges, APluginInAnIncludeIsOneOfTheModel) {
    const std::string drive =
        "<plugin name='gz::sim::systems::VelocityControl' filename='gz-sim-velocity-control-system'/>";
    const Loaded one = world("<include><uri>part</uri>" + drive +
                             "</include><include><uri>part</uri><name>plain</name>"
                             "<pose>9 0 0 0 0 0</pose></include>");
    EXPECT_FALSE(one.diagnostics.has_errors()) << one.text();
    ASSERT_EQ(one.world->instances.size(), 2u);
    const auto onboard = [&](std::size_t i) {
        return one.world->prototypes[one.world->instances[i].prototype].onboard.size();
    };
    EXPECT_EQ(onboard(0), 1u);
    EXPECT_EQ(onboard(1), 0u);
}

TEST_F(IncludeChanges, ThatAreEqualShareOnePrototype) {
    const std::string change =
        "<uri>part</uri><experimental:params><link element_id='p' action='remove'/></experimental:params>";
    const Loaded loaded =
        world("<include>" + change + "</include>\n<include><name>other</name><pose>3 0 0 0 0 0</pose>" +
              change + "</include>");
    EXPECT_EQ(loaded.world->instances.size(), 2u) << loaded.text();
    EXPECT_EQ(loaded.world->prototypes.size(), 1u);
}

}  // namespace
}  // namespace roboss
