// Belts and actors in files.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

std::string box(const std::string& name, const std::string& inner = "") {
    return "<collision name='" + name + "'><geometry><box><size>1 1 1</size></box></geometry>" + inner +
           "</collision>";
}

const ModelSpec& model_of(const Loaded& loaded) {
    return loaded.world->prototypes.at(0);
}

const SurfaceVelocitySpec& motion_of(const Loaded& loaded) {
    return std::get<SurfaceVelocitySpec>(model_of(loaded).onboard.at(0).parameters);
}

TEST(SurfaceMotion, OfALinkCountsForAllItsCollisions) {
    const Loaded loaded =
        load_elements("<model name='m'>" +
                      link("a", box("x") + box("y") +
                                    "<roboss:surface_velocity><linear>1 2 0</linear><angular>0 0 3</angular>"
                                    "<topic>go</topic></roboss:surface_velocity>") +
                      "</model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    SurfaceVelocitySpec expected;
    expected.link = LinkNames{"a"};
    expected.linear = {1, 2, 0}, expected.angular = {0, 0, 3}, expected.topic = "go";
    EXPECT_EQ(motion_of(loaded), expected);
    for (const CollisionSpec& collision : model_of(loaded).links[0].collisions) EXPECT_TRUE(collision.moves);
}

TEST(SurfaceMotion, OfACollisionCountsForItAlone) {
    const std::string motion = "<roboss:surface_velocity><linear>1 0 0</linear></roboss:surface_velocity>";
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a", box("x") + box("y", motion) + box("z", motion)) + "</model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    ASSERT_EQ(model_of(loaded).onboard.size(), 1u);
    EXPECT_EQ(motion_of(loaded).link, LinkNames{"a"});
    const std::vector<CollisionSpec>& collisions = model_of(loaded).links[0].collisions;
    EXPECT_FALSE(collisions[0].moves);
    EXPECT_TRUE(collisions[1].moves && collisions[2].moves);
}

TEST(SurfaceMotion, ThatDiffersWithinALinkIsReported) {
    const Loaded loaded = load_elements(
        "<model name='m'>" +
        link("a", box("x", "<roboss:surface_velocity><linear>1 0 0</linear></roboss:surface_velocity>") +
                      box("y", "<roboss:surface_velocity><linear>2 0 0</linear></roboss:surface_velocity>")) +
        "</model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_NE(loaded.find("second-surface-velocity"), nullptr);
    EXPECT_EQ(motion_of(loaded).linear, (Vec3{1, 0, 0}));
}

TEST(SurfaceMotion, InThePlaceOfAnotherElementIsReported) {
    const Loaded loaded =
        load_elements("<model name='m'>" + link("a") + "<roboss:surface_velocity/></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_NE(loaded.find("unknown-extension"), nullptr);
    EXPECT_TRUE(model_of(loaded).onboard.empty());
}

TEST(SurfaceMotion, OfATrackControllerIsReadWithAllItsLimits) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a") +
        "<plugin name='gz::sim::systems::TrackController' filename='gz-sim-track-controller-system'>"
        "<link>a</link><track_orientation>0 0 1.5</track_orientation><velocity_topic>/v</velocity_topic>"
        "<max_command_age>2</max_command_age><min_velocity>-1</min_velocity><max_velocity>2</max_velocity>"
        "<max_acceleration>3</max_acceleration><odometry_publish_frequency>1</odometry_publish_frequency>"
        "</plugin></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    TrackControllerSpec expected;
    expected.link = LinkNames{"a"};
    expected.orientation = {0, 0, 1.5}, expected.velocity_topic = "/v";
    expected.max_command_age = 2, expected.min_velocity = -1, expected.max_velocity = 2;
    expected.max_acceleration = 3, expected.odometry_publish_frequency = 1;
    EXPECT_EQ(std::get<TrackControllerSpec>(model_of(loaded).onboard.at(0).parameters), expected);
}

TEST(Actors, AreKinematicBodiesWithTheirWaypointsInOrder) {
    const Loaded loaded = load_elements(
        "<actor name='walker'><pose>1 2 1 0 0 0</pose><skin><filename>x.dae</filename></skin>"
        "<animation name='walk'><filename>x.dae</filename></animation>"
        "<script><loop>false</loop><delay_start>2</delay_start><auto_start>true</auto_start>"
        "<trajectory id='1' type='walk' tension='0.6'>"
        "<waypoint><time>2</time><pose>2 0 0 0 0 0</pose></waypoint>"
        "<waypoint><time>1.0004</time><pose>1 0 0 0 0 0</pose></waypoint></trajectory>"
        "<trajectory id='0' type='walk'><waypoint><time>0</time><pose>2 0 0 0 0 "
        "0</pose></waypoint></trajectory>"
        "</script></actor>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_NE(loaded.find("actor"), nullptr);
    EXPECT_EQ(loaded.find("actor")->severity, Severity::kNote);
    EXPECT_EQ(loaded.find("actor")->where.line, 1);
    const ModelSpec& model = model_of(loaded);
    EXPECT_TRUE(model.kinematic);
    EXPECT_EQ(loaded.world->instances.at(0).name, "walker");
    EXPECT_EQ(loaded.world->instances[0].X_WM.p, (Vec3{1, 2, 1}));
    const auto& spec = std::get<ActorSpec>(model.onboard.at(0).parameters);
    EXPECT_FALSE(spec.loop);
    EXPECT_EQ(spec.delay_start, 2);
    ASSERT_EQ(spec.waypoints.size(), 3u);
    EXPECT_EQ(spec.waypoints[0].time, 1.0) << "whole milliseconds, by time";
    EXPECT_EQ(spec.waypoints[1].pose.p.x, 2);
    EXPECT_EQ(spec.waypoints[1].tension, 0.6);
    EXPECT_EQ(spec.waypoints[2].trajectory, 1);
    ASSERT_EQ(model.links.size(), 1u);
    EXPECT_EQ(model.links[0].collisions.at(0).geometry.kind, GeometryKind::kCapsule);
}

TEST(Actors, KeepTheLinksThatTheyHave) {
    const Loaded loaded = load_elements("<actor name='cart'>" + link("a", box("x")) + "</actor>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(model_of(loaded).links.at(0).name, "a");
    EXPECT_TRUE(model_of(loaded).kinematic);
    EXPECT_EQ(model_of(loaded).joints.size(), 1u) << "it hangs on its base";
}

TEST(KinematicModels, AreThoseOfWhichAllLinksAreKinematic) {
    const std::string kinematic = "<kinematic>true</kinematic>";
    const std::string weld = "<joint name='j' type='fixed'><parent>a</parent><child>b</child></joint>";
    const Loaded all =
        load_elements("<model name='m'>" + link("a", kinematic) + link("b", kinematic) + weld + "</model>");
    ASSERT_TRUE(all.world) << all.text();
    EXPECT_TRUE(model_of(all).kinematic);
    ASSERT_NE(all.find("kinematic"), nullptr);
    EXPECT_EQ(all.find("kinematic")->severity, Severity::kNote);
    const Loaded some =
        load_elements("<model name='m'>" + link("a", kinematic) + link("b") + weld + "</model>");
    EXPECT_FALSE(model_of(some).kinematic);
    ASSERT_NE(some.find("kinematic"), nullptr);
    EXPECT_EQ(some.find("kinematic")->severity, Severity::kWarning);
}

}  // namespace
}  // namespace roboss
