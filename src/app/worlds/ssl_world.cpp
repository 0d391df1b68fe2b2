#include "app/worlds/ssl_world.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>
#include <utility>

#include "app/text.h"
#include "app/worlds/soccer_boxes.h"
#include "core/fixed_math.h"

namespace roboss {
namespace {

using soccer::SslField;
using soccer::SslRobot;

constexpr const char* kLineColour = "0.92 0.92 0.90";

constexpr const char* kHead = R"(<?xml version="1.0"?>
<!-- RoboCup Small Size League, {0}, {1} against {1}. Made by: roboss-world soccer, league {0}. Change the generator, not this file. -->
<sdf version="1.9" xmlns:gz="http://gazebosim.org/schema" xmlns:roboss="https://roboss.org/sdf">
)";

// Two grounds in one place, as the ball slides on the carpet with less friction than rubber rollers: the
// lower two bits of the masks say which of them a shape stands on. Friction of a pair is the smaller one, so
// ball and dribbler grip each other better than the ball grips the carpet; a dribbler needs that.
constexpr const char* kCarpet = R"(        <collision name="carpet_of_robots">
          <geometry><plane><normal>0 0 1</normal><size>{0:.2f} {1:.2f}</size></plane></geometry>
          <surface><contact><collide_bitmask>1</collide_bitmask></contact><friction><ode><mu>0.8</mu><mu2>0.8</mu2></ode></friction></surface>
        </collision>
        <collision name="carpet_of_ball">
          <geometry><plane><normal>0 0 1</normal><size>{0:.2f} {1:.2f}</size></plane></geometry>
          <surface>
            <contact><collide_bitmask>2</collide_bitmask></contact>
            <friction><ode><mu>0.35</mu><mu2>0.35</mu2></ode></friction>
            <bounce><restitution_coefficient>0.5</restitution_coefficient><threshold>0.2</threshold></bounce>
          </surface>
        </collision>
        <visual name="carpet">
          <geometry><plane><normal>0 0 1</normal><size>{0:.2f} {1:.2f}</size></plane></geometry>
          <material><diffuse>0.12 0.36 0.17 1</diffuse></material>
        </visual>
)";

// 2.8 kg in all, as grSim's. The friction direction of a wheel is along its rolling, in the axes of the
// chassis; the small friction across is that of the rollers. Motors of 0.12 N m push a wheel with 4.4 N; a
// tyre bears 5.5 N. Moments of inertia of solid cylinders.
constexpr const char* kSslWheel = R"(      <link name="wheel{0}_rim">
        <pose>{1:.5f} {2:.5f} 0.027 0 0 {3:.7f}</pose>
        <inertial>
          <mass>0.2</mass>
          <inertia><ixx>7.29e-5</ixx><iyy>3.89e-5</iyy><izz>3.89e-5</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>
        </inertial>
        <collision name="rollers">
          <geometry><ellipsoid><radii>0.006 0.027 0.027</radii></ellipsoid></geometry>
          <surface>
            <contact><collide_bitmask>5</collide_bitmask><category_bitmask>4</category_bitmask></contact>
            <friction><ode><mu>0.8</mu><mu2>0.02</mu2><fdir1 gz:expressed_in="chassis">{4:.7f} {5:.7f} 0</fdir1></ode></friction>
          </surface>
        </collision>
        <visual name="rim">
          <pose>0 0 0 0 1.5707963 0</pose>
          <geometry><cylinder><radius>0.027</radius><length>0.012</length></cylinder></geometry>
          <material><diffuse>0.25 0.25 0.27 1</diffuse></material>
        </visual>
      </link>
      <joint name="wheel{0}" type="continuous">
        <parent>chassis</parent>
        <child>wheel{0}_rim</child>
        <axis><xyz>-1 0 0</xyz><limit><effort>0.12</effort><velocity>250</velocity></limit></axis>
      </joint>
)";

constexpr const char* kDribbler = R"(      <link name="dribbler_bar">
        <pose>{0:.5f} 0 {1:.5f} 0 0 0</pose>
        <inertial>
          <mass>0.03</mass>
          <inertia><ixx>1.3e-5</ixx><iyy>5e-6</iyy><izz>1.3e-5</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>
        </inertial>
        <collision name="bar">
          <pose>0 0 0 1.5707963 0 0</pose>
          <geometry><cylinder><radius>{2}</radius><length>{3}</length></cylinder></geometry>
          <surface>
            <contact><collide_bitmask>5</collide_bitmask><category_bitmask>4</category_bitmask></contact>
            <friction><ode><mu>0.9</mu><mu2>0.9</mu2></ode></friction>
          </surface>
        </collision>
        <visual name="bar">
          <pose>0 0 0 1.5707963 0 0</pose>
          <geometry><cylinder><radius>{2}</radius><length>{3}</length></cylinder></geometry>
          <material><diffuse>0.9 0.35 0.1 1</diffuse></material>
        </visual>
      </link>
      <joint name="dribbler" type="continuous">
        <parent>chassis</parent>
        <child>dribbler_bar</child>
        <axis><xyz>0 1 0</xyz><limit><effort>0.02</effort><velocity>1100</velocity></limit></axis>
      </joint>
)";

// It slows down by 5/7 * 0.0009 m / 21.35 mm * g = 0.3 m/s2 when it rolls.
constexpr const char* kSslBall = R"(    <model name="ball">
      <pose>0 0 {0:.5f} 0 0 0</pose>
      <link name="ball">
        <inertial><mass>{1}</mass><inertia><ixx>8.387e-6</ixx><iyy>8.387e-6</iyy><izz>8.387e-6</izz></inertia></inertial>
        <collision name="ball">
          <geometry><sphere><radius>{0:.5f}</radius></sphere></geometry>
          <surface>
            <contact><collide_bitmask>6</collide_bitmask><category_bitmask>4</category_bitmask></contact>
            <roboss:rolling_friction>0.0009</roboss:rolling_friction>
            <friction><ode><mu>0.9</mu><mu2>0.9</mu2></ode></friction>
          </surface>
        </collision>
        <visual name="ball">
          <geometry><sphere><radius>{0:.5f}</radius></sphere></geometry>
          <material><diffuse>1.0 0.45 0.05 1</diffuse></material>
        </visual>
      </link>
    </model>
)";

void add_ssl_wall(Text& text, const std::string& name, const FieldBox& box, std::string_view colour) {
    add_solid(text, name, box, "0.4", colour);
}

/// The boundary around the carpet, and goals in the colours of the teams that defend them first.
void add_boundary(Text& text, const SslField& f) {
    const double wall = soccer::kSslWall, high = soccer::kSslBoundaryHeight, goal = soccer::kSslGoalHeight;
    const double x = f.half_length + f.end_margin + wall / 2, y = f.half_width + f.side_margin + wall / 2;
    for (const int side : {-1, 1}) {
        const std::string name = side < 0 ? "right" : "left", end = side < 0 ? "west" : "east";
        const std::string_view colour = side < 0 ? "0.15 0.35 0.95" : "0.95 0.80 0.10";
        add_ssl_wall(text, "boundary_" + name, {0, side * y, high / 2, 2 * x + wall, wall, high},
                     "0.1 0.1 0.1");
        add_ssl_wall(text, "boundary_" + end, {side * x, 0, high / 2, wall, 2 * y + wall, high},
                     "0.1 0.1 0.1");
        const double back = side * (f.half_length + f.goal_depth + wall / 2),
                     middle = side * (f.half_length + f.goal_depth / 2);
        add_ssl_wall(text, end + "_goal_back", {back, 0, goal / 2, wall, 2 * (f.half_goal + wall), goal},
                     colour);
        for (const int post : {-1, 1})
            add_ssl_wall(text, end + (post < 0 ? "_goal_right" : "_goal_left"),
                         {middle, post * (f.half_goal + wall / 2), goal / 2, f.goal_depth, wall, goal},
                         colour);
    }
}

void add_ssl_lines(Text& text, const SslField& f) {
    int count = 0;
    const auto line = [&](double x, double y, double length, double width, double yaw = 0) {
        add_visual(text, fmt::format("line_{}", count++), {x, y, 0.0004, length, width, 0.0008, yaw},
                   kLineColour);
    };
    const double wide = soccer::kSslLine;
    line(0, 0, wide, 2 * f.half_width);
    line(0, 0, 2 * f.half_length, wide);
    constexpr int kPieces = 48;
    for (int i = 0; i < kPieces; ++i) {
        const double angle = 2 * kPi * i / kPieces;
        line(f.circle * fixed_cos(angle), f.circle * fixed_sin(angle), wide, 2 * kPi * f.circle / kPieces,
             angle);
    }
    for (const int side : {-1, 1}) {
        line(0, side * f.half_width, 2 * f.half_length + wide, wide);
        line(side * f.half_length, 0, wide, 2 * f.half_width + wide);
        line(side * (f.half_length - f.defence_depth), 0, wide, 2 * f.defence_half + wide);
        for (const int edge : {-1, 1})
            line(side * (f.half_length - f.defence_depth / 2), edge * f.defence_half, f.defence_depth, wide);
        line(side * (f.penalty_mark - f.half_length), 0, 0.03, 0.03);
    }
}

/// The cylinder with its flat front, as a prism of 14 corners.
void add_outline(Text& text) {
    add(text, "<geometry><polyline><height>{}</height>", SslRobot::kHeight - 0.005);
    constexpr int kArcs = 13;
    const double half = fixed_acos(SslRobot::kFront / SslRobot::kRadius);
    for (int i = 0; i <= kArcs; ++i) {
        const double angle = half + (2 * kPi - 2 * half) * i / kArcs;
        add(text, "<point>{:.5f} {:.5f}</point>", SslRobot::kRadius * fixed_cos(angle),
            SslRobot::kRadius * fixed_sin(angle));
    }
    add(text, "</polyline></geometry>");
}

void add_disc(Text& text, const std::string& name, double x, double y, double radius,
              std::string_view colour) {
    add(text,
        "        <visual name=\"{}\"><pose>{:.4f} {:.4f} {:.4f} 0 0 "
        "0</pose><geometry><cylinder><radius>{}</radius>"
        "<length>0.002</length></cylinder></geometry><material><diffuse>{} 1</diffuse></material></visual>\n",
        name, x, y, SslRobot::kHeight + 0.001, radius, colour);
}

/// A dot in the team's colour, and four that are the digits of the number in base 2: green 1, pink 0.
void add_marks(Text& text, bool blue, int number) {
    add_disc(text, "team", 0, 0, 0.025, blue ? "0.10 0.30 0.95" : "0.98 0.82 0.05");
    constexpr double kMarks[4][2] = {{0.035, 0.0545}, {-0.0545, 0.035}, {-0.0545, -0.035}, {0.035, -0.0545}};
    for (int i = 0; i < 4; ++i)
        add_disc(text, fmt::format("digit_{}", i), kMarks[i][0], kMarks[i][1], 0.020,
                 (number >> i & 1) != 0 ? "0.2 0.9 0.3" : "0.95 0.3 0.7");
}

constexpr const char* kRobotSurface =
    "<surface><contact><collide_bitmask>5</collide_bitmask><category_bitmask>4</category_bitmask></contact>"
    "<friction><ode><mu>0.2</mu><mu2>0.2</mu2></ode></friction></surface>";

void add_guides(Text& text) {
    const double length = SslRobot::kGuideTip - SslRobot::kFront + 0.02;
    for (const int side : {-1, 1}) {
        const FieldBox box{SslRobot::kGuideTip - length / 2,
                           side * (SslRobot::kBarLength + SslRobot::kGuide) / 2,
                           0.02,
                           length,
                           SslRobot::kGuide,
                           0.03};
        const std::string name = side < 0 ? "guide_right" : "guide_left";
        add(text, "        <collision name=\"{}\">{}{}</collision>\n", name, placed(box), kRobotSurface);
        add_visual(text, name, box, "0.10 0.10 0.11");
    }
}

void add_ssl_robot(Text& text, const SslField& field, bool blue, int number) {
    const soccer::Stand stand = soccer::ssl_stand(field, number, blue);
    add(text, "    <model name=\"{}_{}\">\n      <pose>{:.4f} {:.4f} 0 0 0 {}</pose>\n",
        blue ? "blue" : "yellow", number, blue ? stand.x : -stand.x, blue ? stand.y : -stand.y,
        blue ? "0" : "3.14159265");
    add(text, R"(      <link name="chassis">
        <inertial>
          <pose>0 0 0.045 0 0 0</pose>
          <mass>1.97</mass>
          <inertia><ixx>0.0072</ixx><iyy>0.0072</iyy><izz>0.0080</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>
        </inertial>
        <collision name="body">
          <pose>0 0 0.005 0 0 0</pose>
          )");
    add_outline(text);
    add(text, R"({}
        </collision>
        <visual name="body">
          <pose>0 0 0.005 0 0 0</pose>
          )",
        kRobotSurface);
    add_outline(text);
    add(text, "\n          <material><diffuse>{} 1</diffuse></material>\n        </visual>\n",
        blue ? "0.12 0.20 0.42" : "0.45 0.38 0.10");
    add_guides(text);
    add_marks(text, blue, number);
    add(text, "      </link>\n");
    for (std::size_t i = 0; i < SslRobot::kWheelAngles.size(); ++i) {
        const double angle = SslRobot::kWheelAngles[i], x = fixed_cos(angle), y = fixed_sin(angle);
        fmt::format_to(std::back_inserter(text), fmt::runtime(kSslWheel), i + 1, SslRobot::kWheelLever * x,
                       SslRobot::kWheelLever * y, angle, -y, x);
    }
    fmt::format_to(std::back_inserter(text), fmt::runtime(kDribbler), SslRobot::kBarX, SslRobot::kBarZ,
                   SslRobot::kBarRadius, SslRobot::kBarLength);
    add(text, "    </model>\n");
}

}  // namespace

std::string ssl_sdf(const SslField& field) {
    Text text;
    add(text, kHead, field.league, field.robots);
    add(text, kSoccerHead);
    add(text, kCarpet, 2 * (field.half_length + field.end_margin) + 1,
        2 * (field.half_width + field.side_margin) + 1);
    add_boundary(text, field);
    add_ssl_lines(text, field);
    add(text, "      </link>\n    </model>\n");
    for (const bool blue : {true, false})
        for (int i = 0; i < field.robots; ++i) add_ssl_robot(text, field, blue, i);
    fmt::format_to(std::back_inserter(text), fmt::runtime(kSslBall), soccer::kBallRadius, soccer::kBallMass);
    add(text, "  </world>\n</sdf>\n");
    return fmt::to_string(text);
}

}  // namespace roboss
