// Plugins that publish become sensors of their model.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

const std::string kTwoLinks =
    "<link name='a'><pose>0 0 1 0 0 0</pose></link><link name='b'/>"
    "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>"
    "<joint name='k' type='fixed'><parent>b</parent><child>c</child></joint><link name='c'/>";

std::string plugin(const std::string& name, const std::string& children) {
    return "<plugin name='gz::sim::systems::" + name + "' filename='x'>" + children + "</plugin>";
}

Loaded model_with(const std::string& plugins) {
    return load_elements("<model name='m'>" + kTwoLinks + plugins + "</model>");
}

/// All sensors of the first model.
std::vector<SensorSpec> sensors_of(const Loaded& loaded) {
    std::vector<SensorSpec> sensors;
    if (!loaded.world) return sensors;
    for (const LinkSpec& link : loaded.world->prototypes.at(0).links)
        sensors.insert(sensors.end(), link.sensors.begin(), link.sensors.end());
    return sensors;
}

TEST(PluginSensors, TakeNameRateAndParametersFromThePlugin) {
    const Loaded loaded =
        model_with(plugin("OdometryPublisher",
                          "<odom_topic>/model/m/odom</odom_topic><dimensions>3</dimensions>"
                          "<odom_publish_frequency>10</odom_publish_frequency>"
                          "<gaussian_noise>0.1</gaussian_noise><xyz_offset>1 2 3</xyz_offset>"));
    const auto sensors = sensors_of(loaded);
    ASSERT_EQ(sensors.size(), 1u) << loaded.text();
    EXPECT_EQ(sensors[0].name, "odom");
    EXPECT_EQ(sensors[0].update_rate_hz, 10);
    EXPECT_EQ(sensors[0].X_LS.p.z, -1);  // the model's frame in the canonical link
    const auto* spec = sensors[0].as<OdometrySpec>();
    ASSERT_NE(spec, nullptr);
    EXPECT_EQ(spec->dimensions, 3);
    EXPECT_EQ(spec->gaussian_noise, 0.1);
    EXPECT_EQ(spec->xyz_offset, (Vec3{1, 2, 3}));
    EXPECT_EQ(loaded.world->prototypes[0].extensions.at(0).fate, PluginFate::kRuns);
    EXPECT_EQ(loaded.find("plugin"), nullptr) << loaded.text();
}

TEST(PluginSensors, HaveGazebosDefaults) {
    const auto sensors = sensors_of(model_with(plugin("OdometryPublisher", "") + plugin("PosePublisher", "") +
                                               plugin("JointStatePublisher", "")));
    ASSERT_EQ(sensors.size(), 3u);
    EXPECT_EQ(sensors[0].name, "odometry");
    EXPECT_EQ(sensors[0].update_rate_hz, 50);
    EXPECT_EQ(sensors[1].name, "pose");
    EXPECT_EQ(sensors[1].update_rate_hz, 0);
    EXPECT_EQ(sensors[2].name, "joint_state");
}

TEST(PluginSensors, OfClassicGazeboNameALinkOrAListOfJoints) {
    const Loaded loaded = model_with(
        "<plugin name='truth' filename='libgazebo_ros_p3d.so'><bodyName>b</bodyName>"
        "<updateRate>20</updateRate><topicName>truth</topicName></plugin>"
        "<plugin name='js' filename='libgazebo_ros_joint_state_publisher.so'>"
        "<jointName>j, k</jointName></plugin>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const LinkSpec& b = loaded.world->prototypes[0].links[1];
    ASSERT_EQ(b.sensors.size(), 1u);
    EXPECT_EQ(b.sensors[0].name, "truth");
    EXPECT_EQ(b.sensors[0].update_rate_hz, 20);
    EXPECT_TRUE(b.sensors[0].as<OdometrySpec>()->world_axes);
    const auto* joints = loaded.world->prototypes[0].links[0].sensors.at(0).as<JointStatesSpec>();
    ASSERT_NE(joints, nullptr);
    EXPECT_EQ(joints->joints, (std::vector<std::string>{"j", "k"}));
}

TEST(PluginSensors, OfControllersCountThoseOfTheirKind) {
    const std::string cell = "<voltage>12</voltage><capacity>1</capacity>";
    const auto sensors =
        sensors_of(model_with(plugin("LinearBatteryPlugin", "<battery_name>one</battery_name>" + cell) +
                              plugin("JointController", "<joint_name>j</joint_name>") +
                              plugin("LinearBatteryPlugin", "<battery_name>broken</battery_name>") +
                              plugin("LinearBatteryPlugin", "<battery_name>two</battery_name>" + cell)));
    ASSERT_EQ(sensors.size(), 2u);
    EXPECT_EQ(sensors[0].name, "one");
    EXPECT_EQ(sensors[1].name, "two");
    EXPECT_EQ(sensors[1].as<BatterySensorSpec>()->controller, 1);
}

TEST(PluginSensors, WithOneNameAreCounted) {
    const auto sensors = sensors_of(model_with(plugin("PosePublisher", "") + plugin("PosePublisher", "")));
    ASSERT_EQ(sensors.size(), 2u);
    EXPECT_EQ(sensors[1].name, "pose_2");
}

TEST(PluginSensors, ThatMakeNoSenseAreReportedAndTheModelStays) {
    const Loaded loaded = model_with(plugin("OdometryPublisher", "<dimensions>4</dimensions>") +
                                     plugin("OdometryPublisher", "<tf_topic>/tf</tf_topic>") +
                                     "<plugin name='truth' filename='libgazebo_ros_p3d.so'>"
                                     "<body_name>nobody</body_name></plugin>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_EQ(sensors_of(loaded).size(), 1u);
    EXPECT_NE(loaded.find("bad-sensor"), nullptr);
    EXPECT_NE(loaded.find("ignored-element"), nullptr);
    EXPECT_NE(loaded.find("plugin-not-run"), nullptr);
}

const std::string kSource =
    "<source><id>3</id><pose>1 0 0 0 0 0</pose><attenuation_function> linear</attenuation_function>"
    "<attenuation_shape>sphere</attenuation_shape><inner_radius>1</inner_radius>"
    "<falloff_distance>5</falloff_distance><volume_level>.8</volume_level><playing>true</playing>"
    "<play_duration>10</play_duration></source>";

TEST(LogicalAudio, MicrophonesAreSensorsAndSourcesAController) {
    const Loaded loaded = model_with(plugin(
        "LogicalAudioSensorPlugin",
        kSource + "<microphone><id>1</id><pose>0 .5 0 0 0 0</pose><volume_threshold>.4</volume_threshold>"
                  "</microphone><microphone><id>2</id></microphone>"));
    const auto sensors = sensors_of(loaded);
    ASSERT_EQ(sensors.size(), 2u) << loaded.text();
    EXPECT_EQ(sensors[0].name, "mic_1");
    EXPECT_EQ(sensors[0].X_LS.p, (Vec3{0, 0.5, -1}));  // the canonical link is 1 m above the model's frame
    EXPECT_EQ(sensors[0].as<MicrophoneSpec>()->volume_threshold, 0.4);
    EXPECT_EQ(sensors[1].name, "mic_2");
    EXPECT_EQ(sensors[1].as<MicrophoneSpec>()->volume_threshold, 0);
    const auto& onboard = loaded.world->prototypes[0].onboard;
    ASSERT_EQ(onboard.size(), 1u);
    const auto& source = std::get<AudioSourceSpec>(onboard[0].parameters).sources.at(0);
    EXPECT_EQ(source.X_RS.p.x, 1);
    EXPECT_EQ(source.falloff_distance, 5);
    EXPECT_EQ(source.play_duration, 10);
    EXPECT_TRUE(source.playing);
    EXPECT_EQ(channels_of(onboard[0].parameters).at(1).topic, "/model/{model}/sensor/source_3/stop");
}

TEST(LogicalAudio, AMicrophoneNeedsNoSourceAndASourceNeedsAllItsElements) {
    const Loaded listener =
        model_with(plugin("LogicalAudioSensorPlugin", "<microphone><id>1</id></microphone>"));
    ASSERT_TRUE(listener.world) << listener.text();
    EXPECT_TRUE(listener.world->prototypes[0].onboard.empty());
    EXPECT_EQ(listener.world->prototypes[0].extensions.at(0).fate, PluginFate::kRuns);
    const Loaded broken = model_with(plugin("LogicalAudioSensorPlugin", "<source><id>1</id></source>"));
    EXPECT_NE(broken.find("plugin-not-run"), nullptr);
    EXPECT_TRUE(sensors_of(model_with(plugin("LogicalAudioSensorPlugin", "<microphone/>"))).empty());
}

TEST(PluginControllers, OfJointsTakeAllOfTheModelWhereNoneIsNamed) {
    const Loaded loaded =
        model_with(plugin("JointTrajectoryController", "<position_p_gain>3</position_p_gain>"));
    ASSERT_TRUE(loaded.world) << loaded.text();
    const auto& onboard = loaded.world->prototypes[0].onboard;
    ASSERT_EQ(onboard.size(), 1u) << loaded.text();
    const auto& spec = std::get<JointTrajectoryControllerSpec>(onboard[0].parameters);
    EXPECT_EQ(spec.joints, (JointNames{"j"}));
    EXPECT_EQ(spec.position.of(0).p, 3);
    EXPECT_EQ(spec.position.of(1).p, 0);
    ASSERT_EQ(spec.channels()[0].values.size(), 4u);
    EXPECT_EQ(spec.channels()[0].values[1].name, "position/j");
}

TEST(PluginControllers, OfJointsReadTheirParameters) {
    const Loaded loaded = model_with(
        plugin("JointPositionController",
               "<joint_name>j</joint_name><topic>rotor_cmd</topic><p_gain>2</p_gain><cmd_max>7</cmd_max>"
               "<use_velocity_commands>true</use_velocity_commands>") +
        plugin("JointPositionController", "<joint_name>j</joint_name><joint_index>1</joint_index>") +
        plugin("JointController", "<joint_name>j</joint_name><sub_topic>spin</sub_topic>"));
    ASSERT_TRUE(loaded.world) << loaded.text();
    const auto& onboard = loaded.world->prototypes[0].onboard;
    ASSERT_EQ(onboard.size(), 2u) << loaded.text();
    const auto& spec = std::get<JointPositionControllerSpec>(onboard[0].parameters);
    EXPECT_EQ(spec.pid.p, 2);
    EXPECT_EQ(spec.pid.i, 0.1);
    EXPECT_EQ(spec.pid.cmd_max, 7);
    EXPECT_TRUE(spec.use_velocity_commands);
    EXPECT_EQ(spec.channels()[0].name, "rotor_cmd");
    const Channel spin = channels_of(onboard[1].parameters).at(0);
    EXPECT_EQ(spin.name, "spin");
    EXPECT_EQ(spin.topic, "/model/{model}/spin");
}

}  // namespace
}  // namespace roboss
