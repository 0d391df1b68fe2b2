// URDF: what other readers drop. Links behind links without mass, joints of all types, sensors at fixed
// joints, <gazebo>, names.
#include <gtest/gtest.h>

#include <algorithm>

#include "sdf/test_files.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

using namespace sdf_test;

std::string heavy(const std::string& name, const std::string& more = "") {
    return "<link name='" + name +
           "'><inertial><mass value='2'/><inertia ixx='.1' iyy='.1' izz='.1' ixy='0' ixz='0' "
           "iyz='0'/></inertial>" +
           more + "</link>\n";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& more = "") {
    return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" +
           child + "'/>" + more + "</joint>\n";
}

Loaded load_robot(const std::string& parts) {
    return load_text("<robot name='r'>\n" + parts + "</robot>", "r.urdf");
}

const JointSpec* find_joint(const Loaded& loaded, const std::string& name) {
    if (!loaded.world || loaded.world->prototypes.empty()) return nullptr;
    const auto& joints = loaded.world->prototypes[0].joints;
    const auto found = std::ranges::find(joints, name, &JointSpec::name);
    return found == joints.end() ? nullptr : &*found;
}

double mass_of(const ModelSpec& model) {
    double mass = 0;
    for (const LinkSpec& link : model.links) mass += link.mass;
    return mass;
}

const std::string kFreeHinge = "<axis xyz='0 1 0'/>";

TEST(UrdfParts, LinksBehindALinkWithoutMassAreKept) {
    for (const std::string inertial :
         {"",
          "<inertial><mass value='0.0'/><inertia ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/>"
          "</inertial>"}) {
        const Loaded loaded = load_robot(heavy("body") + "<link name='shoulder'>" + inertial + "</link>" +
                                         heavy("arm") + joint("weld", "fixed", "body", "shoulder") +
                                         joint("hinge", "continuous", "shoulder", "arm", kFreeHinge));
        ASSERT_TRUE(loaded.world) << loaded.text();
        EXPECT_EQ(loaded.diagnostics.count(Severity::kWarning), 0u) << loaded.text();
        const ModelSpec& model = loaded.world->prototypes.at(0);
        ASSERT_EQ(model.links.size(), 2u);
        EXPECT_EQ(mass_of(model), 4);
        ASSERT_NE(find_joint(loaded, "hinge"), nullptr);
        EXPECT_EQ(find_joint(loaded, "hinge")->parent, "body") << "'shoulder' is a frame on it";
    }
}

TEST(UrdfParts, AMasslessBaseOnAWorldLinkLoadsAsWithoutIt) {
    const std::string rest =
        "<link name='base'/>" + heavy("arm") + joint("hinge", "continuous", "base", "arm", kFreeHinge);
    const Loaded on_world =
        load_robot("<link name='world'/>" + rest + joint("weld", "fixed", "world", "base"));
    const Loaded alone = load_robot(rest);
    for (const Loaded* loaded : {&on_world, &alone}) {
        ASSERT_TRUE(loaded->world) << loaded->text();
        EXPECT_FALSE(loaded->diagnostics.has_errors()) << loaded->text();
        EXPECT_EQ(loaded->world->prototypes.at(0).links.size(), 2u);
        const auto& joints = loaded->world->prototypes[0].joints;
        EXPECT_TRUE(std::ranges::any_of(joints, [](const JointSpec& j) { return j.parent == "world"; }));
    }
    EXPECT_EQ(on_world.diagnostics.items().size(), 0u) << on_world.text();
}

TEST(UrdfParts, AWorldThatIsNotDeclaredIsTheWorldWithAWarning) {
    const Loaded loaded = load_robot(heavy("base") + joint("weld", "fixed", "world", "base"));
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_NE(loaded.find("undeclared-world"), nullptr);
    EXPECT_EQ(loaded.find("undeclared-world")->where.line, 3);
    EXPECT_EQ(find_joint(loaded, "weld")->parent, "world");
}

TEST(UrdfParts, AFloatingJointLeavesSixDegreesOfFreedom) {
    const std::string origin = "<origin xyz='1 2 3'/>";
    for (const std::string& robot :
         {"<link name='base'/>" + heavy("body") + joint("free", "floating", "base", "body", origin),
          "<link name='world'/>" + heavy("body") + joint("free", "floating", "world", "body", origin)}) {
        const Loaded loaded = load_robot(robot);
        ASSERT_TRUE(loaded.world) << loaded.text();
        EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
        const ModelSpec& model = loaded.world->prototypes.at(0);
        ASSERT_EQ(model.links.size(), 1u);
        EXPECT_EQ(model.links[0].X_ML.p, (Vec3{1, 2, 3}));
        EXPECT_TRUE(model.joints.empty());
    }
    const Loaded pair = load_robot(heavy("a") + heavy("b") + joint("free", "floating", "a", "b", origin));
    ASSERT_TRUE(pair.world) << pair.text();
    EXPECT_EQ(pair.world->prototypes.at(0).links.size(), 2u);
    EXPECT_EQ(pair.world->prototypes[0].links[1].X_ML.p, (Vec3{1, 2, 3}));
}

/// Where roll and yaw turn about one axis: two quarter turns are a half turn.
TEST(UrdfParts, APitchOfNinetyDegreesTurnsByNinetyDegrees) {
    const std::string origin = kFreeHinge + "<origin xyz='1 0 0' rpy='0 1.5707963267948966 0'/>";
    const Loaded loaded =
        load_robot(heavy("a") + heavy("b") + heavy("c") + joint("first", "continuous", "a", "b", origin) +
                   joint("second", "continuous", "b", "c", origin));
    ASSERT_TRUE(loaded.world) << loaded.text();
    const ModelSpec& model = loaded.world->prototypes.at(0);
    ASSERT_EQ(model.links.size(), 3u);
    const Pose& tip = model.links[2].X_ML;
    EXPECT_LT(norm(tip.p - Vec3{1, 0, -1}), 1e-15);
    EXPECT_LT(norm(tip * Vec3{1, 2, 3} - Vec3{0, 2, -4}), 1e-14);
}

TEST(UrdfParts, ASphericalJointIsABall) {
    const Loaded loaded = load_robot(heavy("a") + heavy("b") + joint("j", "spherical", "a", "b"));
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    EXPECT_EQ(find_joint(loaded, "j")->kind, JointSpecKind::kBall);
}

TEST(UrdfParts, ATypeThatIsNotKnownIsAnErrorThatNamesTheJoint) {
    const Loaded loaded = load_robot(heavy("a") + heavy("b") + joint("twist", "helical", "a", "b"));
    ASSERT_NE(loaded.find("joint-type"), nullptr) << loaded.text();
    EXPECT_EQ(loaded.find("joint-type")->where.line, 4);
    EXPECT_NE(loaded.find("joint-type")->message.find("'twist'"), std::string::npos);
}

TEST(UrdfParts, ShapesThatUrdfHas) {
    const auto load_shape = [](const std::string& shape) {
        return load_robot(
            heavy("a", "<collision><origin xyz='0 0 1'/><geometry>" + shape + "</geometry></collision>"));
    };
    const Loaded capsule = load_shape("<capsule radius='0.1' length='0.4'/>");
    ASSERT_TRUE(capsule.world) << capsule.text();
    const CollisionSpec& pill = capsule.world->prototypes.at(0).links.at(0).collisions.at(0);
    EXPECT_EQ(pill.geometry.kind, GeometryKind::kCapsule);
    EXPECT_EQ(pill.geometry.radius, 0.1);
    EXPECT_EQ(pill.geometry.length, 0.4);
    EXPECT_EQ(pill.X_LS.p.z, 1);
    EXPECT_EQ(pill.name, "a_collision");
    const Loaded cone = load_shape("<cone radius='0.1' length='0.4'/>");
    ASSERT_TRUE(cone.world) << cone.text();
    const GeometrySpec& tip = cone.world->prototypes.at(0).links.at(0).collisions.at(0).geometry;
    EXPECT_EQ(tip.kind, GeometryKind::kCone);
    EXPECT_EQ(tip.radius + tip.length, 0.5);
    const Loaded ellipsoid = load_shape("<ellipsoid radii='0.1 0.2 0.3'/>");
    ASSERT_TRUE(ellipsoid.world) << ellipsoid.text();
    const GeometrySpec& egg = ellipsoid.world->prototypes.at(0).links.at(0).collisions.at(0).geometry;
    EXPECT_EQ(egg.kind, GeometryKind::kEllipsoid);
    EXPECT_EQ(egg.size, (Vec3{0.1, 0.2, 0.3}));
    for (const Loaded* good : {&capsule, &cone, &ellipsoid})
        EXPECT_TRUE(good->diagnostics.items().empty()) << good->text();
}

TEST(UrdfParts, AShapeThatCannotBeIsAnErrorInACollisionAndAWarningInAVisual) {
    const auto load_part = [](const std::string& kind, const std::string& geometry) {
        return load_robot(heavy("a", "\n<" + kind + ">" + geometry + "</" + kind + ">"));
    };
    struct Case {
        const char *shape, *cause;
    };
    for (const Case& c : {Case{"<blob radius='1'/>", "<blob> is not known"},
                          {"<sphere/>", "<sphere> has no radius"},
                          {"<capsule radius='1'/>", "<capsule> has no length"},
                          {"<cylinder/>", "<cylinder> has no radius and no length"},
                          {"<mesh/>", "<mesh> has no filename"}}) {
        const std::string geometry = "<geometry>" + std::string(c.shape) + "</geometry>";
        for (const std::string kind : {"collision", "visual"}) {
            const Loaded loaded = load_part(kind, geometry);
            const Diagnostic* told = loaded.find("urdf-shape");
            ASSERT_NE(told, nullptr) << c.shape;
            EXPECT_EQ(told->severity, kind == "collision" ? Severity::kError : Severity::kWarning) << c.shape;
            EXPECT_NE(told->message.find("<" + kind + "> of link 'a': " + c.cause), std::string::npos)
                << told->message;
            EXPECT_EQ(told->where.line, 3);
        }
    }
    for (const char* nothing : {"", "<geometry/>"}) {
        const Loaded loaded = load_part("collision", nothing);
        ASSERT_TRUE(loaded.world) << loaded.text();
        ASSERT_NE(loaded.find("urdf-shape"), nullptr);
        EXPECT_EQ(loaded.find("urdf-shape")->severity, Severity::kWarning)
            << "it says nothing that could act";
        EXPECT_TRUE(loaded.world->prototypes.at(0).links.at(0).collisions.empty());
    }
}

TEST(UrdfParts, WhatIsLeftOutIsNamed) {
    const Loaded sensor =
        load_robot(heavy("a") + "<gazebo reference='b'><mu1>1</mu1><sensor name='imu' type='imu'/></gazebo>");
    ASSERT_NE(sensor.find("gazebo-reference"), nullptr) << sensor.text();
    EXPECT_NE(sensor.find("gazebo-reference")->message.find("left out <mu1>, <sensor> 'imu'"),
              std::string::npos)
        << sensor.text();
    const Loaded freed =
        load_robot(heavy("a") + "<link name='b'/><link name='c'/>\n" + joint("j", "floating", "a", "b"));
    ASSERT_TRUE(freed.world) << freed.text();
    EXPECT_EQ(freed.world->prototypes.at(0).links.size(), 1u);
    std::vector<std::string> told;
    for (const Diagnostic& d : freed.diagnostics.items())
        if (d.code == "left-out-link" && d.severity == Severity::kWarning) told.push_back(d.message);
    ASSERT_EQ(told.size(), 2u) << freed.text();
    EXPECT_NE(told[0].find("link 'b'"), std::string::npos) << told[0];
    EXPECT_NE(told[0].find("joint 'j'"), std::string::npos) << told[0];
    EXPECT_NE(told[1].find("link 'c'"), std::string::npos) << told[1];
}

TEST(UrdfParts, AJointMayBeCalledWorld) {
    const Loaded loaded =
        load_robot(heavy("a") + heavy("b") + joint("world", "continuous", "a", "b", kFreeHinge));
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    ASSERT_NE(find_joint(loaded, "world"), nullptr);
    EXPECT_EQ(find_joint(loaded, "world")->parent, "a");
}

TEST(UrdfParts, ASensorAtAFixedJointMeasuresThatJoint) {
    const Loaded loaded = load_robot(
        "<link name='world'/>" + heavy("flange") + heavy("cell") + heavy("tool") +
        joint("mount", "fixed", "world", "flange") + joint("cell_joint", "fixed", "flange", "cell") +
        joint("tool_joint", "fixed", "cell", "tool") +
        "<gazebo reference='cell_joint'><sensor name='ft' type='force_torque'><update_rate>100</update_rate>"
        "</sensor></gazebo>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    std::vector<std::string> measured;
    for (const LinkSpec& link : loaded.world->prototypes.at(0).links)
        for (const SensorSpec& sensor : link.sensors)
            measured.push_back(link.name + " " + sensor.as<ForceTorqueSpec>()->joint);
    EXPECT_EQ(measured, std::vector<std::string>{"cell cell_joint"});
}

TEST(UrdfParts, WhatGazeboSaysOfALinkIsInItsCollisions) {
    const Loaded loaded = load_robot(
        heavy("a", "<collision><geometry><sphere radius='1'/></geometry></collision>") +
        "<gazebo reference='a'><mu1>0.3</mu1><mu2 value='0.4'/><kp>1e5</kp><kd>10</kd><maxContacts>3"
        "</maxContacts><selfCollide>true</selfCollide><turnGravityOff>true</turnGravityOff></gazebo>"
        "<gazebo reference='b'><mu1>1</mu1></gazebo>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const LinkSpec& link = loaded.world->prototypes.at(0).links.at(0);
    const SurfaceSpec& surface = link.collisions.at(0).surface;
    EXPECT_EQ(surface.mu, 0.3);
    EXPECT_EQ(surface.mu2, 0.4);
    EXPECT_EQ(surface.stiffness, 1e5);
    EXPECT_EQ(surface.damping, 10);
    EXPECT_EQ(surface.max_contacts, 3);
    EXPECT_FALSE(link.gravity);
    EXPECT_TRUE(loaded.world->prototypes[0].self_collide);
    EXPECT_NE(loaded.find("gazebo-reference"), nullptr) << "'b' is nothing";
}

TEST(UrdfParts, PluginsFindAJointThatHasTheNameOfALink) {
    const Loaded loaded =
        load_robot(heavy("a") + heavy("b") + joint("b", "continuous", "a", "b", kFreeHinge) +
                   "<gazebo><plugin filename='gz-sim-joint-controller-system' "
                   "name='gz::sim::systems::JointController'><joint_name>b</joint_name></plugin></gazebo>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    ASSERT_EQ(loaded.world->prototypes.at(0).onboard.size(), 1u) << loaded.text();
    EXPECT_EQ(joints_named(loaded.world->prototypes[0].onboard[0].parameters), std::vector<std::string>{"b"});
    ASSERT_NE(find_joint(loaded, "b"), nullptr);
}

TEST(UrdfParts, ALinkWithTwoParentsAndALoopAreErrorsThatNameTheLink) {
    const Loaded two = load_robot(heavy("a") + heavy("b") + heavy("c") + joint("ac", "fixed", "a", "c") +
                                  joint("bc", "fixed", "b", "c"));
    ASSERT_NE(two.find("two-parents"), nullptr) << two.text();
    EXPECT_EQ(two.find("two-parents")->where.line, 6);
    EXPECT_NE(two.find("two-parents")->message.find("'c'"), std::string::npos);
    const Loaded loop =
        load_robot(heavy("a") + heavy("b") + joint("ab", "fixed", "a", "b") + joint("ba", "fixed", "b", "a"));
    EXPECT_NE(loop.find("joint-loop"), nullptr) << loop.text();
}

TEST(UrdfParts, AJointWithoutAnEndIsAnErrorThatNamesIt) {
    for (const std::string& bad : {joint("j", "fixed", "a", "gone"), joint("j", "fixed", "gone", "b"),
                                   std::string("<joint name='j' type='fixed'><child link='b'/></joint>")}) {
        const Loaded loaded = load_robot(heavy("a") + heavy("b") + bad);
        ASSERT_NE(loaded.find("joint-to-nowhere"), nullptr) << loaded.text();
        EXPECT_EQ(loaded.find("joint-to-nowhere")->where.line, 4);
        EXPECT_NE(loaded.find("joint-to-nowhere")->message.find("'j'"), std::string::npos);
        EXPECT_EQ(loaded.diagnostics.count(Severity::kError), 1u) << loaded.text();
    }
}

TEST(UrdfParts, NumbersThatAreNoneAreErrorsAtTheirLine) {
    for (const std::string& bad :
         {"<origin xyz='1 2'/>" + kFreeHinge, "<origin rpy='0 0 x'/>" + kFreeHinge}) {
        const Loaded loaded = load_robot(heavy("a") + heavy("b") + joint("j", "continuous", "a", "b", bad));
        ASSERT_NE(loaded.find("bad-value"), nullptr) << loaded.text();
        EXPECT_EQ(loaded.find("bad-value")->where.line, 4);
    }
}

TEST(UrdfParts, TheOrderOfTheFileIsThatOfTheJoints) {
    const Loaded loaded = load_robot(heavy("base") + heavy("z") + heavy("a") +
                                     joint("second", "continuous", "base", "a", kFreeHinge) +
                                     joint("first", "continuous", "base", "z", kFreeHinge));
    ASSERT_TRUE(loaded.world) << loaded.text();
    const ModelSpec& model = loaded.world->prototypes.at(0);
    EXPECT_EQ(model.joints.at(0).name, "second");
    EXPECT_EQ(model.links.at(1).name, "z");
}

}  // namespace
}  // namespace roboss
