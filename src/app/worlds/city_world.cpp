// Writes plain text instead of a tree of XML nodes, which keeps it fast: ten thousand cars take 40 MB.
#include "app/worlds/city_world.h"

#include <fmt/format.h>

#include <iterator>

#include "app/text.h"

namespace roboss {
namespace {

// The numbers of the car below: chassis box of 5 kg, wheels of 0.3 kg, inertias of the solid box and
// cylinders. A motor of 0.8 N m can just skid its wheel sideways (grip 0.9 * 15 N * 0.05 m = 0.68 N m), so
// the car can turn on the spot.
constexpr const char* kChassis = R"(      <link name="chassis">
        <pose>0 0 0.08 0 0 0</pose>
        <inertial>
          <mass>5</mass>
          <inertia><ixx>0.0208333</ixx><iyy>0.0708333</iyy><izz>0.0833333</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>
        </inertial>
        <collision name="body">
          <geometry><box><size>0.4 0.2 0.1</size></box></geometry>
          <surface><friction><ode><mu>0.4</mu><mu2>0.4</mu2></ode></friction></surface>
        </collision>
        <visual name="body">
          <geometry><box><size>0.4 0.2 0.1</size></box></geometry>
          <material><diffuse>0.90 0.38 0.12 1</diffuse></material>
        </visual>
        <sensor name="laser" type="lidar">
          <pose>0.205 0 0.02 0 0 0</pose>
          <update_rate>20</update_rate>
          <lidar>
            <scan>
              <horizontal>
                <samples>21</samples><resolution>1</resolution>
                <min_angle>-1.5707963</min_angle><max_angle>1.5707963</max_angle>
              </horizontal>
            </scan>
            <range><min>0.02</min><max>6</max><resolution>0.001</resolution></range>
            <noise><type>gaussian</type><mean>0</mean><stddev>0.01</stddev></noise>
          </lidar>
        </sensor>
        <sensor name="gps" type="navsat">
          <update_rate>20</update_rate>
          <navsat>
            <position_sensing>
              <horizontal><noise type="gaussian"><mean>0</mean><stddev>0.05</stddev></noise></horizontal>
              <vertical><noise type="gaussian"><mean>0</mean><stddev>0.1</stddev></noise></vertical>
            </position_sensing>
            <velocity_sensing>
              <horizontal><noise type="gaussian"><mean>0</mean><stddev>0.02</stddev></noise></horizontal>
              <vertical><noise type="gaussian"><mean>0</mean><stddev>0.02</stddev></noise></vertical>
            </velocity_sensing>
          </navsat>
        </sensor>
        <roboss:sensor name="compass" type="gyrocompass">
          <update_rate>20</update_rate>
          <noise type="gaussian"><mean>0</mean><stddev>0.01</stddev></noise>
        </roboss:sensor>
        <roboss:sensor name="odometer" type="odometer">
          <update_rate>20</update_rate>
          <joint>front_left</joint><joint>front_right</joint><joint>rear_left</joint><joint>rear_right</joint>
          <wheel_radius>0.05</wheel_radius>
          <noise type="gaussian"><mean>0</mean><stddev>0.01</stddev></noise>
        </roboss:sensor>
      </link>
)";

constexpr const char* kWheel = R"(      <link name="{0}_wheel">
        <pose>{1} {2} 0.05 0 0 0</pose>
        <inertial>
          <mass>0.3</mass>
          <inertia><ixx>0.0002275</ixx><iyy>0.000375</iyy><izz>0.0002275</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>
        </inertial>
        <collision name="tyre">
          <pose>0 0 0 1.5707963 0 0</pose>
          <geometry><cylinder><radius>0.05</radius><length>0.04</length></cylinder></geometry>
          <surface><friction><ode><mu>0.9</mu><mu2>0.9</mu2></ode></friction></surface>
        </collision>
        <visual name="tyre">
          <pose>0 0 0 1.5707963 0 0</pose>
          <geometry><cylinder><radius>0.05</radius><length>0.04</length></cylinder></geometry>
          <material><diffuse>0.12 0.12 0.13 1</diffuse></material>
        </visual>
      </link>
      <joint name="{0}" type="continuous">
        <parent>chassis</parent>
        <child>{0}_wheel</child>
        <axis>
          <xyz>0 1 0</xyz>
          <limit><effort>0.8</effort><velocity>40</velocity></limit>
        </axis>
      </joint>
)";

/// The text between <model ...><pose/> and </model>, the same for every car.
std::string car_body() {
    Text text;
    add(text, "{}", kChassis);
    struct Wheel {
        const char* name;
        double x, y;
    };
    for (const Wheel& wheel : {Wheel{"front_left", 0.15, 0.13}, Wheel{"front_right", 0.15, -0.13},
                               Wheel{"rear_left", -0.15, 0.13}, Wheel{"rear_right", -0.15, -0.13}})
        fmt::format_to(std::back_inserter(text), fmt::runtime(kWheel), wheel.name, wheel.x, wheel.y);
    return fmt::to_string(text);
}

void add_head(Text& text, const CityOptions& options, const CityPlan& plan) {
    add(text, R"(<?xml version="1.0"?>
<!-- A small city with {0} cars. Made by: roboss-world city, cars {0}, seed {1}. Change the generator, not this file. -->
<sdf version="1.9" xmlns:roboss="https://roboss.org/sdf">
  <world name="city">
    <physics name="step" type="ignored">
      <max_step_size>0.002</max_step_size>
      <real_time_factor>1</real_time_factor>
    </physics>
    <gravity>0 0 -9.8</gravity>
    <spherical_coordinates>
      <surface_model>EARTH_WGS84</surface_model>
      <world_frame_orientation>ENU</world_frame_orientation>
      <latitude_deg>52.2197</latitude_deg>
      <longitude_deg>21.0121</longitude_deg>
      <elevation>113</elevation>
      <heading_deg>0</heading_deg>
    </spherical_coordinates>
    <model name="ground">
      <static>true</static>
      <link name="link">
        <collision name="plane">
          <geometry><plane><normal>0 0 1</normal><size>{2:.0f} {3:.0f}</size></plane></geometry>
          <surface><friction><ode><mu>1</mu><mu2>1</mu2></ode></friction></surface>
        </collision>
        <visual name="plane">
          <geometry><plane><normal>0 0 1</normal><size>{2:.0f} {3:.0f}</size></plane></geometry>
          <material><diffuse>0.42 0.43 0.44 1</diffuse></material>
        </visual>
      </link>
    </model>
)",
        options.cars, options.seed, plan.width + 20, plan.depth + 20);
}

std::string geometry_of(const CitySolid& solid) {
    if (solid.radius > 0)
        return fmt::format("<cylinder><radius>{:.2f}</radius><length>{:.2f}</length></cylinder>",
                           solid.radius, solid.height);
    return fmt::format("<box><size>{:.2f} {:.2f} {:.2f}</size></box>", solid.length, solid.width,
                       solid.height);
}

void add_group(Text& text, const CityGroup& group) {
    add(text, "    <model name=\"{}\">\n      <static>true</static>\n      <link name=\"link\">\n",
        group.name);
    for (std::size_t i = 0; i < group.solids.size(); ++i) {
        const CitySolid& solid = group.solids[i];
        const std::string pose = fmt::format("<pose>{:.2f} {:.2f} {:.3f} 0 0 {:.4f}</pose>", solid.x, solid.y,
                                             0.5 * solid.height, solid.yaw);
        const std::string geometry = geometry_of(solid);
        add(text, "        <collision name=\"part_{}\">{}<geometry>{}</geometry></collision>\n", i, pose,
            geometry);
        add(text, "        <visual name=\"part_{}\">{}<geometry>{}</geometry>", i, pose, geometry);
        add(text, "<material><diffuse>{} 1</diffuse></material></visual>\n", solid.colour);
    }
    add(text, "      </link>\n    </model>\n");
}

}  // namespace

std::string city_sdf(const CityOptions& options) {
    const CityPlan plan = plan_city(options);
    const std::string body = car_body();
    Text text;
    add_head(text, options, plan);
    for (const CityGroup& group : plan.groups) add_group(text, group);
    for (std::size_t i = 0; i < plan.cars.size(); ++i) {
        const CarPlace& car = plan.cars[i];
        add(text, "    <model name=\"car_{}\">\n      <pose>{:.2f} {:.2f} 0 0 0 {:.4f}</pose>\n", i, car.x,
            car.y, car.yaw);
        add(text, "{}    </model>\n", body);
    }
    add(text, "  </world>\n</sdf>\n");
    return fmt::to_string(text);
}

}  // namespace roboss
