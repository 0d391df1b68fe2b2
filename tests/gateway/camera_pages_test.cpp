// Pages look through cameras of robots: pictures come while somebody looks, in the size that is asked for,
// and the run is the same as ever.
#include <support/robots.h>
#include <support/simulation.h>

#include "mesh/image_file.h"
#include "mesh/jpeg_image.h"
#include "scene/scene_codec.h"
#include "viewed.h"

namespace roboss::test {
namespace {

/// A car with a colour, a depth and an RGB-D camera before a red wall, 4.8 m away.
World room() {
    World world;
    GeometrySpec wall;
    wall.size = {0.4, 40, 40};
    world.prototypes = {scenery(box_shape(wall.size, surface(1))), car()};
    world.prototypes[0].links[0].visuals.push_back({"wall", wall, {}, {0.9, 0.1, 0.1}, 1});
    const auto eye = [&](const char* name, auto kind) {
        kind.optics.width = 64, kind.optics.height = 48, kind.optics.horizontal_fov = 1;
        SensorSpec sensor;
        sensor.name = name;
        sensor.parameters = kind;
        world.prototypes[1].links[0].sensors.push_back(sensor);
    };
    eye("color", ColorCameraSpec{});
    eye("depth", DepthCameraSpec{});
    eye("both", RgbdCameraSpec{});
    world.instances = {{"wall", 0, {{5, 0, 0}, {}}, {}}, {"car", 1, {{0, 0, 3}, {}}, {}}};
    world.gravity = {};
    return world;
}

struct Rooms : testing::Test {
    World world = room();
    std::shared_ptr<const Model> model = compiled(world);
    LiveRunOptions options;

    void SetUp() override {
        options.visuals = [this](const Model& m) { return encode_scene(make_scene(m, &world), m); };
    }
    static Json looking(const Json& cameras) {
        return {{"type", "watch"}, {"robots", Json::array()}, {"cameras", cameras}};
    }
};

const Browser::Picture* picture_of(const Browser& browser, std::uint32_t sensor, const std::string& shows) {
    for (const Browser::Picture& picture : browser.pictures())
        if (picture.sensor == sensor && picture.about["shows"] == shows) return &picture;
    return nullptr;
}

TEST_F(Rooms, APageGetsPicturesOfTheCamerasThatItLooksThrough) {
    LiveRun run(model, options);
    Browser browser(ViewerUrl(run.url()));
    browser.send(looking({{{"robot", 0}, {"sensor", 0}},
                          {{"robot", 0}, {"sensor", 1}, {"columns", 32}},
                          {{"robot", 0}, {"sensor", 2}},
                          {{"robot", 0}, {"sensor", 2}, {"depth", true}}}));
    ASSERT_TRUE(browser.until([&] {
        return picture_of(browser, 0, "color") && picture_of(browser, 1, "depth") &&
               picture_of(browser, 2, "color") && picture_of(browser, 2, "depth");
    }));
    EXPECT_FALSE(browser.damaged());
    const Browser::Picture& color = *picture_of(browser, 0, "color");
    EXPECT_EQ(color.about["columns"], 64);
    const Result<ColourImage> seen = decode_jpeg(color.file);
    ASSERT_TRUE(seen.ok());
    EXPECT_EQ(seen.value().rows, 48u);
    const std::uint8_t* middle = &seen.value().samples[3 * (24 * 64 + 32)];
    EXPECT_GT(middle[0], middle[1] + 30) << "the wall is red";

    const Browser::Picture& depth = *picture_of(browser, 1, "depth");
    EXPECT_EQ(depth.about["columns"], 32);
    EXPECT_EQ(depth.about["rows"], 24);
    const Result<ColourImage> numbers = decode_picture({"", PictureKind::kPng, 0, 0, depth.file});
    ASSERT_TRUE(numbers.ok());
    const std::uint8_t* pixel = &numbers.value().samples[3 * (12 * 32 + 16)];
    const double low = depth.about["low"], high = depth.about["high"];
    EXPECT_NEAR(low + (256.0 * pixel[0] + pixel[1] - 1) / 65533 * (high - low), 4.8, 1e-3);
    EXPECT_NEAR(depth.about["intrinsics"][2].get<double>(), 16, 1e-9) << "of the picture";
    EXPECT_NEAR(depth.about["pose"][2].get<double>(), 3.05, 1e-6) << "the chassis of the car";
}

TEST_F(Rooms, NobodyLooksAndNothingIsRendered) {
    LiveRun run(model, options);
    Browser browser(ViewerUrl(run.url()));
    browser.send(looking({{{"robot", 0}, {"sensor", 0}}}));
    ASSERT_TRUE(browser.until([&] { return browser.pictures().size() >= 2; }));
    browser.send(looking(Json::array()));
    browser.live(500);
    const std::size_t before = browser.pictures().size();
    browser.live(500);
    EXPECT_EQ(browser.pictures().size(), before);
}

TEST_F(Rooms, WhoLooksThroughSomethingElseGetsNothingAndDoesNoHarm) {
    LiveRun run(model, options);
    Browser browser(ViewerUrl(run.url()));
    browser.send(looking(
        {{{"robot", 0}, {"sensor", 9}}, {{"robot", 77}, {"sensor", 0}}, {{"robot", 0}, {"sensor", 0}}}));
    ASSERT_TRUE(browser.until([&] { return picture_of(browser, 0, "color") != nullptr; }));
    for (const Browser::Picture& picture : browser.pictures()) EXPECT_EQ(picture.sensor, 0u);
}

TEST_F(Rooms, AControllerWithoutVisualsIsNamedAsTheReason) {
    options.visuals = nullptr;
    LiveRun run(model, options);
    Browser browser(ViewerUrl(run.url()));
    browser.send(looking({{{"robot", 0}, {"sensor", 0}}}));
    ASSERT_TRUE(browser.until([&] { return browser.last("no_pictures") != nullptr; }));
    EXPECT_EQ((*browser.last("no_pictures"))["code"], "no-look");
}

TEST_F(Rooms, TheHashIsThatOfARunThatNobodyLooksAt) {
    LiveRunOptions alone = options;
    alone.viewer = false, alone.end = 500, alone.speed = 0;
    const std::uint64_t expected = LiveRun(model, alone).hash_at_end();
    options.end = 500;
    LiveRun run(model, options);
    Browser browser(ViewerUrl(run.url()));
    browser.send(looking({{{"robot", 0}, {"sensor", 0}}}));
    EXPECT_TRUE(browser.until([&] { return browser.pictures().size() >= 2; }));
    EXPECT_EQ(run.hash_at_end(), expected);
}

}  // namespace
}  // namespace roboss::test
