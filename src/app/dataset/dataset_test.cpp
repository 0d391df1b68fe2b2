// Labels, and what is written of things at places that are known.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "app/dataset/dataset.h"

namespace roboss {
namespace {

World world_of(std::vector<std::pair<std::string, int>> models) {
    World world;
    for (const auto& [name, label] : models) {
        ModelSpec model;
        model.name = name;
        model.links.emplace_back().visuals.emplace_back().label = label;
        world.prototypes.push_back(std::move(model));
    }
    return world;
}

TEST(Labels, KindsAreNamesWithoutTheirNumbers) {
    EXPECT_EQ(kind_of_model("car_12"), "car");
    EXPECT_EQ(kind_of_model("car 3"), "car");
    EXPECT_EQ(kind_of_model("robot2"), "robot");
    EXPECT_EQ(kind_of_model("r2d2_arm"), "r2d2_arm");
    EXPECT_EQ(kind_of_model("42"), "42");
    EXPECT_EQ(kind_of_model("_7"), "_7");
}

TEST(Labels, OfAWorldAreKeptAndNamedAfterAllTheirKinds) {
    World world = world_of({{"car_1", 3}, {"truck", 3}, {"tree_1", 0}});
    EXPECT_EQ(label_world(world, "auto"), (LabelNames{{3, "car|truck"}}));
    EXPECT_EQ(world.prototypes[2].links[0].visuals[0].label, 0);
}

TEST(Labels, AreGivenByKindWhereTheWorldHasNoneOrTheyAreNotWanted) {
    World world = world_of({{"car_1", 0}, {"car_2", 0}, {"tree", 0}, {"ground", 0}});
    world.prototypes[3].is_static = true;
    EXPECT_EQ(label_world(world, "world"), LabelNames{});
    EXPECT_EQ(label_world(world, "auto"), (LabelNames{{1, "car"}, {2, "tree"}}));
    EXPECT_EQ(world.prototypes[1].links[0].visuals[0].label, 1);
    EXPECT_TRUE(world.prototypes[1].links[0].visuals[0].labels_model);
    EXPECT_EQ(world.prototypes[3].links[0].visuals[0].label, 0);
    World labelled = world_of({{"car_1", 7}, {"tree", 0}});
    EXPECT_EQ(label_world(labelled, "models"), (LabelNames{{1, "car"}, {2, "tree"}}));
}

/// 100 x 100 pixels, 90 degrees: the focal length is 50 pixels.
CameraOptics square_camera() {
    CameraOptics optics;
    optics.width = optics.height = 100;
    optics.horizontal_fov = M_PI / 2;
    optics.near = 0.1, optics.far = 100;
    return optics;
}

/// The numbers of a label's line, without its type.
std::vector<double> numbers_of(const std::string& line) {
    std::istringstream words(line);
    std::string type;
    words >> type;
    std::vector<double> numbers;
    for (double number = 0; words >> number;) numbers.push_back(number);
    return numbers;
}

TEST(KittiLabel, HasTheBoxInTheFrameOfKitti) {
    SeenThing thing;
    thing.box = {40, 45, 20, 10};
    thing.visible = 0.6;
    thing.size = {4, 2, 1.5};
    constexpr double kYaw = 0.3;  // to the left of the camera's axis
    thing.X_CB = {{10, -2, -1}, {std::cos(kYaw / 2), 0, 0, std::sin(kYaw / 2)}};
    const std::vector<double> v = numbers_of(kitti_label(thing, "car", square_camera()));
    ASSERT_EQ(v.size(), 14U);
    EXPECT_EQ(v[0], 0);  // all of it is in the image
    EXPECT_EQ(v[1], 1);  // hidden in part
    EXPECT_EQ((std::vector<double>(v.begin() + 3, v.begin() + 7)), (std::vector<double>{40, 45, 60, 55}));
    EXPECT_EQ((std::vector<double>(v.begin() + 7, v.begin() + 10)), (std::vector<double>{1.5, 2, 4}));
    EXPECT_NEAR(v[10], 2, 1e-3);     // right
    EXPECT_NEAR(v[11], 1.75, 1e-3);  // down, of the bottom
    EXPECT_NEAR(v[12], 10, 1e-3);    // ahead
    EXPECT_NEAR(v[13], -M_PI / 2 - kYaw, 1e-3);
    EXPECT_NEAR(v[2], v[13] - std::atan2(2, 10), 1e-3);
}

TEST(KittiLabel, TellsTheShareOutsideOfTheImage) {
    SeenThing thing;
    thing.size = {1e-6, 2, 2};                 // a square at 10 m is 10 pixels wide
    thing.X_CB = {{10, 10, 0}, {1, 0, 0, 0}};  // its middle is at the left edge
    EXPECT_NEAR(truncation(thing, square_camera()), 0.5, 1e-6);
    thing.X_CB.p.z = 10;  // and at the upper one
    EXPECT_NEAR(truncation(thing, square_camera()), 0.75, 1e-6);
    thing.X_CB.p = {10, 0, 0};
    EXPECT_EQ(truncation(thing, square_camera()), 0);
}

TEST(KittiCalibration, TakesPointsOfTheLidarToPixels) {
    const CameraOptics optics = square_camera();
    KittiSample sample;
    sample.optics = &optics;
    sample.X_WC.p = {1, 0, 1};
    sample.X_WB.p = {0, 0, 0.2};
    std::istringstream text(kitti_calibration(sample));
    std::map<std::string, std::vector<double>> rows;
    for (std::string line; std::getline(text, line);) rows[line.substr(0, line.find(':'))] = numbers_of(line);
    const std::vector<double>& P = rows["P2"];
    const std::vector<double>& T = rows["Tr_velo_to_cam"];  // without a lidar: of the base
    ASSERT_EQ(P.size(), 12U);
    ASSERT_EQ(T.size(), 12U);
    const double p[4] = {11, 2, 0.8, 1};  // of the base; of the camera: 10 ahead, 2 left, 0 up
    double c[3];
    for (std::size_t r = 0; r < 3; ++r)
        c[r] = T[4 * r] * p[0] + T[4 * r + 1] * p[1] + T[4 * r + 2] * p[2] + T[4 * r + 3];
    EXPECT_NEAR(c[2], 10, 1e-9);
    EXPECT_NEAR((P[0] * c[0] + P[2] * c[2]) / c[2], 40, 1e-6);
    EXPECT_NEAR((P[5] * c[1] + P[6] * c[2]) / c[2], 50, 1e-6);
}

}  // namespace
}  // namespace roboss
