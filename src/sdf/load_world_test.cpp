// Links, poses, joints and frames as the file means them.
#include "sdf/load_world.h"

#include <gtest/gtest.h>

#include <chrono>

#include "sdf/test_files.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

using namespace sdf_test;

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-12);
    EXPECT_NEAR(a.y, b.y, 1e-12);
    EXPECT_NEAR(a.z, b.z, 1e-12);
}

TEST(LoadWorld, ReadsAModelWithItsPlaceInTheWorld) {
    const Loaded loaded =
        load_elements("<model name='m'><pose>1 2 3 0 0 1.5707963267948966</pose>" + link("a") + "</model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    ASSERT_EQ(loaded.world->instances.size(), 1u);
    EXPECT_EQ(loaded.world->instances[0].name, "m");
    expect_near(loaded.world->instances[0].X_WM.p, {1, 2, 3});
    expect_near(rotate(loaded.world->instances[0].X_WM.q, Vec3{1, 0, 0}), {0, 1, 0});
    EXPECT_EQ(loaded.world->prototypes[0].links[0].mass, 2.0);
}

TEST(LoadWorld, ReadsMjcfByItsRootElement) {
    const std::string text =
        "<mujoco model='m'>\n<worldbody><body name='b'><freejoint/>\n<geom size='.1' "
        "oops='1'/></body></worldbody>"
        "</mujoco>";
    const Loaded loaded = load_text(text, "robot.xml");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.world->instances.at(0).name, "b");
    ASSERT_NE(loaded.find("unknown-attribute"), nullptr) << loaded.text();
    EXPECT_EQ(loaded.find("unknown-attribute")->where.line, 3);
    Diagnostics diagnostics;
    EXPECT_TRUE(load_world_text(text, "<text>", {}, diagnostics));
}

TEST(LoadWorld, ReadsTextAsAFileOfThatName) {
    Diagnostics diagnostics;
    const std::string text = "<sdf version='1.9'><model name='m'>\n<oops/>" + link("a") + "</model></sdf>";
    const std::optional<World> world = load_world_text(text, "given.sdf", {}, diagnostics);
    ASSERT_TRUE(world);
    EXPECT_EQ(world->file, "given.sdf");
    EXPECT_EQ(world->instances[0].name, "m");
    ASSERT_FALSE(diagnostics.items().empty());
    EXPECT_EQ(diagnostics.items()[0].where.file, "given.sdf");
    EXPECT_EQ(diagnostics.items()[0].where.line, 2);
    EXPECT_FALSE(load_world_text("no XML", "given.sdf", {}, diagnostics));
}

TEST(LoadWorld, ModelsEqualButForNameAndPoseShareOnePrototype) {
    std::string models;
    for (int i = 0; i < 5; ++i) {
        models += "<model name='m" + std::to_string(i) + "'><pose>" + std::to_string(i) +
                  " 0 0 0 0 0</pose>" + link("a") + "</model>\n";
    }
    models += "<model name='other'>" + link("b") + "</model>";
    const Loaded loaded = load_elements(models);
    ASSERT_TRUE(loaded.world);
    EXPECT_EQ(loaded.world->prototypes.size(), 2u);
    ASSERT_EQ(loaded.world->instances.size(), 6u);
    EXPECT_EQ(loaded.world->instances[4].prototype, 0u);
    EXPECT_EQ(loaded.world->instances[4].X_WM.p.x, 4.0);
    EXPECT_EQ(loaded.world->instances[5].prototype, 1u);
}

TEST(LoadWorld, ModelsThatDifferInNumbersOnlyKeepTheirOwnNumbers) {
    const auto ball = [](const std::string& name, const std::string& radius) {
        return "<model name='" + name + "'>" +
               link("a", "<collision name='c'><geometry><sphere><radius>" + radius +
                             "</radius></sphere></geometry></collision>") +
               "</model>";
    };
    const Loaded loaded = load_elements(ball("x", "0.25") + ball("y", "0.75"));
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_EQ(loaded.world->prototypes.size(), 2u);
    EXPECT_EQ(loaded.world->prototypes[0].links[0].collisions[0].geometry.radius, 0.25);
    EXPECT_EQ(loaded.world->prototypes[1].links[0].collisions[0].geometry.radius, 0.75);
}

TEST(LoadWorld, TurnsAnInertiaIntoLinkAxes) {
    const Loaded loaded = load_elements(
        "<model name='m'><link name='a'><inertial><pose>0.1 0.2 0.3 0 0 "
        "1.5707963267948966</pose><mass>3</mass><inertia>"
        "<ixx>1</ixx><iyy>2</iyy><izz>2.5</izz><ixy>0.1</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></"
        "link></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const LinkSpec& link = loaded.world->prototypes[0].links[0];
    expect_near(link.p_LC, {0.1, 0.2, 0.3});
    EXPECT_NEAR(link.inertia_C(0, 0), 2, 1e-12);
    EXPECT_NEAR(link.inertia_C(1, 1), 1, 1e-12);
    EXPECT_NEAR(link.inertia_C(0, 1), -0.1, 1e-12);
}

TEST(LoadWorld, FoldsAPlanesNormalIntoItsPose) {
    const Loaded loaded = load_elements(
        "<model name='m'><static>true</static><link name='a'><collision name='c'><geometry><plane><normal>1 "
        "0 0</normal>"
        "<size>2 3</size></plane></geometry></collision></link></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const CollisionSpec& c = loaded.world->prototypes[0].links[0].collisions[0];
    expect_near(rotate(c.X_LS.q, Vec3{0, 0, 1}), {1, 0, 0});
    EXPECT_EQ(c.geometry.size.y, 3.0);
}

TEST(LoadWorld, ReadsJointsWithLimitsMotorsAndFrames) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a") + "<link name='b'><pose>0 0 1 0 0 1.5707963267948966</pose>" +
        kInertial + "</link>" +
        "<joint name='j' type='revolute'><parent>a</parent><child>b</child><pose>0 0 0.5 0 0 0</pose>"
        "<axis><xyz expressed_in='__model__'>1 0 "
        "0</xyz><limit><lower>-1</lower><upper>2</upper><effort>7</effort>"
        "<velocity>3</velocity></limit><dynamics><damping>0.1</damping><friction>0.2</friction></dynamics>"
        "<roboss:motor><position_gain>50</position_gain><armature>0.01</armature></roboss:motor></axis></"
        "joint></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const JointSpec& joint = loaded.world->prototypes[0].joints[0];
    EXPECT_EQ(joint.kind, JointSpecKind::kRevolute);
    EXPECT_EQ(joint.parent, "a");
    EXPECT_EQ(joint.child, "b");
    expect_near(joint.X_MJ.p, {0, 0, 1.5});
    // The model's x axis, seen from a frame turned by 90 degrees about z.
    expect_near(joint.axes[0].xyz, {0, -1, 0});
    EXPECT_EQ(joint.axes[0].lower, -1);
    EXPECT_EQ(joint.axes[0].upper, 2);
    EXPECT_EQ(joint.axes[0].max_effort, 7);
    EXPECT_EQ(joint.axes[0].max_velocity, 3);
    EXPECT_EQ(joint.axes[0].damping, 0.1);
    EXPECT_EQ(joint.axes[0].friction, 0.2);
    EXPECT_EQ(joint.axes[0].position_gain, 50);
    EXPECT_EQ(joint.axes[0].armature, 0.01);
}

TEST(LoadWorld, AnAxisOfAnOldFileCanBeInTheModelsFrame) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a") + "<link name='b'><pose>0 0 1 0 0 1.5707963267948966</pose>" +
            kInertial + "</link>" +
            "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz>"
            "<use_parent_model_frame>true</use_parent_model_frame><limit><lower>-1</lower><upper>1</upper></"
            "limit></axis></joint></model>",
        "1.6");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    expect_near(loaded.world->prototypes[0].joints[0].axes[0].xyz, {0, -1, 0});
}

TEST(LoadWorld, ReadsEveryKindOfJoint) {
    std::string model = "<model name='m'>" + link("l0");
    const char* kinds[] = {"fixed", "revolute", "continuous", "prismatic",
                           "ball",  "screw",    "universal",  "revolute2"};
    int i = 0;
    for (const char* kind : kinds) {
        const std::string n = std::to_string(++i);
        model += link("l" + n) + "<joint name='j" + n + "' type='" + kind + "'><parent>l0</parent><child>l" +
                 n + "</child><axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>";
    }
    const Loaded loaded = load_elements(model + "</model>");
    ASSERT_TRUE(loaded.world);
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    const auto& joints = loaded.world->prototypes[0].joints;
    ASSERT_EQ(joints.size(), 8u);
    EXPECT_EQ(joints[0].axes.size(), 0u);
    EXPECT_GT(joints[2].axes[0].upper, 1e300);
    EXPECT_EQ(joints[4].kind, JointSpecKind::kBall);
    EXPECT_EQ(joints[4].axes.size(), 0u);
    EXPECT_EQ(joints[6].axes.size(), 2u);
    EXPECT_EQ(joints[5].screw_pitch, -1) << "one radian a metre, left-handed, is SDFormat's default";
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
}

TEST(LoadWorld, PitchOfAScrewIsReadInBothOfItsUnits) {
    const auto pitch_of = [](const std::string& element) {
        const Loaded loaded =
            load_elements("<model name='m'>" + link("a") + link("b") +
                          "<joint name='j' type='screw'><parent>a</parent><child>b</child>" + element +
                          "<axis><xyz>0 0 1</xyz></axis></joint></model>");
        EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
        return loaded.world->prototypes[0].joints[0].screw_pitch;
    };
    EXPECT_DOUBLE_EQ(pitch_of("<screw_thread_pitch>0.01</screw_thread_pitch>"), 0.01 / (2 * kPi))
        << "metres a turn";
    EXPECT_DOUBLE_EQ(pitch_of("<thread_pitch>50</thread_pitch>"), -0.02) << "radians a metre, left-handed";
}

Loaded load_planar(const std::string& type, const std::string& axes, const std::string& normal = "0 0 1") {
    return load_elements("<model name='m'>" + link("a") + link("b") +
                         "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>" +
                         normal +
                         "</xyz><dynamics><damping>0.3</damping></dynamics></axis><roboss:joint type='" +
                         type + "'>" + axes + "</roboss:joint></joint></model>");
}

TEST(LoadWorld, ReadsAPlanarJoint) {
    const Loaded loaded =
        load_planar("planar",
                    "<x><limit><lower>-1</lower><upper>2</upper><effort>7</effort></limit></x>"
                    "<y><dynamics><damping>0.2</damping></dynamics><initial_position>0.4</initial_position>"
                    "<roboss:motor><position_gain>50</position_gain></roboss:motor></y>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const JointSpec& joint = loaded.world->prototypes[0].joints[0];
    EXPECT_EQ(joint.kind, JointSpecKind::kPlanar);
    ASSERT_EQ(joint.axes.size(), 3u);
    expect_near(joint.axes[0].xyz, {1, 0, 0});
    expect_near(joint.axes[1].xyz, {0, 1, 0});
    expect_near(joint.axes[2].xyz, {0, 0, 1});
    EXPECT_EQ(joint.axes[0].lower, -1);
    EXPECT_EQ(joint.axes[0].upper, 2);
    EXPECT_EQ(joint.axes[0].max_effort, 7);
    EXPECT_EQ(joint.axes[1].damping, 0.2);
    EXPECT_EQ(joint.axes[1].initial_position, 0.4);
    EXPECT_EQ(joint.axes[1].position_gain, 50);
    EXPECT_EQ(joint.axes[2].damping, 0.3);
}

TEST(LoadWorld, AxesOfAPlaneAreRightHandedForAnyNormal) {
    for (const char* normal : {"1 0 0", "0 1 0", "0 0 -1", "0.3 -0.5 0.2"}) {
        const Loaded loaded = load_planar("planar", "", normal);
        ASSERT_TRUE(loaded.world) << loaded.text();
        const auto& axes = loaded.world->prototypes[0].joints[0].axes;
        expect_near(cross(axes[0].xyz, axes[1].xyz), axes[2].xyz);
        EXPECT_NEAR(dot(axes[0].xyz, axes[2].xyz), 0, 1e-15);
    }
}

TEST(LoadWorld, WrongJointExtensionsAreReported) {
    EXPECT_NE(load_planar("plane", "").find("joint-type"), nullptr);
    EXPECT_NE(load_planar("prismatic", "").find("joint-type"), nullptr) << "SDFormat has that one";
    EXPECT_NE(load_planar("planar", "<z/>").find("unknown-element"), nullptr);
    EXPECT_NE(load_planar("planar", "<x><damping>1</damping></x>").find("unknown-element"), nullptr);
}

TEST(LoadWorld, ReadsAGearbox) {
    const auto load = [](const std::string& reference) {
        return load_elements("<model name='m'>" + link("a") + link("b") +
                             "<joint name='g' type='gearbox'><parent>a</parent><child>b</child>"
                             "<gearbox_ratio>2.5</gearbox_ratio>" +
                             reference +
                             "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint></model>");
    };
    const Loaded good = load("<gearbox_reference_body>frame</gearbox_reference_body>");
    ASSERT_TRUE(good.world) << good.text();
    EXPECT_TRUE(good.diagnostics.items().empty()) << good.text();
    const JointSpec& gearbox = good.world->prototypes[0].joints[0];
    EXPECT_EQ(gearbox.gearbox_ratio, 2.5);
    EXPECT_EQ(gearbox.gearbox_reference, "frame");
    EXPECT_NE(load("").find("gearbox-reference"), nullptr);
}

TEST(LoadWorld, ReadsTheMagneticFieldOfOldPhysics) {
    const std::string physics = "<physics type='ode'><magnetic_field>1 2 3</magnetic_field></physics>";
    const Loaded old = load_elements(physics, "1.5");
    EXPECT_TRUE(old.diagnostics.items().empty()) << old.text();
    expect_near(old.world->magnetic_field_T, {1, 2, 3});
    const Loaded both = load_elements(physics + "<magnetic_field>4 5 6</magnetic_field>", "1.5");
    expect_near(both.world->magnetic_field_T, {4, 5, 6});
}

TEST(LoadWorld, FlattensNestedModels) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a") +
        "<model name='inner'><pose>1 0 0 0 0 1.5707963267948966</pose><link name='b'><pose>1 0 0 0 0 "
        "0</pose>" +
        kInertial +
        "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry></collision></link></model>" +
        "<joint name='j' type='fixed'><parent>a</parent><child>inner::b</child></joint></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    const ModelSpec& model = loaded.world->prototypes[0];
    ASSERT_EQ(model.links.size(), 2u);
    EXPECT_EQ(model.links[1].name, "inner::b");
    expect_near(model.links[1].X_ML.p, {1, 1, 0});
    EXPECT_EQ(model.links[1].collisions[0].geometry.size.z, 3);
    EXPECT_EQ(model.joints[0].child, "inner::b");
    EXPECT_EQ(model.canonical_link, "a");
}

TEST(LoadWorld, PlacesModelsRelativeToOthersAndToTheirFrames) {
    const Loaded loaded = load_elements(
        "<frame name='f' attached_to='base'><pose>0 0 1 0 0 0</pose></frame>"
        "<model name='base'><pose>1 0 0 0 0 1.5707963267948966</pose>" +
        link("a") +
        "<frame name='hook'><pose>0 0 5 0 0 0</pose></frame></model>"
        "<model name='on_frame'><pose relative_to='f'>1 0 0 0 0 0</pose>" +
        link("a") +
        "</model>"
        "<model name='on_hook'><pose relative_to='base::hook'>0 2 0 0 0 0</pose>" +
        link("a") + "</model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    expect_near(loaded.world->instances[1].X_WM.p, {1, 1, 1});
    expect_near(loaded.world->instances[2].X_WM.p, {-1, 0, 5});
}

TEST(LoadWorld, AModelCanBePlacedByOneOfItsFrames) {
    const Loaded loaded =
        load_elements("<model name='m' placement_frame='foot'><pose>0 0 0 0 0 0</pose>" + link("a") +
                      "<frame name='foot'><pose>0 0 -2 0 0 0</pose></frame></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    expect_near(loaded.world->instances[0].X_WM.p, {0, 0, 2});
}

TEST(LoadWorld, ACircleOfFramesIsAnError) {
    const Loaded loaded =
        load_elements("<model name='a'><pose relative_to='b'/>" + link("l") +
                      "</model><model name='b'><pose relative_to='a'/>" + link("l") + "</model>");
    ASSERT_NE(loaded.find("frame-cycle"), nullptr) << loaded.text();
}

TEST(LoadWorld, PosesKnowDegreesQuaternionsAndOtherFrames) {
    const Loaded loaded =
        load_elements("<model name='m'>" +
                      link("a",
                           "<collision name='d'><pose degrees='true'>0 0 0 0 0 "
                           "90</pose><geometry><box><size>1 1 1</size></box></geometry></collision>"
                           "<collision name='q'><pose rotation_format='quat_xyzw'>1 0 0  0 0 "
                           "0.7071067811865476 0.7071067811865476</pose>"
                           "<geometry><box><size>1 1 1</size></box></geometry></collision>"
                           "<collision name='r'><pose relative_to='f'>0 0 1 0 0 "
                           "0</pose><geometry><box><size>1 1 1</size></box></geometry></collision>"
                           "<visual name='v'><pose relative_to='f'>0 0 2 0 0 0</pose><geometry><box><size>1 "
                           "1 1</size></box></geometry></visual>") +
                      "<frame name='f'><pose>5 0 0 0 0 0</pose></frame></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const LinkSpec& l = loaded.world->prototypes[0].links[0];
    expect_near(rotate(l.collisions[0].X_LS.q, Vec3{1, 0, 0}), {0, 1, 0});
    expect_near(rotate(l.collisions[1].X_LS.q, Vec3{1, 0, 0}), {0, 1, 0});
    expect_near(l.collisions[2].X_LS.p, {5, 0, 1});
    expect_near(l.visuals[0].X_LV.p, {5, 0, 2});
}

TEST(LoadWorld, ReadsSurfaces) {
    const Loaded loaded =
        load_elements("<model name='m'>" +
                      link("a",
                           "<collision name='c'><geometry><box><size>1 1 "
                           "1</size></box></geometry><surface><friction><ode><mu>0.3</mu><mu2>0.3</mu2></ode>"
                           "<torsional><coefficient>0.5</coefficient><use_patch_radius>true</"
                           "use_patch_radius><patch_radius>0.02</patch_radius></torsional></friction>"
                           "<bounce><restitution_coefficient>0.4</restitution_coefficient><threshold>0.2</"
                           "threshold></bounce>"
                           "<contact><collide_bitmask>0x0f</collide_bitmask></contact>"
                           "<roboss:rolling_friction>0.001</roboss:rolling_friction></surface></collision>") +
                      "</model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const SurfaceSpec& s = loaded.world->prototypes[0].links[0].collisions[0].surface;
    EXPECT_EQ(s.mu, 0.3);
    EXPECT_EQ(s.restitution, 0.4);
    EXPECT_EQ(s.bounce_threshold, 0.2);
    EXPECT_EQ(s.torsional_mu, 0.5);
    EXPECT_EQ(s.torsional_radius, 0.02);
    EXPECT_EQ(s.collide_bitmask, 15u);
    EXPECT_EQ(s.rolling_mu, 0.001);
}

Loaded with_surface(const std::string& surface) {
    return load_elements("<model name='m'>" +
                         link("a",
                              "<collision name='c'><max_contacts>3</max_contacts><geometry><sphere><radius>1"
                              "</radius></sphere></geometry><surface>" +
                                  surface + "</surface></collision>") +
                         "</model>");
}

TEST(LoadWorld, ReadsFrictionThatDependsOnTheDirection) {
    const Loaded loaded =
        with_surface("<friction><ode><mu>0.5</mu><mu2>0.2</mu2><fdir1>0 1 0</fdir1></ode></friction>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const SurfaceSpec& s = loaded.world->prototypes[0].links[0].collisions[0].surface;
    EXPECT_EQ(s.mu, 0.5);
    EXPECT_EQ(s.mu2, 0.2);
    EXPECT_EQ(s.fdir1, (Vec3{0, 1, 0}));
    EXPECT_EQ(s.max_contacts, 3);
    const Loaded without = with_surface("<friction><ode><mu>0.5</mu><mu2>0.2</mu2></ode></friction>");
    EXPECT_TRUE(without.find("anisotropic-friction")) << without.text();
}

constexpr const char* kProfiles =
    "<roboss:accuracy setting='high'/>"
    "<physics name='coarse' "
    "type='ode'><max_step_size>0.004</max_step_size><real_time_factor>2</real_time_factor>"
    "<ode><solver><iters>20</iters></solver></ode></physics>"
    "<physics name='fine' default='true' type='ode'><max_step_size>0.0005</max_step_size>"
    "<real_time_update_rate>1000</real_time_update_rate><max_contacts>5</max_contacts>"
    "<roboss:accuracy><tolerance>1e-11</tolerance><newton_max>80</newton_max></roboss:accuracy></physics>";

TEST(LoadWorld, TakesTheDefaultPhysicsProfileOrTheOneAskedFor) {
    const TestFolder folder;
    folder.write("world.sdf", std::string("<sdf version='1.9' xmlns:roboss='urn:roboss:1'><world name='w'>") +
                                  kProfiles + "<model name='m'>" + link("a") + "</model></world></sdf>");
    const Loaded fine = folder.load("world.sdf");
    ASSERT_TRUE(fine.world) << fine.text();
    EXPECT_EQ(fine.world->profile, "fine");
    EXPECT_EQ(fine.world->dt_s, 0.0005);
    EXPECT_EQ(fine.world->real_time_factor, 0.5);
    EXPECT_TRUE(fine.find("physics-profile")) << fine.text();
    EXPECT_EQ(fine.diagnostics.count(Severity::kWarning), 0u) << fine.text();
    ASSERT_EQ(fine.world->accuracy.size(), 2u);
    EXPECT_EQ(fine.world->accuracy[0].setting, "high");
    ASSERT_EQ(fine.world->accuracy[1].numbers.size(), 2u);
    EXPECT_EQ(fine.world->accuracy[1].numbers[1].name, "newton_max");
    EXPECT_EQ(fine.world->accuracy[1].numbers[1].value, 80);

    LoadOptions options;
    options.profile = "coarse";
    const Loaded coarse = folder.load("world.sdf", options);
    ASSERT_TRUE(coarse.world) << coarse.text();
    EXPECT_EQ(coarse.world->dt_s, 0.004);
    EXPECT_EQ(coarse.world->real_time_factor, 2);
    EXPECT_TRUE(coarse.find("engine-settings")) << coarse.text();

    options.profile = "finest";
    const Loaded none = folder.load("world.sdf", options);
    ASSERT_TRUE(none.find("no-profile")) << none.text();
    EXPECT_NE(none.find("no-profile")->remedy.find("'fine'"), std::string::npos);
}

TEST(LoadWorld, ReadsWhoMaySleep) {
    const Loaded usual = load_elements("<model name='m'><allow_auto_disable>false</allow_auto_disable>" +
                                       link("a") + "</model><model name='n'>" + link("a") + "</model>");
    ASSERT_TRUE(usual.world) << usual.text();
    EXPECT_TRUE(usual.world->sleep);
    EXPECT_FALSE(usual.world->prototypes[0].may_sleep);
    EXPECT_TRUE(usual.world->prototypes[1].may_sleep);
    const Loaded off =
        load_elements("<roboss:sleep>false</roboss:sleep><model name='n'>" + link("a") + "</model>");
    ASSERT_TRUE(off.world) << off.text();
    EXPECT_FALSE(off.world->sleep);
    EXPECT_TRUE(off.diagnostics.items().empty()) << off.text();
}

TEST(LoadWorld, ReadsThePrecisionOfTheWorldAndOfItsProfile) {
    const std::string in_floats = "<roboss:precision>float</roboss:precision>";
    const std::string model = "<model name='n'>" + link("a") + "</model>";
    const Loaded usual = load_elements(model), world = load_elements(in_floats + model);
    ASSERT_TRUE(usual.world && world.world) << usual.text() << world.text();
    EXPECT_EQ(usual.world->precision, Precision::kDouble);
    EXPECT_EQ(world.world->precision, Precision::kFloat);
    EXPECT_TRUE(world.diagnostics.items().empty()) << world.text();
    const Loaded profile =
        load_elements(in_floats +
                      "<physics name='p' type='ode'><roboss:precision>double</roboss:precision>"
                      "</physics>" +
                      model);
    ASSERT_TRUE(profile.world) << profile.text();
    EXPECT_EQ(profile.world->precision, Precision::kDouble);
    const Loaded wrong = load_elements("<roboss:precision>half</roboss:precision>" + model);
    ASSERT_TRUE(wrong.find("bad-value")) << wrong.text();
}

TEST(LoadWorld, ReadsWindAirAndDrag) {
    const Loaded loaded = load_elements(
        "<wind><linear_velocity>3 0 0</linear_velocity></wind><atmosphere type='adiabatic'><temperature>300"
        "</temperature><pressure>90000</pressure></atmosphere><model "
        "name='m'><enable_wind>true</enable_wind>" +
        link(
            "a",
            "<roboss:drag><coefficient>0.8</coefficient><area>0.1</area><linear>0.2</linear></roboss:drag>") +
        link("b", "<enable_wind>false</enable_wind>") + link("c") + "</model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.diagnostics.count(Severity::kWarning), 0u) << loaded.text();
    EXPECT_EQ(loaded.world->wind, (Vec3{3, 0, 0}));
    EXPECT_NEAR(loaded.world->air_density, 90000 / (287.0578 * 300), 1e-12);
    const auto& links = loaded.world->prototypes[0].links;
    EXPECT_TRUE(links[0].drag.acts && links[0].drag.wind);
    EXPECT_EQ(links[0].drag.coefficient, 0.8);
    EXPECT_EQ(links[0].drag.area, 0.1);
    EXPECT_EQ(links[0].drag.linear, 0.2);
    EXPECT_FALSE(links[1].drag.acts);
    EXPECT_TRUE(links[2].drag.wind);
    EXPECT_LT(links[2].drag.area, 0) << "of its shapes";
}

TEST(LoadWorld, WindThatActsOnNothingIsSaid) {
    const Loaded loaded = load_elements(
        "<wind><linear_velocity>3 0 0</linear_velocity></wind><model name='m'>" + link("a") + "</model>");
    EXPECT_TRUE(loaded.find("wind")) << loaded.text();
}

TEST(LoadWorld, ReadsSoftContacts) {
    const auto spec = [](const std::string& ode) {
        const Loaded loaded = with_surface("<contact><ode>" + ode + "</ode></contact>");
        return loaded.world ? loaded.world->prototypes[0].links[0].collisions[0].surface : SurfaceSpec{};
    };
    EXPECT_EQ(spec("<kp>1e12</kp><kd>5</kd>").stiffness, 0) << "SDFormat's default is rigid";
    EXPECT_EQ(spec("<kp>2e4</kp><kd>50</kd>").stiffness, 2e4);
    EXPECT_EQ(spec("<kp>2e4</kp><kd>50</kd>").damping, 50);
    // ERP and CFM at the default step of 1 ms
    EXPECT_NEAR(spec("<soft_cfm>0.01</soft_cfm><soft_erp>0.25</soft_erp>").stiffness, 25000, 1e-9);
    EXPECT_NEAR(spec("<soft_cfm>0.01</soft_cfm><soft_erp>0.25</soft_erp>").damping, 75, 1e-12);
    EXPECT_EQ(spec("<max_vel>0.1</max_vel><min_depth>0.001</min_depth>").max_vel, 0.1);
    EXPECT_EQ(spec("<max_vel>0.1</max_vel><min_depth>0.001</min_depth>").min_depth, 0.001);
    const Loaded bad = with_surface("<contact><ode><kp>-5</kp></ode></contact>");
    EXPECT_TRUE(bad.find("bad-value")) << bad.text();
    EXPECT_FALSE(with_surface("<contact><ode><kp>1e5</kp><max_vel>0.1</max_vel></ode></contact>")
                     .find("surface-element"));
    const Loaded both = with_surface("<contact><ode><kp>1e5</kp><min_depth>0.1</min_depth></ode></contact>");
    EXPECT_TRUE(both.find("surface-element")) << both.text();
}

TEST(LoadWorld, ReadsWhatTheWorldSays) {
    const Loaded loaded = load_elements(
        "<physics name='slow' type='x'><max_step_size>0.01</max_step_size></physics>"
        "<physics name='used' type='x' "
        "default='true'><max_step_size>0.002</max_step_size><real_time_factor>0.5</real_time_factor></"
        "physics>"
        "<gravity>0 0 -1.6</gravity><magnetic_field>1 2 3</magnetic_field>"
        "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>60</"
        "latitude_deg><longitude_deg>25</longitude_deg>"
        "<elevation>12</elevation><heading_deg>90</heading_deg></spherical_coordinates>"
        "<model name='m'>" +
        link("a") + "</model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const World& world = *loaded.world;
    EXPECT_EQ(world.name, "w");
    EXPECT_EQ(world.dt_s, 0.002);
    EXPECT_EQ(world.real_time_factor, 0.5);
    EXPECT_EQ(world.gravity.z, -1.6);
    EXPECT_EQ(world.magnetic_field_T.y, 2);
    ASSERT_TRUE(world.spherical);
    EXPECT_NEAR(world.spherical->latitude_rad, kPi / 3, 1e-15);
    EXPECT_EQ(world.spherical->elevation_m, 12);
    EXPECT_NEAR(world.spherical->heading_rad, kPi / 2, 1e-15);
}

TEST(LoadWorld, AFileWithAModelOnlyIsAWorld) {
    const Loaded loaded = load_text("<sdf version='1.7'><model name='m'>" + link("a") + "</model></sdf>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.world->name, "m");
    EXPECT_EQ(loaded.world->instances.size(), 1u);
}

TEST(LoadWorld, AStaticModelStaysStaticAndKeepsItsSensors) {
    const std::string laser =
        "<sensor name='s' type='lidar'><lidar><scan><horizontal><samples>3</samples><min_angle>0</min_angle>"
        "<max_angle>1</max_angle></horizontal></scan><range><min>0.1</min><max>9</max></range></lidar></"
        "sensor>";
    const Loaded loaded =
        load_elements("<model name='m'><static>1</static><link name='a'>" + laser + "</link></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.world->prototypes[0].is_static);
    ASSERT_EQ(loaded.world->prototypes[0].links[0].sensors.size(), 1u);
    EXPECT_NE(loaded.world->prototypes[0].links[0].sensors[0].as<LaserSpec>(), nullptr);
}

TEST(LoadWorld, TwoThousandSixWheeledCarsLoadQuickly) {
    std::string car;
    car += link("chassis",
                "<collision name='c'><geometry><box><size>1 .5 .3</size></box></geometry></collision>");
    for (int i = 0; i < 6; ++i) {
        const std::string n = std::to_string(i);
        car += link("wheel" + n,
                    "<collision "
                    "name='c'><geometry><cylinder><radius>.2</radius><length>.1</length></cylinder></"
                    "geometry></collision>") +
               "<joint name='j" + n + "' type='continuous'><parent>chassis</parent><child>wheel" + n +
               "</child><axis><xyz>0 1 0</xyz></axis></joint>";
    }
    std::string cars;
    for (int i = 0; i < 2000; ++i)
        cars += "<model name='car" + std::to_string(i) + "'><pose>" + std::to_string(i) +
                " 0 0 0 0 0</pose>" + car + "</model>\n";
    const auto start = std::chrono::steady_clock::now();
    const Loaded loaded = load_elements(cars);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_EQ(loaded.world->instances.size(), 2000u);
    EXPECT_EQ(loaded.world->prototypes.size(), 1u);
    // libsdformat alone takes a minute; this is far below it even in a debug build with sanitizers.
    EXPECT_LT(took.count(), 10.0);
}

}  // namespace
}  // namespace roboss
