// WheelSlip and LookupWheelSlip as files write them.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

const std::string kWheels =
    "<plugin filename='gz-sim-wheel-slip-system' name='gz::sim::systems::WheelSlip'>"
    "<wheel link_name='left'><slip_compliance_lateral>0.1</slip_compliance_lateral>"
    "<slip_compliance_longitudinal>0.2</slip_compliance_longitudinal><wheel_normal_force>77</"
    "wheel_normal_force>"
    "<wheel_radius>0.3</wheel_radius></wheel>"
    "<wheel "
    "link_name='right'><wheel_normal_force>7</wheel_normal_force><wheel_radius>0.2</wheel_radius></wheel>"
    "</plugin>";

std::string vehicle(const std::string& plugins) {
    std::string all = "<model name='m'>" + link("body");
    for (const std::string wheel : {"left", "right"})
        all += link(wheel) + "<joint name='" + wheel + "_axle' type='revolute'><parent>body</parent><child>" +
               wheel + "</child><axis><xyz>0 1 0</xyz></axis></joint>";
    return all + plugins + "</model>";
}

TEST(WheelSlip, IsReadWheelByWheel) {
    const Loaded loaded = load_elements(vehicle(kWheels));
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const auto& onboard = loaded.world->prototypes.at(0).onboard;
    ASSERT_EQ(onboard.size(), 2u);
    WheelSlipSpec left, right;
    left.wheels.push_back({{"left"}, 0.1, 0.2, 77, 0.3});
    right.wheels.push_back({{"right"}, 0, 0, 7, 0.2});
    EXPECT_EQ(std::get<WheelSlipSpec>(onboard[0].parameters), left);
    EXPECT_EQ(std::get<WheelSlipSpec>(onboard[1].parameters), right);
}

TEST(WheelSlip, BadWheelsAreReported) {
    for (const char* bad :
         {"", "<wheel link_name='left'/>",
          "<wheel><wheel_normal_force>1</wheel_normal_force><wheel_radius>1</wheel_radius></wheel>"}) {
        const Loaded loaded = load_elements(vehicle(
            "<plugin filename='x' name='gz::sim::systems::WheelSlip'>" + std::string(bad) + "</plugin>"));
        ASSERT_TRUE(loaded.world) << loaded.text();
        EXPECT_TRUE(loaded.world->prototypes.at(0).onboard.empty()) << bad;
        EXPECT_NE(loaded.find("plugin-not-run"), nullptr) << bad;
    }
}

/// 3 x 2 pixels: neutral, green 228, green 228; red 138 green 28 blue 130, neutral, neutral.
std::string picture() {
    const std::string hex =
        "89504e470d0a1a0a0000000d49484452000000030000000208020000001216f14d0000001449444154789c636800"
        "822720c4d025d3d400060061e80971a372a8060000000049454e44ae426082";
    std::string bytes;
    for (std::size_t i = 0; i < hex.size(); i += 2)
        bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
    return bytes;
}

std::string lookup(const std::string& map) {
    return "<plugin filename='gz-sim-lookup-wheel-slip-system' name='gz::sim::systems::LookupWheelSlip'>"
           "<slip_map>" +
           map +
           "</slip_map><size_x>6</size_x><size_y>4</size_y>"
           "<slip_compliance_longitudinal_delta>0.01</slip_compliance_longitudinal_delta>"
           "<wheel_link_name>left</wheel_link_name><wheel_link_name>right</wheel_link_name></plugin>";
}

TEST(LookupWheelSlip, ReadsItsPicture) {
    const TestFolder folder;
    folder.write("map.png", picture());
    folder.write("world.sdf", "<sdf version='1.9'><world name='w'>" + vehicle(kWheels + lookup("map.png")) +
                                  "</world></sdf>");
    const Loaded loaded = folder.load("world.sdf");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const auto& onboard = loaded.world->prototypes.at(0).onboard;
    ASSERT_EQ(onboard.size(), 3u) << loaded.text();
    const auto& spec = std::get<LookupWheelSlipSpec>(onboard[2].parameters);
    EXPECT_EQ(spec.map.columns, 3);
    EXPECT_EQ(spec.map.rows, 2);
    EXPECT_EQ(spec.map.runs.size(), 4u) << "runs of equal colour";
    EXPECT_EQ(spec.map.at(0, 0), 0x808080u);
    EXPECT_EQ(spec.map.at(1, 0), 0x80e480u);
    EXPECT_EQ(spec.map.at(2, 0), 0x80e480u);
    EXPECT_EQ(spec.map.at(0, 1), 0x8a1c82u);
    EXPECT_EQ(spec.map.at(2, 1), 0x808080u);
    EXPECT_EQ(spec.size_x, 6);
    EXPECT_EQ(spec.longitudinal_delta, 0.01);
    EXPECT_EQ(spec.commands(),
              (std::vector<std::string>{"link/left/wheel_slip", "link/left/wheel_friction",
                                        "link/right/wheel_slip", "link/right/wheel_friction"}));
}

TEST(LookupWheelSlip, APictureThatIsMissingOrBrokenIsReported) {
    const TestFolder folder;
    folder.write("broken.png", picture().substr(0, 40));
    for (const auto& [map, code] :
         {std::pair("none.png", "file-not-found"), {"broken.png", "bad-slip-map"}}) {
        folder.write("world.sdf", "<sdf version='1.9'><world name='w'>" + vehicle(kWheels + lookup(map)) +
                                      "</world></sdf>");
        const Loaded loaded = folder.load("world.sdf");
        ASSERT_TRUE(loaded.world) << loaded.text();
        EXPECT_EQ(loaded.world->prototypes.at(0).onboard.size(), 2u);
        EXPECT_NE(loaded.find(code), nullptr) << loaded.text();
        EXPECT_NE(loaded.find("plugin-not-run"), nullptr);
    }
}

}  // namespace
}  // namespace roboss
