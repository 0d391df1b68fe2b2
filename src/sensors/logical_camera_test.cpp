// The logical camera against frusta that are easy to compute, and the poses that it gives.
#include <gtest/gtest.h>

#include <cmath>

#include "sensors/test_model.h"

namespace roboss {
namespace {

using namespace sensors_test;

/// A camera that sees from 1 to 10 m, 45 degrees to both sides, and half as high as wide.
LogicalCameraSpec wide_camera() {
    LogicalCameraSpec spec;
    spec.near = 1, spec.far = 10, spec.horizontal_fov = 0.5 * kPi, spec.aspect_ratio = 2;
    return spec;
}

/// A cart at the origin with a camera on its cart link (X_LS), and others at these places.
struct Scene {
    std::shared_ptr<Model> model;
    std::vector<RobotState> states;

    Scene(const SensorParameters& camera, const std::vector<Pose>& others, const Pose& X_LS = {}) {
        RobotType type = cart_type();
        add_sensor(type, 0, sensor("eye", camera, X_LS));
        model = model_of(type, others.size() + 1);
        states.push_back(cart_at({}));
        for (const Pose& X : others) states.push_back(cart_at(X));
    }
    LogicalCameraReading read() const {
        std::vector<const RobotState*> pointers;
        for (const RobotState& state : states) pointers.push_back(&state);
        return read_as<LogicalCameraReading>(model, pointers, 0);
    }
    std::vector<double> seen() const { return read().models; }
};

Pose at(double x, double y, double z) {
    return {{x, y, z}, {}};
}

TEST(LogicalCamera, SeesTheFramesInItsFrustumAndNoOthers) {
    const double out = 1e-9;
    const Scene scene(wide_camera(), {
                                         at(5, 0, 0),                             // 1: ahead
                                         at(1 - out, 0, 0), at(1 + out, 0, 0),    // 2, 3: near
                                         at(10 + out, 0, 0), at(10 - out, 0, 0),  // 4, 5: far
                                         at(4, 4 + out, 0), at(4, 4 - out, 0),    // 6, 7: left
                                         at(4, -4 - out, 0), at(4, -4 + out, 0),  // 8, 9: right
                                         at(4, 0, 2 + out), at(4, 0, 2 - out),    // 10, 11: above
                                         at(4, 0, -2 - out), at(4, 0, -2 + out),  // 12, 13: below
                                         at(-5, 0, 0)                             // 14: behind
                                     });
    EXPECT_EQ(scene.seen(), (std::vector<double>{1, 3, 5, 7, 9, 11, 13}));
    EXPECT_EQ(scene.read().names[0], "cart_1");
}

TEST(LogicalCamera, GivesPosesInItsOwnFrame) {
    const Pose X_WC{{1, 2, 0}, from_rpy(0, 0, 0.5 * kPi)};  // the camera's cart looks along world y
    const Pose X_WM{{1.5, 6, 1}, from_rpy(0, 0, 0.5 * kPi + 0.3)};
    Scene scene(wide_camera(), {X_WM}, at(0.5, 0, 0.25));
    scene.states[0] = cart_at(X_WC);
    const LogicalCameraReading reading = scene.read();
    ASSERT_EQ(reading.models, (std::vector<double>{1}));
    EXPECT_NEAR(reading.positions[0], 3.5, 1e-12);  // 4 m ahead of the cart
    EXPECT_NEAR(reading.positions[1], -0.5, 1e-12);
    EXPECT_NEAR(reading.positions[2], 0.75, 1e-12);
    EXPECT_NEAR(reading.orientations[0], std::cos(0.15), 1e-12);
    EXPECT_NEAR(reading.orientations[3], std::sin(0.15), 1e-12);
}

TEST(LogicalCamera, SeesItsOwnModelWhereItsFrameIsInTheFrustum) {
    const Scene scene(wide_camera(), {}, {{-2, 0, 0}, {}});
    EXPECT_EQ(scene.seen(), (std::vector<double>{0}));
    EXPECT_TRUE(Scene(wide_camera(), {}).seen().empty());
}

TEST(LogicalCamera, LooksAtTheFrameOfTheModelNotOfItsBody) {
    Scene scene(wide_camera(), {at(5, 0, 0)});
    scene.model->types[0].X_RB.p = {0, 0, 8};  // the body is 8 m above the model's frame
    const auto reading = scene.read();
    EXPECT_TRUE(reading.models.empty());  // 8 m below the bodies, too far down
    scene.states[1] = cart_at(at(5, 0, 8));
    EXPECT_EQ(scene.seen(), (std::vector<double>{1}));
}

TEST(LogicalCamera, SeesSceneryWhereTheWorldFileHasIt) {
    LogicalCameraSpec spec = wide_camera();
    spec.scenery = {"wall", "far_wall", "shelf"};
    spec.scenery_poses = {
        3, 0, 0, 1, 0, 0, 0, 30, 0, 0, 1, 0, 0, 0, 2, 1, 0, std::cos(0.5), 0, 0, std::sin(0.5)};
    const LogicalCameraReading reading = Scene(spec, {at(5, 0, 0)}).read();
    EXPECT_EQ(reading.names, (std::vector<std::string>{"cart_1", "wall", "shelf"}));
    EXPECT_EQ(reading.models, (std::vector<double>{1, -1, -1}));
    ASSERT_EQ(reading.positions.size(), 9u);
    EXPECT_EQ(reading.positions[7], 1);
    EXPECT_NEAR(reading.orientations[11], std::sin(0.5), 1e-12);
}

TEST(LogicalCamera, DoesNotListPartsOfAModelAndTheMessageBoard) {
    Scene scene(wide_camera(), {at(5, 0, 0), at(5, 1, 0), at(5, 2, 0)});
    scene.model->robots[2].name = "cart_1::loose_link";
    RobotType board = cart_type();
    OnboardInfo info;
    info.spec.parameters = MessageBoardSpec{};
    board.onboard.push_back(info);
    scene.model->types.push_back(board);
    scene.model->robots[3].type = TypeId(std::size_t{1});
    EXPECT_EQ(scene.seen(), (std::vector<double>{1}));
}

TEST(LogicalCamera, OneThatSeesNothingIsAProblem) {
    const auto problems = [](double near, double far, double fov, double aspect) {
        LogicalCameraSpec spec;
        spec.near = near, spec.far = far, spec.horizontal_fov = fov, spec.aspect_ratio = aspect;
        return problems_of(sensor("eye", spec)).size();
    };
    EXPECT_EQ(problems(0, 1, 1, 1), 0u);
    EXPECT_EQ(problems(2, 1, 1, 1), 1u);
    EXPECT_EQ(problems(0, 1, 0, 1), 1u);
    EXPECT_EQ(problems(0, 1, 3.2, 1), 1u);
    EXPECT_EQ(problems(0, 1, 1, 0), 1u);
}

}  // namespace
}  // namespace roboss
