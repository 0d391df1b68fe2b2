// Meshes, heightmaps and polylines as SDF gives them: what the World then holds, automatic inertia, and each
// fault with its line.
#include <gtest/gtest.h>

#include <cmath>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

// A box of 1 x 2 x 3 m about (0.5, 1, 1.5); quads, counter-clockwise from outside.
const std::string kBoxObj =
    "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

std::string world_with(const std::string& geometry, const std::string& model = "",
                       const std::string& inertial = kInertial) {
    return "<sdf version='1.11'><world name='w'><model name='m'>" + model + "<link name='a'>" + inertial +
           "\n<collision name='c'><geometry>\n" + geometry +
           "\n</geometry></collision></link></model></world></sdf>";
}

Loaded load(const TestFolder& folder, const std::string& geometry, const std::string& model = "",
            const std::string& inertial = kInertial) {
    folder.write("box.obj", kBoxObj);
    folder.write("world.sdf", world_with(geometry, model, inertial));
    return folder.load("world.sdf");
}

const GeometrySpec& geometry_of(const Loaded& loaded) {
    return loaded.world->prototypes[0].links[0].collisions[0].geometry;
}

TEST(SdfShapes, AMeshIsReadScaledAndShared) {
    const TestFolder folder;
    const Loaded loaded =
        load(folder,
             "<mesh><uri>box.obj</uri><scale>2 1 0.5</scale></mesh></geometry></collision>"
             "<collision name='d'><geometry><mesh><uri>box.obj</uri><scale>2 1 0.5</scale></mesh>");
    ASSERT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    const GeometrySpec& g = geometry_of(loaded);
    ASSERT_NE(g.mesh, nullptr);
    EXPECT_EQ(g.mesh->vertices.size(), 8u);
    EXPECT_EQ(g.mesh->triangles.size(), 12u);
    double right = 0;
    for (const Vec3& v : g.mesh->vertices) right = std::max(right, v.x);
    EXPECT_EQ(right, 2.0);
    EXPECT_EQ(loaded.world->prototypes[0].links[0].collisions[1].geometry.mesh, g.mesh);
    EXPECT_FALSE(g.as_hull);
}

TEST(SdfShapes, OptimizationAsksForTheHullAndDecompositionSaysThatItIsOne) {
    const TestFolder folder;
    const Loaded hull = load(folder, "<mesh optimization='convex_hull'><uri>box.obj</uri></mesh>");
    EXPECT_TRUE(geometry_of(hull).as_hull);
    EXPECT_EQ(hull.find("convex-decomposition"), nullptr) << hull.text();
    const Loaded parts =
        load(folder,
             "<mesh optimization='convex_decomposition'><uri>box.obj</uri>"
             "<convex_decomposition><max_convex_hulls>4</max_convex_hulls></convex_decomposition>"
             "</mesh>");
    ASSERT_FALSE(parts.diagnostics.has_errors()) << parts.text();
    EXPECT_TRUE(geometry_of(parts).as_hull);
    ASSERT_NE(parts.find("convex-decomposition"), nullptr);
    EXPECT_EQ(parts.find("convex-decomposition")->where.line, 3);
}

void expect_error(const std::string& geometry, const std::string& code, const std::string& word) {
    const TestFolder folder;
    folder.write("broken.stl", "solid nothing");
    folder.write("empty.obj", "");
    folder.write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n");
    folder.write("picture.png", "no picture");
    const Loaded loaded = load(folder, geometry);
    ASSERT_NE(loaded.find(code), nullptr) << loaded.text();
    const Diagnostic& found = *loaded.find(code);
    EXPECT_EQ(found.severity, Severity::kError);
    EXPECT_EQ(found.where.line, 3);
    EXPECT_NE(found.message.find(word), std::string::npos) << found.message;
    EXPECT_FALSE(found.remedy.empty());
}

TEST(SdfShapes, BadFilesAreErrorsAtTheirLine) {
    expect_error("<mesh><uri>missing.stl</uri></mesh>", "file-not-found", "missing.stl");
    expect_error("<mesh><uri>broken.stl</uri></mesh>", "bad-mesh", "broken.stl");
    expect_error("<mesh><uri>empty.obj</uri></mesh>", "bad-mesh", "empty");
    expect_error("<mesh><uri>nan.obj</uri></mesh>", "bad-mesh", "nan.obj");
    expect_error("<mesh><uri>box.obj</uri><scale>1e9 1 1</scale></mesh>", "bad-mesh", "1000 km");
    expect_error("<mesh><uri>box.obj</uri><submesh><name>x</name></submesh></mesh>", "bad-mesh", "'x'");
    expect_error("<heightmap><uri>picture.png</uri><size>1 1 1</size></heightmap>", "bad-heightmap",
                 "picture.png");
    expect_error("<heightmap><uri>picture.png</uri><size>0 1 1</size></heightmap>", "bad-size", "size");
    expect_error("<polyline><point>0 0</point><point>1 zero</point><height>1</height></polyline>",
                 "bad-value", "1 zero");
}

TEST(SdfShapes, AMissingFileThatIsOnlySeenIsAWarning) {
    const TestFolder folder;
    const Loaded loaded =
        load(folder,
             "<sphere><radius>1</radius></sphere></geometry></collision>"
             "<visual name='v'><geometry><mesh><uri>missing.dae</uri></mesh></geometry></visual>"
             "<collision name='d'><geometry><sphere><radius>1</radius></sphere>");
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_NE(loaded.find("file-not-found"), nullptr);
    EXPECT_EQ(loaded.find("file-not-found")->severity, Severity::kWarning);
}

TEST(SdfShapes, APolylineKeepsItsCornersAndHeight) {
    const TestFolder folder;
    const Loaded loaded = load(
        folder,
        "<polyline><point>0 0</point><point>2 0</point><point>0 1</point><height>0.5</height></polyline>");
    ASSERT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_EQ(geometry_of(loaded).outline.size(), 3u);
    EXPECT_EQ(geometry_of(loaded).outline[1].x, 2.0);
    EXPECT_EQ(geometry_of(loaded).length, 0.5);
}

const std::string kAutomatic = "<inertial auto='true'><density>100</density></inertial>";

TEST(SdfShapes, AutomaticInertiaOfAMeshIsThatOfItsSolid) {
    const TestFolder folder;
    const Loaded loaded = load(folder, "<mesh><uri>box.obj</uri></mesh>", "", kAutomatic);
    ASSERT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    const LinkSpec& link = loaded.world->prototypes[0].links[0];
    EXPECT_NEAR(link.mass, 600, 1e-9);
    EXPECT_NEAR(norm(link.p_LC - Vec3{0.5, 1, 1.5}), 0, 1e-12);
    EXPECT_NEAR(link.inertia_C(0, 0), 50 * (4 + 9), 1e-9);
    EXPECT_NEAR(link.inertia_C(1, 1), 50 * (1 + 9), 1e-9);
    EXPECT_NEAR(link.inertia_C(2, 2), 50 * (1 + 4), 1e-9);
    EXPECT_NEAR(link.inertia_C(0, 1), 0, 1e-9);
}

TEST(SdfShapes, AutomaticInertiaOfAnLIsThatOfItsTwoBoxes) {
    const TestFolder folder;
    const Loaded loaded =
        load(folder,
             "<polyline><point>0 0</point><point>3 0</point><point>3 1</point><point>1 1</point>"
             "<point>1 4</point><point>0 4</point><height>2</height></polyline>",
             "", kAutomatic);
    ASSERT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    const LinkSpec& link = loaded.world->prototypes[0].links[0];
    // 3 x 1 about (1.5, 0.5) and 1 x 3 about (0.5, 2.5), both of 600 kg.
    EXPECT_NEAR(link.mass, 1200, 1e-9);
    EXPECT_NEAR(norm(link.p_LC - Vec3{1, 1.5, 1}), 0, 1e-12);
    const double offsets = 2 * 600 * (0.25 + 1);
    EXPECT_NEAR(link.inertia_C(2, 2), 2 * 50 * (1 + 9) + offsets, 1e-9);
    EXPECT_NEAR(link.inertia_C(0, 1), -(2 * 600 * (0.5 * -1)), 1e-9);
}

TEST(SdfShapes, AutomaticInertiaFollowsCollisionsPlacedInOtherFrames) {
    const auto link_with = [](const std::string& pose) {
        const Loaded loaded = load_elements(
            "<model name='m'><frame name='f'><pose>1 2 3 0 0 1.5707963267948966</pose></frame>"
            "<link name='a'><pose>0 0 1 0 0 0</pose>" +
            kAutomatic + "<collision name='c'>" + pose +
            "<geometry><box><size>1 2 3</size></box></geometry></collision></link></model>");
        EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
        return loaded.world->prototypes[0].links[0];
    };
    const LinkSpec there = link_with("<pose relative_to='f'>1 0 0 0 0 0</pose>");
    const LinkSpec plain = link_with("<pose>1 3 2 0 0 1.5707963267948966</pose>");
    EXPECT_NEAR(norm(there.p_LC - plain.p_LC), 0, 1e-9);
    EXPECT_NEAR(norm(there.p_LC - there.collisions[0].X_LS.p), 0, 1e-12);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            EXPECT_NEAR(there.inertia_C(i, j), plain.inertia_C(i, j), 1e-9) << i << " " << j;
}

TEST(SdfShapes, AutomaticInertiaOfAMeshWithAHoleIsThatOfItsHull) {
    const TestFolder folder;
    folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
    const Loaded loaded = load(folder, "<mesh><uri>open.obj</uri></mesh>", "", kAutomatic);
    ASSERT_NE(loaded.find("automatic-inertia"), nullptr);
    EXPECT_NEAR(loaded.world->prototypes[0].links[0].mass, 100.0 / 6, 1e-3);
    EXPECT_NEAR(loaded.world->prototypes[0].links[0].p_LC.x, 0.25, 1e-6);
}

}  // namespace
}  // namespace roboss
