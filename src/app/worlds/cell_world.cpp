// Plain text, as the other generators write it.
#include "app/worlds/cell_world.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "app/text.h"
#include "app/worlds/cell_layout.h"
#include "core/fixed_math.h"

namespace roboss {
namespace {

using namespace arm_cell;

constexpr const char *kSteel = "0.62 0.64 0.66", *kDark = "0.16 0.17 0.19", *kOrange = "0.95 0.50 0.10",
                     *kRubber = "0.10 0.10 0.11", *kCardboard = "0.76 0.58 0.36", *kYellow = "0.90 0.75 0.15";

/// A box (size along x, y, z) or an upright cylinder (diameter, 0, length), its middle in the link's frame.
struct Part {
    std::string_view name;
    Place at;
    double x = 0, y = 0, z = 0;

    bool is_cylinder() const { return y == 0; }
};

std::string geometry(const Part& part) {
    const std::string pose =
        fmt::format("<pose>{:.4f} {:.4f} {:.4f} 0 0 0</pose>", part.at.x, part.at.y, part.at.z);
    return part.is_cylinder()
               ? fmt::format(
                     "{}<geometry><cylinder><radius>{:.4f}</radius><length>{:.4f}</length></cylinder></"
                     "geometry>",
                     pose, part.x / 2, part.z)
               : fmt::format("{}<geometry><box><size>{:.4f} {:.4f} {:.4f}</size></box></geometry>", pose,
                             part.x, part.y, part.z);
}

void add_visual(Text& text, const Part& part, std::string_view colour) {
    add(text, "        <visual name=\"{}\">{}<material><diffuse>{} 1</diffuse></material></visual>\n",
        part.name, geometry(part), colour);
}

/// `patch`: radius of the patch with which a soft surface touches, m: it resists turns about the normal; 0 in
/// a box, which leaves that to the pad; negative: no such friction.
void add_solid(Text& text, const Part& part, std::string_view colour, double friction, double patch = -1) {
    const std::string torsional =
        patch < 0 ? std::string()
                  : fmt::format(
                        "<torsional><coefficient>{}</coefficient><patch_radius>{}</patch_radius></torsional>",
                        friction, patch);
    add(text,
        "        <collision name=\"{0}\">{1}<surface><friction><ode><mu>{2}</mu><mu2>{2}</mu2></ode>{3}"
        "</friction></surface></collision>\n",
        part.name, geometry(part), friction, torsional);
    add_visual(text, part, colour);
}

/// Mass and inertia of a solid part.
void add_inertial(Text& text, const Part& part, double mass) {
    const double xx = part.x * part.x, yy = part.is_cylinder() ? xx : part.y * part.y, zz = part.z * part.z;
    const double across = part.is_cylinder() ? mass * (xx / 16 + zz / 12) : 0;
    const double ixx = part.is_cylinder() ? across : mass * (yy + zz) / 12;
    const double iyy = part.is_cylinder() ? across : mass * (xx + zz) / 12;
    const double izz = part.is_cylinder() ? mass * xx / 8 : mass * (xx + yy) / 12;
    add(text,
        "        <inertial><pose>{:.4f} {:.4f} {:.4f} 0 0 0</pose><mass>{}</mass><inertia><ixx>{:.4e}</ixx>"
        "<iyy>{:.4e}</iyy><izz>{:.4e}</izz></inertia></inertial>\n",
        part.at.x, part.at.y, part.at.z, mass, ixx, iyy, izz);
}

void add_head(Text& text, const CellOptions& options) {
    add(text, R"(<?xml version="1.0"?>
<!-- An arm between two conveyors, cells: {0}, gripper: {1} (docs/arm-cell.md). Made by: roboss-world cells. Change the generator, not this file. -->
<sdf version="1.11" xmlns:roboss="https://roboss.org/sdf">
  <world name="cells">
    <physics name="step" type="ignored"><max_step_size>0.002</max_step_size><real_time_factor>1</real_time_factor></physics>
    <gravity>0 0 -9.81</gravity>
    <model name="hall">
      <static>true</static>
      <link name="link">
        <collision name="floor"><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry></collision>
        <visual name="floor"><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry><material><diffuse>0.55 0.57 0.60 1</diffuse></material></visual>
      </link>
    </model>
)",
        options.cells, options.gripper);
}

void add_belt_body(Text& text, double begin, double end) {
    const double middle = (begin + end) / 2, length = end - begin, legs = kBeltTop - 0.08;
    add_solid(text, {"belt", {middle, 0, kBeltTop - 0.04}, length, kBeltWidth, 0.08}, kRubber, 0.8);
    for (const double side : {-1.0, 1.0})
        add_visual(text,
                   {side < 0 ? "right_rail" : "left_rail",
                    {middle, side * (kBeltWidth / 2 + 0.01), kBeltTop - 0.045},
                    length,
                    0.02,
                    0.09},
                   kSteel);
    for (const bool last : {false, true})
        add_visual(text,
                   {last ? "last_leg" : "first_leg",
                    {last ? end - 0.1 : begin + 0.1, 0, legs / 2},
                    0.05,
                    kBeltWidth - 0.02,
                    legs},
                   kSteel);
}

// Both sensors look across or onto the belt from outside of it, so no rail is in their way. The post carries
// the scanner above the arm.
constexpr const char* kFeedSensors = R"(        <sensor name="barrier" type="lidar">
          <pose>{0:.4f} {1:.4f} {2:.4f} 0 0 -1.5707963267948966</pose>
          <lidar><scan><horizontal><samples>1</samples></horizontal></scan><range><min>0.005</min><max>{3:.4f}</max></range></lidar>
        </sensor>
        <sensor name="scanner" type="lidar">
          <pose>{4:.4f} 0 {5:.4f} 0 1.5707963267948966 0</pose>
          <lidar>
            <scan>
              <horizontal><samples>{6}</samples><min_angle>-{7:.6f}</min_angle><max_angle>{7:.6f}</max_angle></horizontal>
              <vertical><samples>{6}</samples><min_angle>-{7:.6f}</min_angle><max_angle>{7:.6f}</max_angle></vertical>
            </scan>
            <range><min>0.1</min><max>2</max></range>
            <noise><type>gaussian</type><mean>0</mean><stddev>0.001</stddev></noise>
          </lidar>
        </sensor>
)";

void add_feed_belt(Text& text, int cell) {
    const Place at = cell_origin(cell);
    add(text,
        "    <model name=\"{}\">\n      <static>true</static>\n      <pose>{:.3f} {:.3f} 0 0 0 0</pose>\n",
        feed_name(cell), at.x, at.y + kBeltAside);
    add(text, "      <link name=\"belt\">\n");
    add_belt_body(text, kFeedBegin, kFeedEnd);
    add(text, "      </link>\n      <link name=\"frame\">\n");
    const double post = 0.55;
    add_solid(text, {"post", {kScannerX, post, kScannerHeight / 2}, 0.06, 0, kScannerHeight}, kSteel, 0.5);
    add_visual(text, {"bracket", {kScannerX, post / 2, kScannerHeight + 0.03}, 0.05, post + 0.06, 0.04},
               kSteel);
    add_visual(text, {"scanner", {kScannerX, 0, kScannerHeight + 0.01}, 0.08, 0.10, 0.05}, kYellow);
    for (const double side : {-1.0, 1.0})
        add_visual(text,
                   {side < 0 ? "reflector" : "barrier",
                    {kBarrierX, side * (kBeltWidth / 2 + 0.03), kBeltTop + kBarrierHeight},
                    0.02,
                    0.02,
                    0.03},
                   kYellow);
    const double field = fixed_atan2(kScannerField, kScannerHeight - kBeltTop);
    fmt::format_to(std::back_inserter(text), fmt::runtime(kFeedSensors), kBarrierX, kBeltWidth / 2 + 0.02,
                   kBeltTop + kBarrierHeight, kBeltWidth + 0.04, kScannerX, kScannerHeight, kScannerBeams,
                   field);
    add(text,
        "      </link>\n      <plugin filename=\"gz-sim-track-controller-system\" "
        "name=\"gz::sim::systems::TrackController\">\n        <link>belt</link><max_velocity>1</max_velocity>"
        "<min_velocity>-1</min_velocity><max_acceleration>2</max_acceleration><min_acceleration>-2"
        "</min_acceleration>\n      </plugin>\n    </model>\n");
}

void add_out_belt(Text& text, int cell) {
    const Place at = cell_origin(cell);
    add(text,
        "    <model name=\"out_{}\">\n      <static>true</static>\n      <pose>{:.3f} {:.3f} 0 0 0 "
        "0</pose>\n",
        cell, at.x, at.y - kBeltAside);
    add(text, "      <link name=\"belt\">\n");
    add_belt_body(text, kOutBegin, kOutEnd);
    add(text,
        "        <roboss:surface_velocity><linear>{} 0 "
        "0</linear><fixed>true</fixed></roboss:surface_velocity>\n"
        "      </link>\n    </model>\n",
        kOutSpeed);
}

void add_joint(Text& text, std::string_view name, std::string_view type, std::string_view parent,
               std::string_view child, std::string_view axis) {
    add(text,
        "      <joint name=\"{}\" type=\"{}\"><parent>{}</parent><child>{}</child><axis>{}</axis></joint>\n",
        name, type, parent, child, axis);
}

std::string axis_of(std::string_view xyz, double lower, double upper, double effort, double velocity) {
    return fmt::format(
        "<xyz>{}</xyz><limit><lower>{}</lower><upper>{}</upper><effort>{}</effort><velocity>{}</velocity></"
        "limit>",
        xyz, lower, upper, effort, velocity);
}

void add_finger(Text& text, bool left) {
    const double side = left ? 1 : -1, length = 0.09;
    const std::string name = left ? "left_finger" : "right_finger";
    add(text, "      <link name=\"{}\">\n        <pose>{} 0 {} 0 0 0</pose>\n", name, kUpperArm + kForearm,
        kTipHeight);
    const Part blade{"blade", {0, side * 0.010, length / 2}, 0.024, 0.012, length};
    add_inertial(text, blade, 0.08);
    add_visual(text, blade, kSteel);
    add_solid(text, {"pad", {0, side * 0.002, 0.018}, 0.030, 0.004, 0.036}, kRubber, 1.0, 0.015);
    add(text,
        "        <sensor name=\"touch\" "
        "type=\"contact\"><contact><collision>pad</collision></contact></sensor>\n      </link>\n");
    std::string axis = axis_of(left ? "0 1 0" : "0 -1 0", 0, kFingerStroke, 60, 0.4);
    // Rack and pinion: one motor closes both fingers, so they keep the box in the middle.
    if (!left)
        axis +=
            "<mimic "
            "joint=\"fingers\"><multiplier>1</multiplier><offset>0</offset><reference>0</reference></mimic>";
    add_joint(text, left ? "fingers" : "fingers_right", "prismatic", "hand", name, axis);
}

void add_hand(Text& text, const CellOptions& options) {
    const bool fingers = options.gripper == "fingers";
    add(text, "      <link name=\"hand\">\n        <pose>{} 0 {} 0 0 0</pose>\n", kUpperArm + kForearm,
        kTipHeight);
    const Part palm{"palm", {0, 0, 0.11}, 0.05, 0.13, 0.03};
    add_inertial(text, palm, 0.5);
    if (fingers) {
        add_solid(text, palm, kDark, 0.5);
        add(text,
            "        <roboss:sensor name=\"eye\" type=\"infrared\"><pose>0 0 0.09 0 1.5707963267948966 "
            "0</pose>"
            "<max>0.12</max><opening_angle>0</opening_angle></roboss:sensor>\n      </link>\n");
        return;
    }
    add_visual(text, {"palm", {0, 0, 0.10}, 0.06, 0, 0.03}, kDark);
    add_solid(text, {"cup", {0, 0, 0.04}, 0.03, 0, 0.08}, kRubber, 0.8);
    // The eye looks past the cup, beside its rim.
    add(text,
        "        <roboss:sensor name=\"eye\" type=\"infrared\"><pose>0.019 0 0.09 0 1.5707963267948966 "
        "0</pose><max>0.20"
        "</max><opening_angle>0</opening_angle></roboss:sensor>\n"
        "        <roboss:gripper name=\"cup\"><type>suction</type><pose>0 0 0 0 0 "
        "0</pose><reach>0.006</reach>"
        "<max_force>40</max_force><max_torque>2</max_torque></roboss:gripper>\n      </link>\n");
}

void add_arm(Text& text, const CellOptions& options, int cell) {
    const Place at = cell_origin(cell);
    add(text, "    <model name=\"{}\">\n      <pose>{:.3f} {:.3f} 0 0 0 0</pose>\n", arm_name(cell), at.x,
        at.y);
    const Part column{"column", {0, 0, kArmHeight / 2 - 0.02}, 0.18, 0, kArmHeight - 0.04};
    add(text, "      <link name=\"base\">\n");
    add_inertial(text, column, 40);
    add_solid(text, column, kDark, 0.5);
    add(text, "      </link>\n      <link name=\"upper_arm\">\n        <pose>0 0 {} 0 0 0</pose>\n",
        kArmHeight);
    const Part upper{"beam", {kUpperArm / 2, 0, 0.03}, kUpperArm + 0.12, 0.11, 0.06};
    add_inertial(text, upper, 6);
    add_solid(text, upper, kOrange, 0.5);
    add(text, "      </link>\n      <link name=\"forearm\">\n        <pose>{} 0 {} 0 0 0</pose>\n", kUpperArm,
        kArmHeight + 0.07);
    const Part fore{"beam", {kForearm / 2, 0, 0.025}, kForearm + 0.10, 0.09, 0.05};
    add_inertial(text, fore, 3.5);
    add_solid(text, fore, kOrange, 0.5);
    add(text, "      </link>\n      <link name=\"quill\">\n        <pose>{} 0 {} 0 0 0</pose>\n",
        kUpperArm + kForearm, kTipHeight);
    const Part quill{"rod", {0, 0, 0.125 + 0.27}, 0.04, 0, 0.54};
    add_inertial(text, quill, 1.2);
    add_visual(text, quill, kSteel);
    add(text, "      </link>\n");
    add_hand(text, options);
    add_joint(text, "ground", "fixed", "world", "base", "<xyz>0 0 1</xyz>");
    add_joint(text, "shoulder", "revolute", "base", "upper_arm",
              axis_of("0 0 1", -kShoulderLimit, kShoulderLimit, 150, 5));
    add_joint(text, "elbow", "revolute", "upper_arm", "forearm",
              axis_of("0 0 1", -kElbowLimit, kElbowLimit, 60, 6));
    add_joint(text, "lift", "prismatic", "forearm", "quill", axis_of("0 0 1", -kLiftStroke, 0, 200, 1.5));
    add_joint(text, "wrist", "revolute", "quill", "hand", axis_of("0 0 1", -kWristLimit, kWristLimit, 8, 12));
    if (options.gripper == "fingers")
        for (const bool left : {true, false}) add_finger(text, left);
    add(text, "    </model>\n");
}

void add_box(Text& text, int cell, int number) {
    const Place at = cell_origin(cell), rack = rack_place(number);
    const BoxKind kind = kind_of_box(number);
    const Part box{"box", {}, kind.length, kind.width, kind.height};
    add(text,
        "    <model name=\"{}\">\n      <pose>{:.3f} {:.3f} {:.3f} 0 0 0</pose>\n      <link name=\"box\">\n",
        box_name(cell, number), at.x + rack.x, at.y + rack.y, rack.z);
    add_inertial(text, box, kind.mass_kg);
    add_solid(text, box, kCardboard, 0.6, 0);
    add(text, "      </link>\n    </model>\n");
}

}  // namespace

std::string cell_sdf(const CellOptions& options) {
    if (options.cells < 1 || options.cells > 1000) return {};
    if (options.gripper != "fingers" && options.gripper != "suction") return {};
    Text text;
    add_head(text, options);
    for (int cell = 0; cell < options.cells; ++cell) {
        add_feed_belt(text, cell);
        add_out_belt(text, cell);
        add_arm(text, options, cell);
        for (int number = 0; number < kBoxes; ++number) add_box(text, cell, number);
    }
    add(text, "  </world>\n</sdf>\n");
    return fmt::to_string(text);
}

}  // namespace roboss
