// The picture holds what it was given, and survives odd input.
#include "app/output/path_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

namespace roboss {
namespace {

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
}

Model small_world() {
    Model model;
    model.statics.push_back(
        {{ShapeKind::kPlane, {}, 0, 0}, {}, {}, "ground::link::plane", {}, {}, {}, false});
    model.statics.push_back({{ShapeKind::kBox, {2, 1, 3}, 0, 0},
                             {Mat3::identity(), {5, 0, 3}},
                             {},
                             "house::link::part",
                             {},
                             {},
                             {},
                             false});
    model.statics.push_back({{ShapeKind::kCylinder, {}, 0.5, 1},
                             {Mat3::identity(), {0, 5, 1}},
                             {},
                             "tree::link::part",
                             {},
                             {},
                             {},
                             false});
    model.statics.push_back({{ShapeKind::kSphere, {}, 0.5, 0},
                             {Mat3::identity(), {0, -5, 0}},
                             {},
                             "ball::link::part",
                             {},
                             {},
                             {},
                             false});
    return model;
}

TEST(PathPicture, ShowsEveryShapeButPlanesAndEveryPath) {
    const std::string svg =
        path_picture(small_world(), {{"car_0", {{0, 0, 0}, {3, 4, 9}}}, {"car_1", {{1, 1, 0}, {2, 1, 0}}}},
                     {"Title", "", 800});
    EXPECT_EQ(count(svg, "<polygon"), 6u);  // three shapes and their shadows
    EXPECT_EQ(count(svg, "<polyline"), 2u);
    EXPECT_NE(svg.find("<title>car_0: 5.0 m</title>"), std::string::npos);
    EXPECT_NE(svg.find("house::link::part"), std::string::npos);
    EXPECT_EQ(svg.find("ground::link::plane"), std::string::npos);
}

TEST(PathPicture, NorthIsUpAndNothingIsStretched) {
    const std::string svg =
        path_picture({}, {{"a", {{0, 0, 0}, {10, 0, 0}}}, {"b", {{0, 10, 0}, {10, 10, 0}}}}, {"", "", 800});
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0, x2 = 0, y2 = 0;
    const std::size_t a = svg.find("points=\""), b = svg.find("points=\"", a + 1);
    ASSERT_EQ(std::sscanf(svg.c_str() + a, "points=\"%lf,%lf %lf,%lf", &x0, &y0, &x1, &y1), 4);
    ASSERT_EQ(std::sscanf(svg.c_str() + b, "points=\"%lf,%lf", &x2, &y2), 2);
    EXPECT_NEAR(y0, y1, 0.11);
    EXPECT_NEAR(x1 - x0, y0 - y2, 0.21);
    EXPECT_GT(x1 - x0, 500);
}

TEST(PathPicture, NamesCannotBreakTheMarkup) {
    const std::string svg = path_picture({}, {{"<b>&\"", {{0, 0, 0}, {1, 0, 0}}}}, {"a < b", "", 800});
    EXPECT_NE(svg.find("&lt;b&gt;&amp;&quot;"), std::string::npos);
    EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
}

TEST(PathPicture, NothingToShowIsStillAPicture) {
    const std::string svg = path_picture({}, {{"still", {}}}, {"Empty", "", 800});
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(PathPicture, PlacesThatAreNoNumbersAreLeftOut) {
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    const std::string svg =
        path_picture({}, {{"lost", {{nowhere, 0, 0}, {0, 0, 0}, {3, 4, 0}, {nowhere, 0, 0}}}}, {"", "", 800});
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_NE(svg.find("lost: 5.0 m"), std::string::npos);
}

TEST(PathPicture, AFolderThatDoesNotExistIsSaidSo) {
    const Result<> result = write_path_picture("/no/such/folder/picture.svg", {}, {}, {});
    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.error().text().find("/no/such/folder/picture.svg"), std::string::npos);
    EXPECT_NE(result.error().text().find("remedy"), std::string::npos);
}

}  // namespace
}  // namespace roboss
