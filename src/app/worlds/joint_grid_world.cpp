// Joints come in an order that makes the tree a comb: of the joints around a loop, the last in the file is
// the one that closes it. So no link is further from the base than a row and a column.
#include "app/worlds/joint_grid_world.h"

#include <fmt/format.h>

#include "app/text.h"

namespace roboss {
namespace {

constexpr double kSpacing = 0.1, kHeight = 2;  // m
constexpr double kBowl = 0.6;                  // depth over half the length

struct Place {
    int row = 0, column = 0;
};

std::string link_name(const Place& place) {
    return fmt::format("plate_{}_{}", place.row, place.column);
}

/// m, of one of `count` plates in a row or column.
double depth(int at, int count) {
    return count > 1 ? kBowl * kSpacing * at * (count - 1 - at) / (count - 1) : 0.0;
}

double height(const JointGridOptions& o, const Place& place) {
    return -depth(place.row, o.rows) - depth(place.column, o.columns);
}

/// A plate of 50 g.
void add_link(Text& text, const JointGridOptions& o, const Place& place) {
    constexpr const char* kBox = "<geometry><box><size>0.08 0.08 0.02</size></box></geometry>";
    add(text, "      <link name=\"{}\">\n        <pose>{:.2f} {:.2f} {:.6f} 0 0 0</pose>\n", link_name(place),
        kSpacing * place.column, kSpacing * place.row, height(o, place));
    add(text,
        "        <inertial><mass>0.05</mass><inertia><ixx>2.83e-5</ixx><iyy>2.83e-5</iyy><izz>5.33e-5</izz>"
        "</inertia></inertial>\n");
    add(text,
        "        <collision name=\"plate\">{0}</collision>\n        <visual name=\"plate\">{0}</visual>\n",
        kBox);
    add(text, "      </link>\n");
}

void add_ball(Text& text, const std::string& parent, const std::string& child, double x, double y, double z) {
    add(text, "      <joint name=\"{0}_{1}\" type=\"ball\"><pose>{2:.2f} {3:.2f} {4:.6f} 0 0 0</pose>",
        parent, child, x, y, z);
    add(text,
        "<parent>{0}</parent><child>{1}</child><axis><dynamics><damping>0.001</damping></dynamics></axis>"
        "</joint>\n",
        parent, child);
}

/// Half-way between two plates.
void join(Text& text, const JointGridOptions& o, const Place& a, const Place& b) {
    add_ball(text, link_name(a), link_name(b), 0.5 * kSpacing * (a.column - b.column),
             0.5 * kSpacing * (a.row - b.row), 0.5 * (height(o, a) - height(o, b)));
}

void add_joints(Text& text, const JointGridOptions& o) {
    add_ball(text, "world", link_name({0, 0}), 0, 0, 0);
    for (int r = 1; r < o.rows; ++r) join(text, o, {r - 1, 0}, {r, 0});
    for (int r = 0; r < o.rows; ++r)
        for (int c = 1; c < o.columns; ++c) join(text, o, {r, c - 1}, {r, c});
    for (int r = 1; r < o.rows; ++r)
        for (int c = 1; c < o.columns; ++c) join(text, o, {r - 1, c}, {r, c});
    if (o.columns > 1) add_ball(text, "world", link_name({0, o.columns - 1}), 0, 0, 0);
}

}  // namespace

std::string joint_grid_sdf(const JointGridOptions& o) {
    Text text;
    add(text, R"(<?xml version="1.0"?>
<!-- A net of {0} by {1} plates with a ball joint between neighbours: one robot with many loops. Made by:
     roboss-world joint-grid, rows {0}, columns {1}. Change the generator, not this file. -->
<sdf version="1.9">
  <world name="joint_grid">
    <physics name="2ms" type="ode"><max_step_size>0.002</max_step_size><real_time_factor>1</real_time_factor></physics>
    <model name="net">
      <pose>0 0 {2} 0 0 0</pose>
)",
        o.rows, o.columns, kHeight);
    for (int r = 0; r < o.rows; ++r)
        for (int c = 0; c < o.columns; ++c) add_link(text, o, {r, c});
    add_joints(text, o);
    add(text, "    </model>\n  </world>\n</sdf>\n");
    return fmt::to_string(text);
}

}  // namespace roboss
