// Sensors: the four that are simulated, with their noise, and the others reported.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss {
namespace {

using namespace sdf_test;

Loaded with_sensor(const std::string& sensor, const std::string& version = "1.9") {
    return load_elements(
        "<model name='m'>" + link("a", sensor) + link("b") +
            "<joint name='j' type='continuous'><parent>a</parent><child>b</child><axis><xyz>0 1 "
            "0</xyz></axis></joint></model>",
        version);
}

const SensorSpec& first(const Loaded& loaded) {
    return loaded.world->prototypes.at(0).links.at(0).sensors.at(0);
}

template <class Kind>
Kind first_as(const Loaded& loaded) {
    const Kind* kind = first(loaded).as<Kind>();
    EXPECT_NE(kind, nullptr) << first(loaded).kind().name;
    return kind == nullptr ? Kind{} : *kind;
}

TEST(Sensors, ALaserHasItsScanRangeAndNoise) {
    for (const std::string type : {"ray", "lidar", "gpu_ray", "gpu_lidar"}) {
        const Loaded loaded = with_sensor(
            "<sensor name='s' type='" + type +
            "'><pose>0 0 0.5 0 0 "
            "0</pose><update_rate>20</update_rate><ray><scan><horizontal><samples>181</samples>"
            "<min_angle>-1.5</min_angle><max_angle>1.5</max_angle></horizontal><vertical><samples>4</"
            "samples><min_angle>-0.1</min_angle>"
            "<max_angle>0.2</max_angle></vertical></scan><range><min>0.2</min><max>30</max><resolution>0.01</"
            "resolution></range>"
            "<noise><type>gaussian</type><mean>0.1</mean><stddev>0.02</stddev></noise></ray></sensor>");
        ASSERT_TRUE(loaded.world) << loaded.text();
        EXPECT_TRUE(loaded.diagnostics.items().empty()) << type << "\n" << loaded.text();
        EXPECT_EQ(first(loaded).sdf_type, type);
        EXPECT_EQ(first(loaded).X_LS.p.z, 0.5);
        EXPECT_EQ(first(loaded).update_rate_hz, 20);
        const LaserSpec s = first_as<LaserSpec>(loaded);
        EXPECT_EQ(s.samples, 181);
        EXPECT_EQ(s.min_angle, -1.5);
        EXPECT_EQ(s.vertical_samples, 4);
        EXPECT_EQ(s.vertical_max_angle, 0.2);
        EXPECT_EQ(s.range_max, 30);
        EXPECT_EQ(s.noise.stddev, 0.02);
        EXPECT_EQ(s.noise.mean, 0.1);
    }
}

TEST(Sensors, AGpsHasFourNoises) {
    const std::string noise = "<noise type='gaussian'><stddev>";
    const Loaded loaded =
        with_sensor("<sensor name='s' type='navsat'><navsat><position_sensing><horizontal>" + noise +
                    "1</stddev></noise></horizontal><vertical>" + noise +
                    "2</stddev></noise></vertical></position_sensing><velocity_sensing><horizontal>" + noise +
                    "3</stddev></noise></horizontal><vertical>" + noise +
                    "4</stddev></noise></vertical></velocity_sensing></navsat></sensor>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const GpsSpec s = first_as<GpsSpec>(loaded);
    EXPECT_EQ(s.position_horizontal_noise.stddev, 1);
    EXPECT_EQ(s.position_vertical_noise.stddev, 2);
    EXPECT_EQ(s.velocity_horizontal_noise.stddev, 3);
    EXPECT_EQ(s.velocity_vertical_noise.stddev, 4);
}

TEST(Sensors, OurOdometerAndGyrocompassAreRead) {
    const Loaded odometer = with_sensor(
        "<roboss:sensor name='o' type='odometer'><joint>j</joint><wheel_radius>0.3</wheel_radius>"
        "<noise type='gaussian'><stddev>0.01</stddev></noise></roboss:sensor>");
    ASSERT_TRUE(odometer.world);
    EXPECT_TRUE(odometer.diagnostics.items().empty()) << odometer.text();
    const OdometerSpec o = first_as<OdometerSpec>(odometer);
    EXPECT_EQ(o.joints, JointNames{"j"});
    EXPECT_EQ(o.wheel_radius, 0.3);
    EXPECT_EQ(o.noise.stddev, 0.01);
    const Loaded compass =
        with_sensor("<roboss:sensor name='g' type='gyrocompass'><pose>0 0 0 0 0 1</pose></roboss:sensor>");
    EXPECT_NE(first(compass).as<CompassSpec>(), nullptr);
}

TEST(Sensors, AnImuHasNoiseForEachAxisAndAReferenceFrame) {
    const Loaded loaded = with_sensor(
        "<sensor name='s' type='imu'><imu><angular_velocity><y><noise type='gaussian'><stddev>0.01</stddev>"
        "</noise></y></angular_velocity><linear_acceleration><z><noise type='gaussian'><mean>0.1</mean>"
        "<bias_mean>0.2</bias_mean><bias_stddev>0.3</bias_stddev></noise></z></linear_acceleration>"
        "<enable_orientation>0</enable_orientation></imu></sensor>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const ImuSpec imu = first_as<ImuSpec>(loaded);
    EXPECT_EQ(imu.angular_velocity_x, NoiseSpec{});
    EXPECT_EQ(imu.angular_velocity_y.stddev, 0.01);
    EXPECT_EQ(imu.linear_acceleration_z, (NoiseSpec{0.1, 0, 0.2, 0.3, 0}));
    EXPECT_FALSE(imu.enable_orientation);
    const Loaded oriented = with_sensor(
        "<sensor name='s' type='imu'><imu><orientation_reference_frame><localization>GRAV_UP</localization>"
        "<custom_rpy parent_frame='world'>0.1 0.2 0.3</custom_rpy><grav_dir_x parent_frame='a'>0 1 "
        "0</grav_dir_x>"
        "</orientation_reference_frame></imu></sensor>");
    EXPECT_TRUE(oriented.diagnostics.items().empty()) << oriented.text();
    const auto frame = first_as<ImuSpec>(oriented);
    EXPECT_EQ(frame.localization, "GRAV_UP");
    EXPECT_EQ(frame.custom_rpy, (Vec3{0.1, 0.2, 0.3}));
    EXPECT_EQ(frame.custom_rpy_frame, "world");
    EXPECT_EQ(frame.gravity_x, (Vec3{0, 1, 0}));
    EXPECT_EQ(frame.gravity_x_frame, "a");
    EXPECT_TRUE(with_sensor("<sensor name='s' type='imu'/>").diagnostics.items().empty());
}

TEST(Sensors, AForceTorqueSensorStandsInItsJoint) {
    const Loaded loaded = load_elements(
        "<model name='m'>" + link("a") + link("b") +
        "<joint name='j' type='revolute'><pose>0 0 0.5 0 0 0</pose><parent>a</parent><child>b</child>"
        "<axis><xyz>0 1 0</xyz></axis><sensor name='ft' type='force_torque'><pose>0.1 0 0 0 0 0</pose>"
        "<force_torque><frame>sensor</frame><measure_direction>parent_to_child</measure_direction>"
        "<torque><y><noise type='gaussian'><stddev>0.5</stddev></noise></y></torque></force_torque>"
        "</sensor></joint></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    const LinkSpec& b = loaded.world->prototypes.at(0).links.at(1);
    ASSERT_EQ(b.sensors.size(), 1u);
    EXPECT_EQ(b.sensors[0].X_LS.p, (Vec3{0.1, 0, 0.5}));
    ForceTorqueSpec expected;
    expected.joint = "j", expected.frame = "sensor", expected.measure_direction = "parent_to_child";
    expected.torque_y.stddev = 0.5;
    ASSERT_NE(b.sensors[0].as<ForceTorqueSpec>(), nullptr);
    EXPECT_EQ(*b.sensors[0].as<ForceTorqueSpec>(), expected);
}

TEST(Sensors, AnOdometerOfAJointThatIsNotThereIsAnError) {
    EXPECT_NE(with_sensor("<roboss:sensor name='o' type='odometer'><joint>k</joint></roboss:sensor>")
                  .find("unknown-joint"),
              nullptr);
    EXPECT_NE(with_sensor("<roboss:sensor name='o' type='odometer'/>").find("bad-sensor"), nullptr);
    EXPECT_NE(with_sensor("<roboss:sensor name='o' type='nose'/>").find("sensor"), nullptr);
}

TEST(Sensors, OthersAreKeptAndReportedOnceAKind) {
    const Loaded loaded = with_sensor(
        "<sensor name='c1' type='rfid'/><sensor name='c2' type='rfid'/>"
        "<sensor name='i' type='wireless_receiver'/>"
        "<sensor name='n' type='wireless_transmitter'/>");
    ASSERT_TRUE(loaded.world);
    EXPECT_FALSE(loaded.diagnostics.has_errors()) << loaded.text();
    EXPECT_EQ(loaded.diagnostics.items().size(), 3u) << loaded.text();
    EXPECT_FALSE(first(loaded).measures());
    EXPECT_EQ(first(loaded).sdf_type, "rfid");
}

TEST(Sensors, TheCamerasOfAMulticameraAreSensorsOfTheirOwn) {
    const Loaded loaded = with_sensor(
        "<sensor name='stereo' type='multicamera'><pose>0 0 1 0 0 0</pose><update_rate>15</update_rate>"
        "<camera name='left'><pose>0 0.1 0 0 0 0</pose><image><width>32</width><height>24</height></image>"
        "<noise><type>gaussian</type><stddev>0.1</stddev></noise></camera>"
        "<camera name='right'><pose>0 -0.1 0 0 0 0</pose><horizontal_fov>1.5</horizontal_fov>"
        "<visibility_mask>0x06</visibility_mask></camera></sensor>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const std::vector<SensorSpec>& sensors = loaded.world->prototypes.at(0).links.at(0).sensors;
    ASSERT_EQ(sensors.size(), 2u);
    EXPECT_EQ(sensors[0].name, "stereo/left");
    EXPECT_EQ(sensors[1].name, "stereo/right");
    EXPECT_EQ(sensors[1].X_LS.p.z, 1);
    EXPECT_EQ(sensors[1].update_rate_hz, 15);
    ASSERT_NE(sensors[0].as<ColorCameraSpec>(), nullptr);
    EXPECT_EQ(sensors[0].as<ColorCameraSpec>()->optics.width, 32);
    EXPECT_EQ(sensors[0].as<ColorCameraSpec>()->optics.X_SC.p.y, 0.1);
    EXPECT_EQ(sensors[0].as<ColorCameraSpec>()->noise.stddev, 0.1);
    EXPECT_EQ(sensors[1].as<ColorCameraSpec>()->optics.horizontal_fov, 1.5);
    EXPECT_EQ(sensors[1].as<ColorCameraSpec>()->optics.visibility_mask, 6);
    const Loaded empty = with_sensor("<sensor name='none' type='multicamera'/>");
    EXPECT_NE(empty.find("sensor"), nullptr);
    EXPECT_FALSE(first(empty).measures());
}

TEST(Sensors, AForceTorqueSensorInALinkMeasuresTheJointThatHoldsIt) {
    const std::string sensor = "<sensor name='ft' type='force_torque'/>";
    const Loaded held =
        load_elements("<model name='m'>" + link("a") + link("b", sensor) +
                      "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 1 "
                      "0</xyz></axis></joint>"
                      "</model>");
    ASSERT_TRUE(held.world) << held.text();
    EXPECT_TRUE(held.diagnostics.items().empty()) << held.text();
    ASSERT_NE(held.world->prototypes.at(0).links.at(1).sensors.at(0).as<ForceTorqueSpec>(), nullptr);
    EXPECT_EQ(held.world->prototypes.at(0).links.at(1).sensors.at(0).as<ForceTorqueSpec>()->joint, "j");
    const Loaded loose = with_sensor(sensor);
    EXPECT_NE(loose.find("joint-sensor"), nullptr) << loose.text();
    EXPECT_FALSE(loose.diagnostics.has_errors()) << loose.text();
    EXPECT_FALSE(first(loose).measures());
}

TEST(Sensors, OurJointEffortAndInfraredSensorsAreRead) {
    const auto effort = first_as<JointEffortSpec>(
        with_sensor("<roboss:sensor name='e' type='joint_effort'><joint>j</joint><noise "
                    "type='gaussian'><stddev>0.5</stddev>"
                    "</noise></roboss:sensor>"));
    EXPECT_EQ(effort.joints, JointNames{"j"});
    EXPECT_EQ(effort.noise.stddev, 0.5);
    const auto infrared = first_as<InfraredSpec>(with_sensor(
        "<roboss:sensor name='ir' type='infrared'><max>0.1</max><opening_angle>0.3</opening_angle>"
        "<response>khepera</response></roboss:sensor>"));
    EXPECT_EQ(infrared.range_max, 0.1);
    EXPECT_EQ(infrared.opening_angle, 0.3);
    EXPECT_EQ(infrared.response, "khepera");
}

TEST(Sensors, ALaserMayHaveBeamsAtAnglesOfItsOwn) {
    const std::string before =
        "<sensor name='s' type='lidar'><lidar><scan><horizontal><samples>4</samples>"
        "<min_angle>-1</min_angle><max_angle>1</max_angle></horizontal><vertical>";
    const std::string after = "</vertical></scan><range><min>0.1</min><max>9</max></range></lidar></sensor>";
    const Loaded loaded = with_sensor(before + "<roboss:angles>-0.43 -0.1 0 0.02</roboss:angles>" + after);
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const auto laser = first_as<LaserSpec>(loaded);
    EXPECT_EQ(laser.vertical_angles, (std::vector<double>{-0.43, -0.1, 0, 0.02}));
    EXPECT_EQ(laser.rows(), 4);
    EXPECT_EQ(laser.columns(), 4);
    EXPECT_NE(with_sensor(before + "<roboss:angles>0 -1</roboss:angles>" + after).find("bad-sensor"),
              nullptr);
    EXPECT_NE(with_sensor(before + "<roboss:angles>0 up</roboss:angles>" + after).find("bad-value"), nullptr);
}

TEST(Sensors, ShapesHaveTheIntensityThatTheFileGivesThemOrTheirVisuals) {
    const std::string box = "<geometry><box><size>1 1 1</size></box></geometry>";
    const auto retros = [&](const std::string& parts) {
        const Loaded loaded = with_sensor(parts);
        EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
        std::vector<double> all;
        for (const CollisionSpec& c : loaded.world->prototypes.at(0).links.at(0).collisions)
            if (c.name == "one" || c.name == "two") all.push_back(c.laser_retro);
        return all;
    };
    const auto collision = [&](const std::string& name, const std::string& retro) {
        return "<collision name='" + name + "'>" + box + retro + "</collision>";
    };
    const std::string visual = "<visual name='two'>" + box + "<laser_retro>7</laser_retro></visual>";
    const std::string other = "<visual name='other'>" + box + "<laser_retro>5</laser_retro></visual>";
    EXPECT_EQ(retros(collision("one", "<laser_retro>2</laser_retro>") + collision("two", "")),
              (std::vector<double>{2, 0}));
    EXPECT_EQ(
        retros(collision("one", "<laser_retro>2</laser_retro>") + collision("two", "") + other + visual),
        (std::vector<double>{2, 7}));
    EXPECT_EQ(retros(collision("one", "") + collision("two", "") + other), (std::vector<double>{5, 5}));
}

TEST(Sensors, ALogicalCameraHasItsFrustumAndTheSceneryOfTheWorld) {
    const Loaded loaded = load_elements(
        "<model name='m'>" +
        link("a",
             "<sensor name='eye' type='logical_camera'><update_rate>10</update_rate><logical_camera>"
             "<near>0.5</near><far>7</far><horizontal_fov>1.2</horizontal_fov><aspect_ratio>2</aspect_ratio>"
             "</logical_camera></sensor>") +
        "</model><model name='wall'><static>true</static><pose>3 1 0 0 0 0</pose><link name='l'/></model>"
        "<model name='mast'><static>true</static>" +
        link("l", "<sensor name='i' type='imu'/>") + "</model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_TRUE(loaded.diagnostics.items().empty()) << loaded.text();
    const auto camera = first_as<LogicalCameraSpec>(loaded);
    EXPECT_EQ(camera.near, 0.5);
    EXPECT_EQ(camera.far, 7);
    EXPECT_EQ(camera.horizontal_fov, 1.2);
    EXPECT_EQ(camera.aspect_ratio, 2);
    EXPECT_EQ(camera.scenery, (std::vector<std::string>{"wall"}))
        << "the mast carries a sensor: it is a robot";
    EXPECT_EQ(camera.scenery_poses, (std::vector<double>{3, 1, 0, 1, 0, 0, 0}));
}

TEST(Sensors, ALogicalCameraWithoutItsElementMeasuresNothing) {
    const Loaded loaded = with_sensor("<sensor name='eye' type='logical_camera'/>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_NE(loaded.find("sensor"), nullptr);
    EXPECT_FALSE(first(loaded).measures());
}

TEST(Sensors, ABarometerAndAnAirSpeedSensorHaveTheirNoise) {
    const std::string noise = "<pressure><noise type='gaussian'><stddev>0.25</stddev></noise></pressure>";
    const auto barometer = first_as<AirPressureSpec>(
        with_sensor("<sensor name='b' type='air_pressure'><air_pressure><reference_altitude>123"
                    "</reference_altitude>" +
                    noise + "</air_pressure></sensor>"));
    EXPECT_EQ(barometer.reference_altitude, 123);
    EXPECT_EQ(barometer.noise.stddev, 0.25);
    const auto tube = first_as<AirSpeedSpec>(
        with_sensor("<sensor name='t' type='air_speed'><air_speed>" + noise + "</air_speed></sensor>"));
    EXPECT_EQ(tube.noise.stddev, 0.25);
}

TEST(Sensors, ALaserThatSeesNothingIsAnError) {
    const Loaded loaded = with_sensor(
        "<sensor name='s' type='lidar'><lidar><scan><horizontal><samples>0</samples></horizontal></scan>"
        "<range><min>5</min><max>1</max></range></lidar></sensor>");
    EXPECT_EQ(loaded.diagnostics.count(Severity::kError), 2u) << loaded.text();
}

}  // namespace
}  // namespace roboss
