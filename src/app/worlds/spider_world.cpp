// Plain text, as the other generators write it. Measures and masses: spider_body.h.
#include "app/worlds/spider_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "app/text.h"
#include "app/worlds/spider_body.h"
#include "core/fixed_math.h"
#include "core/noise.h"

namespace roboss {
namespace {

using spider::Hip;

constexpr double kSpacing = 1.0;       // m, between spiders
constexpr double kTerrainBegin = 0.6;  // m, before the middle of the first row
constexpr double kTerrainLength = 4.0;
constexpr double kTread = 0.35;  // m, depth of a step
constexpr int kStepCount = 8;
constexpr const char* kRubber =
    "<surface><friction><ode><mu>1.0</mu><mu2>1.0</mu2></ode></friction></surface>";
constexpr std::array<const char*, 5> kShells{"0.85 0.20 0.03", "0.04 0.30 0.60", "0.85 0.55 0.03",
                                             "0.16 0.45 0.08", "0.55 0.04 0.14"};

struct Size {
    double x = 0, y = 0, z = 0;
};

/// Inertia of a solid box about its centre.
void add_inertial(Text& text, double mass, const Size& box, double centre_x = 0) {
    const double k = mass / 12;
    add(text,
        "        <inertial><pose>{:.4f} 0 0 0 0 0</pose><mass>{}</mass><inertia><ixx>{:.6e}</ixx><iyy>{:.6e}"
        "</iyy><izz>{:.6e}</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>\n",
        centre_x, mass, k * (box.y * box.y + box.z * box.z), k * (box.x * box.x + box.z * box.z),
        k * (box.x * box.x + box.y * box.y));
}

void add_visual(Text& text, std::string_view name, std::string_view pose, std::string_view geometry,
                std::string_view colour, std::string_view more = "") {
    add(text,
        "        <visual name=\"{}\"><pose>{}</pose><geometry>{}</geometry><material><diffuse>{} "
        "1</diffuse>{}"
        "</material></visual>\n",
        name, pose, geometry, colour, more);
}

std::string ellipsoid(double x, double y, double z) {
    return fmt::format("<ellipsoid><radii>{} {} {}</radii></ellipsoid>", x, y, z);
}

std::string round(std::string_view shape, double radius, double length) {
    return fmt::format("<{0}><radius>{1}</radius><length>{2:.4f}</length></{0}>", shape, radius, length);
}

constexpr const char* kDark = "0.13 0.14 0.16";
constexpr const char* kSteel = "0.55 0.57 0.60";
constexpr const char* kGlowing = "<emissive>0.75 0.10 0.05 1</emissive>";

double standing_height() {
    return -spider::kPartLengths[1] * fixed_sin(spider::kFemurUp) -
           spider::kPartLengths[2] * fixed_sin(spider::kTibiaUp) + spider::kFootRadius;
}

/// Thorax with the hips, abdomen with stripes, head with eight eyes.
void add_trunk(Text& text, std::string_view shell) {
    add(text, "      <link name=\"trunk\">\n        <pose>0 0 {:.6f} 0 0 0</pose>\n", standing_height());
    add_inertial(text, spider::kTrunkMass, {0.30, 0.14, 0.07});
    add(text,
        "        <collision name=\"body\"><geometry><box><size>{} 0.14 0.07</size></box></geometry>{}"
        "</collision>\n",
        spider::kTrunkLength, kRubber);
    add_visual(text, "thorax", "0.01 0 0.012 0 0 0", ellipsoid(0.150, 0.078, 0.034), kDark);
    add_visual(text, "shield", "0.015 0 0.022 0 0 0", ellipsoid(0.110, 0.056, 0.036), shell);
    add_visual(text, "keel", "0 0 -0.012 0 0 0", "<box><size>0.25 0.09 0.03</size></box>", kSteel);
    add_visual(text, "abdomen", "-0.125 0 0.035 0 0.18 0", ellipsoid(0.085, 0.062, 0.050), shell);
    for (const auto& [x, size] :
         {std::pair{-0.100, 0.0490}, std::pair{-0.135, 0.0508}, std::pair{-0.168, 0.0440}})
        add_visual(text, fmt::format("stripe_{:.0f}", -1000 * x),
                   fmt::format("{} 0 {:.4f} 0 1.7508 0", x, 0.035 - 0.18 * (x + 0.125)),
                   fmt::format("<cylinder><radius>{:.4f}</radius><length>0.007</length></cylinder>", size),
                   kDark);
    add_visual(text, "head", "0.155 0 0.012 0 0 0", ellipsoid(0.045, 0.042, 0.030), kDark);
    for (int eye = 0; eye < 8; ++eye) {
        const bool upper = eye >= 4;
        const double y = (eye % 4 - 1.5) * (upper ? 0.013 : 0.018);
        const double x = 0.155 + (upper ? 0.030 : 0.041) - 12 * y * y, z = upper ? 0.036 : 0.020;
        const bool large = !upper && (eye == 1 || eye == 2);
        add_visual(text, fmt::format("eye_{}", eye), fmt::format("{:.4f} {:.4f} {} 0 0 0", x, y, z),
                   fmt::format("<sphere><radius>{}</radius></sphere>", large ? 0.0085 : 0.0055),
                   "0.90 0.15 0.08", kGlowing);
    }
    for (const int side : {-1, 1})
        add_visual(text, side < 0 ? "fang_right" : "fang_left",
                   fmt::format("0.188 {} -0.012 0 2.5 0", side * 0.014), round("cone", 0.008, 0.04), kSteel);
    add(text, "        <roboss:sensor name=\"compass\" type=\"gyrocompass\"/>\n      </link>\n");
}

void add_part_shapes(Text& text, std::size_t part, std::string_view shell) {
    const double length = spider::kPartLengths[part];
    const auto along = [&](double x) { return fmt::format("{:.4f} 0 0 0 1.5707963 0", x); };
    if (part == 0) {
        add_visual(text, "hip", "0 0 0 0 0 0", round("cylinder", 0.021, 0.050), kDark);
        add_visual(text, "arm", along(length / 2), round("cylinder", 0.013, length), kSteel);
        return;
    }
    const double radius = part == 1 ? 0.013 : 0.009, end = part == 1 ? 0.0 : 0.02;
    add(text, "        <collision name=\"shaft\"><pose>{}</pose><geometry>{}</geometry>{}</collision>\n",
        along((length - end) / 2), round("capsule", radius, length - 2 * radius - end), kRubber);
    add_visual(text, "joint", "0 0 0 1.5707963 0 0", round("cylinder", part == 1 ? 0.019 : 0.016, 0.036),
               kDark);
    if (part == 1) {
        for (const int side : {-1, 1})
            add_visual(text, side < 0 ? "cheek_right" : "cheek_left",
                       fmt::format("{:.4f} {} 0 0 0 0", length / 2, side * 0.014),
                       fmt::format("<box><size>{:.4f} 0.005 0.026</size></box>", length), shell);
        add_visual(text, "shaft", along(length / 2), round("cylinder", 0.010, length), kSteel);
        return;
    }
    add(text,
        "        <collision name=\"foot\"><pose>{:.4f} 0 0 0 0 0</pose><geometry><sphere><radius>{}</radius>"
        "</sphere></geometry>{}</collision>\n",
        length, spider::kFootRadius, kRubber);
    add_visual(text, "shaft", along(length / 2 + 0.01), round("cone", 0.015, length - 0.02), shell);
    add_visual(text, "core", along(length / 2), round("cylinder", 0.0055, length), kSteel);
    add_visual(text, "foot", fmt::format("{:.4f} 0 0 0 0 0", length),
               fmt::format("<sphere><radius>{}</radius></sphere>", spider::kFootRadius), "0.08 0.08 0.08");
}

/// The joint that holds a part; its axis is in the frame of the part.
void add_joint(Text& text, std::string_view leg, std::size_t part, const SpiderOptions& options) {
    const std::string parent =
        part == 0 ? std::string("trunk") : fmt::format("{}_{}", leg, spider::kPartNames[part - 1]);
    add(text, R"(      <joint name="{0}_{1}_joint" type="revolute">
        <parent>{2}</parent>
        <child>{0}_{1}</child>
        <axis>
          <xyz>{3}</xyz>
          <limit><lower>{4}</lower><upper>{5}</upper><effort>{6}</effort><velocity>{7}</velocity></limit>
        </axis>
        <roboss:motor><position_gain>{8}</position_gain><velocity_gain>{9}</velocity_gain><armature>{10}</armature></roboss:motor>
      </joint>
)",
        leg, spider::kPartNames[part], parent, part == 0 ? "0 0 1" : "0 -1 0", spider::kJointLimits[part][0],
        spider::kJointLimits[part][1], options.motor_torque, options.motor_speed, spider::kServoGain,
        spider::kServoDamping, spider::kRotorInertia);
}

void add_leg(Text& text, std::size_t leg, std::string_view shell, const SpiderOptions& options) {
    const Hip& hip = spider::kHips[leg];
    const std::array<double, 3> up{0, spider::kFemurUp, spider::kTibiaUp};
    double out = 0, z = standing_height();
    for (std::size_t part = 0; part < spider::kLegJoints; ++part) {
        add(text, "      <link name=\"{}_{}\">\n        <pose>{:.6f} {:.6f} {:.6f} 0 {:.9f} {:.9f}</pose>\n",
            spider::kLegNames[leg], spider::kPartNames[part], hip.x + out * fixed_cos(hip.azimuth),
            hip.y + out * fixed_sin(hip.azimuth), z, -up[part], hip.azimuth);
        const double length = spider::kPartLengths[part];
        add_inertial(text, spider::kPartMasses[part], {length, 0.03, 0.03}, length / 2);
        add_part_shapes(text, part, shell);
        add(text, "      </link>\n");
        out += length * fixed_cos(up[part]);
        z += length * fixed_sin(up[part]);
    }
    for (std::size_t part = 0; part < spider::kLegJoints; ++part)
        add_joint(text, spider::kLegNames[leg], part, options);
}

int abreast_of(const SpiderOptions& options) {
    if (options.abreast > 0) return std::min(options.abreast, options.spiders);
    return static_cast<int>(std::ceil(std::sqrt(options.spiders)));
}

void add_spider(Text& text, int number, const SpiderOptions& options) {
    const int abreast = abreast_of(options);
    add(text,
        "    <model name=\"spider_{}\">\n      <pose>{} {} 0 0 0 0</pose>\n      "
        "<self_collide>true</self_collide>\n",
        number, -kSpacing * (number / abreast), kSpacing * (number % abreast - 0.5 * (abreast - 1)));
    const char* shell = kShells[static_cast<std::size_t>(number) % kShells.size()];
    add_trunk(text, shell);
    for (std::size_t leg = 0; leg < spider::kLegs; ++leg) add_leg(text, leg, shell, options);
    add(text, "    </model>\n");
}

/// A box that stands still.
void add_block(Text& text, std::string_view name, std::string_view pose, const Size& size,
               std::string_view colour) {
    const std::string box =
        fmt::format("<box><size>{:.4f} {:.4f} {:.4f}</size></box>", size.x, size.y, size.z);
    add(text, "        <collision name=\"{}\"><pose>{}</pose><geometry>{}</geometry>{}</collision>\n", name,
        pose, box, kRubber);
    add_visual(text, name, pose, box, colour);
}

/// Flat stones of random sizes, 45 a square metre, that stick out of the ground.
void add_rubble(Text& text, const SpiderOptions& options, double width) {
    const int stones = static_cast<int>(45 * kTerrainLength * width);
    std::uint64_t index = 0;
    const auto between = [&](double low, double high) {
        return low + (high - low) * random_uniform({options.seed, 0, 0, kOncePerRun}, index++);
    };
    for (int i = 0; i < stones; ++i) {
        const double x = kTerrainBegin + between(0, kTerrainLength), y = between(-0.5, 0.5) * width;
        const double top = options.height_m * between(0.3, 1), thick = 2 * options.height_m;
        const double roll = between(-0.15, 0.15), pitch = between(-0.15, 0.15), yaw = between(-3.14, 3.14);
        const double length = between(0.06, 0.16), broad = length * between(0.6, 1);
        const double grey = between(0.32, 0.55);
        add_block(
            text, fmt::format("stone_{}", i),
            fmt::format("{:.4f} {:.4f} {:.4f} {:.3f} {:.3f} {:.3f}", x, y, top - thick / 2, roll, pitch, yaw),
            {length, broad, thick}, fmt::format("{:.2f} {:.2f} {:.2f}", grey, 0.96 * grey, 0.90 * grey));
    }
}

/// Its top begins at the ground and goes up; a platform follows.
void add_slope(Text& text, const SpiderOptions& options, double width) {
    const double angle = options.angle_deg * kPi / 180, thick = 0.3;
    const double c = fixed_cos(angle), s = fixed_sin(angle), middle = kTerrainLength / 2;
    add_block(text, "slope",
              fmt::format("{:.5f} 0 {:.5f} 0 {:.9f} 0", kTerrainBegin + middle * c + thick / 2 * s,
                          middle * s - thick / 2 * c, -angle),
              {kTerrainLength, width, thick}, "0.50 0.46 0.40");
    const double top = kTerrainLength * s;
    if (top > 0)
        add_block(text, "platform",
                  fmt::format("{:.5f} 0 {:.5f} 0 0 0", kTerrainBegin + kTerrainLength * c + 1, top / 2),
                  {2, width, top}, "0.44 0.42 0.38");
}

void add_steps(Text& text, const SpiderOptions& options, double width) {
    for (int i = 0; i < kStepCount; ++i) {
        const double top = options.height_m * (i + 1), depth = i + 1 < kStepCount ? kTread : 3;
        add_block(text, fmt::format("step_{}", i),
                  fmt::format("{:.4f} 0 {:.4f} 0 0 0", kTerrainBegin + kTread * i + depth / 2, top / 2),
                  {depth, width, top}, i % 2 == 0 ? "0.50 0.46 0.40" : "0.42 0.40 0.36");
    }
}

void add_ground(Text& text, const SpiderOptions& options) {
    const double width = kSpacing * abreast_of(options) + 0.4;
    add(text, R"(    <model name="ground">
      <static>true</static>
      <link name="link">
        <collision name="plane"><geometry><plane><normal>0 0 1</normal><size>400 400</size></plane></geometry>{0}</collision>
        <visual name="plane">
          <geometry><plane><normal>0 0 1</normal><size>400 400</size></plane></geometry>
          <material><diffuse>0.58 0.60 0.56 1</diffuse></material>
        </visual>
)",
        kRubber);
    if (options.terrain == "rubble") add_rubble(text, options, width);
    if (options.terrain == "slope") add_slope(text, options, width);
    if (options.terrain == "steps") add_steps(text, options, width);
    add(text, "      </link>\n    </model>\n");
}

}  // namespace

std::string spider_sdf(const SpiderOptions& options) {
    constexpr std::array<std::string_view, 4> kTerrains{"flat", "rubble", "slope", "steps"};
    if (std::find(kTerrains.begin(), kTerrains.end(), options.terrain) == kTerrains.end()) return {};
    Text text;
    add(text, R"(<?xml version="1.0"?>
<!-- Spider robots. Made by: roboss-world spiders (docs/spider.md). Change the generator, not this file. -->
<sdf version="1.9" xmlns:roboss="https://roboss.org/sdf">
  <world name="spiders">
    <physics name="step" type="ignored">
      <max_step_size>0.002</max_step_size>
      <real_time_factor>1</real_time_factor>
    </physics>
    <gravity>0 0 -9.81</gravity>
)");
    add_ground(text, options);
    for (int i = 0; i < options.spiders; ++i) add_spider(text, i, options);
    add(text, "  </world>\n</sdf>\n");
    return fmt::to_string(text);
}

}  // namespace roboss
