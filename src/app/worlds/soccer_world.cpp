// Plain text, as the other generators write it.
#include "app/worlds/soccer_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <tuple>
#include <utility>

#include "app/text.h"
#include "app/worlds/soccer_boxes.h"
#include "app/worlds/soccer_field.h"
#include "app/worlds/ssl_world.h"
#include "core/fixed_math.h"

namespace roboss {
namespace {

using soccer::Field;
using soccer::kGoalBeads;

constexpr double kLine = 0.005;  // m, width of a line
constexpr const char* kWhite = "0.92 0.92 0.90";

// 0.5 kg in all. Battery and motors lie low: its centre of mass is 2 cm above the field. The sliders have
// half a millimetre of play, so it rests on the wheels. Inertias of the solid box and cylinders. Motors of
// 0.03 N m push with 2.7 N, 5.1 m/s2 (the wheels' inertia counts as 30 g). The rear slider then bears 5.1
// m/s2 * 0.5 kg * 2 cm / 3.4 cm = 1.5 N of the 4.9 N, so soft tyres (friction 1.2) still grip with 4.1 N: it
// does not skid. The tyres are round (ellipsoids): of the two contact points of a cylinder one may bear all
// (docs/physics.md, contact reports), and a robot that accelerates begins to turn.
constexpr const char* kChassis = R"(      <link name="chassis">
        <inertial>
          <pose>0 0 0.02 0 0 0</pose>
          <mass>0.44</mass>
          <inertia><ixx>0.0004125</ixx><iyy>0.0004125</iyy><izz>0.0004125</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>
        </inertial>
        <collision name="body">
          <pose>0 0 0.0395 0 0 0</pose>
          <geometry><box><size>0.075 0.075 0.071</size></box></geometry>
          <surface><friction><ode><mu>0.2</mu><mu2>0.2</mu2></ode></friction></surface>
        </collision>
        <collision name="front_slider">
          <pose>0.034 0 0.0035 0 0 0</pose>
          <geometry><sphere><radius>0.003</radius></sphere></geometry>
          <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface>
        </collision>
        <collision name="rear_slider">
          <pose>-0.034 0 0.0035 0 0 0</pose>
          <geometry><sphere><radius>0.003</radius></sphere></geometry>
          <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface>
        </collision>
)";

constexpr const char* kWheel = R"(      <link name="{0}_wheel">
        <pose>0 {1} 0.022 0 0 0</pose>
        <inertial>
          <mass>0.03</mass>
          <inertia><ixx>3.79e-6</ixx><iyy>7.26e-6</iyy><izz>3.79e-6</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>
        </inertial>
        <collision name="tyre">
          <geometry><ellipsoid><radii>0.022 0.006 0.022</radii></ellipsoid></geometry>
          <surface><friction><ode><mu>1.2</mu><mu2>1.2</mu2></ode></friction></surface>
        </collision>
        <visual name="tyre">
          <pose>0 0 0 1.5707963 0 0</pose>
          <geometry><cylinder><radius>0.022</radius><length>0.0135</length></cylinder></geometry>
          <material><diffuse>0.15 0.15 0.16 1</diffuse></material>
        </visual>
      </link>
      <joint name="{0}" type="continuous">
        <parent>chassis</parent>
        <child>{0}_wheel</child>
        <axis>
          <xyz>0 1 0</xyz>
          <limit><effort>0.03</effort><velocity>230</velocity></limit>
        </axis>
      </joint>
)";

void add_head(Text& text, const Field& field) {
    add(text, R"(<?xml version="1.0"?>
<!-- Robot soccer, {0} league, {1} against {1}. Made by: roboss-world soccer, league {0}. Change the generator, not this file. -->
<sdf version="1.9" xmlns:roboss="https://roboss.org/sdf">
)",
        field.league, field.robots);
    add(text, kSoccerHead);
    add(text, R"(        <collision name="table">
          <geometry><plane><normal>0 0 1</normal><size>{0:.2f} {1:.2f}</size></plane></geometry>
          <surface><friction><ode><mu>1.2</mu><mu2>1.2</mu2></ode></friction></surface>
        </collision>
        <visual name="table">
          <geometry><plane><normal>0 0 1</normal><size>{0:.2f} {1:.2f}</size></plane></geometry>
          <material><diffuse>0.10 0.14 0.12 1</diffuse></material>
        </visual>
)",
        2 * field.half_length + 1, 2 * field.half_width + 1);
}

/// A wall over the rectangle; restitution of wood.
void add_wall(Text& text, const std::string& name, double low_x, double high_x, double low_y, double high_y,
              double yaw = 0) {
    const FieldBox box{(low_x + high_x) / 2,
                       (low_y + high_y) / 2,
                       soccer::kWallHeight / 2,
                       high_x - low_x,
                       high_y - low_y,
                       soccer::kWallHeight,
                       yaw};
    add_solid(text, name, box, "0.5", "0.33 0.35 0.37");
}

void add_walls(Text& text, const Field& f) {
    const double thick = soccer::kWallThickness, outer = f.half_width + thick;
    for (const int side : {-1, 1}) {
        const std::string suffix = side < 0 ? "right" : "left";
        const double inner = side * f.half_width, far_y = side * outer;
        add_wall(text, "side_" + suffix, -f.half_length - thick, f.half_length + thick,
                 std::min(inner, far_y), std::max(inner, far_y));
    }
    for (const int end : {-1, 1}) {
        const std::string name = end < 0 ? "west" : "east";
        const double line = end * f.half_length, back = end * (f.half_length + f.goal_depth);
        const auto across = [&](const std::string& part, double from_x, double to_x, double from_y,
                                double to_y) {
            add_wall(text, name + part, std::min(from_x, to_x), std::max(from_x, to_x), from_y, to_y);
        };
        across("_end_right", line, line + end * thick, -f.half_width, -f.half_goal);
        across("_end_left", line, line + end * thick, f.half_goal, f.half_width);
        across("_goal_right", line + end * thick, back + end * thick, -f.half_goal - thick, -f.half_goal);
        across("_goal_left", line + end * thick, back + end * thick, f.half_goal, f.half_goal + thick);
        across("_goal_back", back, back + end * thick, -f.half_goal, f.half_goal);
        // The hypotenuse of a corner's triangle, as a wall that ends within the others.
        const double half = 0.5 * soccer::kCorner + 0.5 * thick * 0.70710678;
        for (const int side : {-1, 1}) {
            const double x = end * (f.half_length - soccer::kCorner + half),
                         y = side * (f.half_width - soccer::kCorner + half),
                         length = 0.70710678 * soccer::kCorner;
            add_wall(text, name + (side < 0 ? "_corner_right" : "_corner_left"), x - length, x + length,
                     y - thick / 2, y + thick / 2, -end * side * kPi / 4);
        }
    }
}

/// Lines are drawn only: the ball does not feel them.
void add_lines(Text& text, const Field& f) {
    int count = 0;
    const auto line = [&](double x, double y, double length, double width, double yaw = 0) {
        add_visual(text, fmt::format("line_{}", count++), {x, y, 0.0004, length, width, 0.0008, yaw}, kWhite);
    };
    line(0, 0, kLine, 2 * f.half_width);
    constexpr int kPieces = 48;
    for (int i = 0; i < kPieces; ++i) {
        const double angle = 2 * kPi * i / kPieces;
        line(f.circle * fixed_cos(angle), f.circle * fixed_sin(angle), kLine, 2 * kPi * f.circle / kPieces,
             angle);
    }
    for (const int end : {-1, 1}) {
        line(end * f.half_length, 0, kLine, 2 * f.half_goal);
        for (const auto& [half, depth] : {std::pair{f.goal_area_half, f.goal_area_depth},
                                          std::pair{f.penalty_half, f.penalty_area_depth}}) {
            line(end * (f.half_length - depth), 0, kLine, 2 * half);
            for (const int side : {-1, 1}) line(end * (f.half_length - depth / 2), side * half, depth, kLine);
        }
        line(end * (f.half_length - f.penalty_mark), 0, 0.015, 0.015);
        for (const int side : {-1, 1}) line(end * f.half_length / 2, side * f.half_width / 2, 0.015, 0.015);
    }
}

/// A row of beads for each team, which the referee moves: what a page shows of the score. Nothing touches it.
void add_scoreboard(Text& text, const Field& f) {
    add(text, "    <model name=\"scoreboard\">\n      <pose>0 {:.3f} 0.25 0 0 0</pose>\n",
        f.half_width + 0.25);
    const double rail = 2 * soccer::kBeadWay;
    add(text,
        "      <link name=\"board\">\n        "
        "<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>\n");
    add_visual(text, "board", {0, 0.03, 0, 2 * rail + 0.2, 0.01, 0.2, 0}, "0.20 0.22 0.25");
    add_visual(text, "middle", {0, 0.02, 0, 0.01, 0.02, 0.2, 0}, kWhite);
    add(text,
        "      </link>\n      <joint name=\"hung\" "
        "type=\"fixed\"><parent>world</parent><child>board</child></joint>\n");
    for (const auto& [team, side, colour] :
         {std::tuple{"blue", -1, "0.15 0.35 0.95"}, std::tuple{"yellow", 1, "0.95 0.80 0.10"}})
        for (int i = 0; i < kGoalBeads; ++i) {
            const double x = side * (rail - soccer::kBeadPitch * (kGoalBeads - 1 - i));
            add(text,
                "      <link name=\"{0}_bead_{1}\">\n        <gravity>false</gravity>\n        <pose>{2:.3f} "
                "0 0 0 0 0</pose>\n",
                team, i, x);
            add(text,
                "        "
                "<inertial><mass>0.1</mass><inertia><ixx>1e-4</ixx><iyy>1e-4</iyy><izz>1e-4</izz></inertia></"
                "inertial>\n");
            add_visual(text, "bead", {0, 0, 0, 0.025, 0.03, 0.12, 0}, colour);
            add(text, R"(      </link>
      <joint name="{0}_{1}" type="prismatic">
        <parent>board</parent>
        <child>{0}_bead_{1}</child>
        <axis><xyz>{2} 0 0</xyz><limit><lower>0</lower><upper>{3:.3f}</upper></limit><dynamics><friction>1</friction></dynamics></axis>
      </joint>
)",
                team, i, -side, soccer::kBeadWay);
        }
    add(text, "    </model>\n");
}

/// 38400 bit/s, as radio modules of the league had: commands for three robots take 2.5 ms. Each team has a
/// channel.
void add_radio(Text& text, const SoccerOptions& options, bool blue, double height) {
    add(text,
        "        <roboss:radio name=\"radio\"><pose>0 0 {} 0 0 0</pose><channel>{}</channel>"
        "<bit_rate>38400</bit_rate><loss>{}</loss></roboss:radio>\n",
        height, blue ? 1 : 2, options.radio_loss);
}

void add_station(Text& text, const SoccerOptions& options, const Field& f, std::string_view team) {
    const bool blue = team == "blue";
    add(text,
        "    <model name=\"{}_station\">\n      <pose>{:.3f} {:.3f} 0 0 0 0</pose>\n      <link "
        "name=\"station\">\n",
        team, (blue ? -0.5 : 0.5) * f.half_length, -f.half_width - 0.25);
    add(text,
        "        "
        "<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>\n");
    add_visual(text, "box", {0, 0, 0.03, 0.16, 0.10, 0.06, 0}, "0.20 0.22 0.25");
    add_visual(text, "mast", {0, 0, 0.18, 0.008, 0.008, 0.24, 0}, blue ? "0.10 0.30 0.95" : "0.98 0.82 0.05");
    add_radio(text, options, blue, 0.3);
    add(text,
        "      </link>\n      <joint name=\"fixed\" "
        "type=\"fixed\"><parent>world</parent><child>station</child></joint>\n    </model>\n");
}

void add_robot(Text& text, const SoccerOptions& options, const Field& field, std::string_view team,
               int number) {
    const bool blue = team == "blue";
    const soccer::Stand stand = soccer::kick_off_stand(field, number, blue);
    add(text, "    <model name=\"{}_{}\">\n      <pose>{:.4f} {:.4f} 0 0 0 {}</pose>\n{}", team, number,
        blue ? stand.x : -stand.x, blue ? stand.y : -stand.y, blue ? "0" : "3.14159265", kChassis);
    add_visual(text, "body", {0, 0, 0.0385, 0.075, 0.06, 0.069, 0}, "0.75 0.76 0.78");
    add_visual(text, "patch", {-0.012, 0, 0.074, 0.045, 0.06, 0.002, 0},
               blue ? "0.10 0.30 0.95" : "0.98 0.82 0.05");
    add_visual(text, "front", {0.024, 0, 0.074, 0.020, 0.06, 0.002, 0},
               number == 0 ? "0.85 0.10 0.10" : "0.10 0.10 0.10");
    if (options.radio) add_radio(text, options, blue, 0.08);
    add(text, "      </link>\n");
    for (const auto& [name, y] : {std::pair{"left", 0.031}, std::pair{"right", -0.031}})
        fmt::format_to(std::back_inserter(text), fmt::runtime(kWheel), name, y);
    add(text, "    </model>\n");
}

// A golf ball on a wooden table: it slows down by 5/7 * 0.0006 m / 21.35 mm * g = 0.2 m/s2.
void add_ball(Text& text) {
    add(text, R"(    <model name="ball">
      <pose>0 0 {0:.5f} 0 0 0</pose>
      <link name="ball">
        <inertial><mass>{1}</mass><inertia><ixx>8.387e-6</ixx><iyy>8.387e-6</iyy><izz>8.387e-6</izz></inertia></inertial>
        <collision name="ball">
          <geometry><sphere><radius>{0:.5f}</radius></sphere></geometry>
          <surface>
            <roboss:rolling_friction>0.0006</roboss:rolling_friction>
            <friction><ode><mu>0.4</mu><mu2>0.4</mu2></ode></friction>
            <bounce><restitution_coefficient>0.5</restitution_coefficient><threshold>0.1</threshold></bounce>
          </surface>
        </collision>
        <visual name="ball">
          <geometry><sphere><radius>{0:.5f}</radius></sphere></geometry>
          <material><diffuse>1.0 0.45 0.05 1</diffuse></material>
        </visual>
      </link>
    </model>
)",
        soccer::kBallRadius, soccer::kBallMass);
}

}  // namespace

std::string soccer_sdf(const SoccerOptions& options) {
    for (const soccer::SslField& field : soccer::kSslFields)
        if (field.league == options.league) return ssl_sdf(field);
    Text text;
    for (const Field& field : soccer::kFields) {
        if (field.league != options.league) continue;
        add_head(text, field);
        add_walls(text, field);
        add_lines(text, field);
        add(text, "      </link>\n    </model>\n");
        for (const std::string_view team : {"blue", "yellow"})
            for (int i = 0; i < field.robots; ++i) add_robot(text, options, field, team, i);
        add_ball(text);
        add_scoreboard(text, field);
        if (options.radio)
            for (const std::string_view team : {"blue", "yellow"}) add_station(text, options, field, team);
        add(text, "  </world>\n</sdf>\n");
    }
    return fmt::to_string(text);
}

}  // namespace roboss
