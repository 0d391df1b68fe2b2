// What the worlds of both soccer leagues have alike, as text: the head, and boxes (walls, lines, parts of
// robots).
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "app/text.h"

namespace roboss {

/// Lengths in m, rad about the vertical.
struct FieldBox {
    double x = 0, y = 0, z = 0, length = 0, width = 0, height = 0, yaw = 0;
};

/// From the world's name to the link of the field; both leagues step alike.
inline constexpr const char* kSoccerHead = R"(  <world name="soccer">
    <physics name="step" type="ignored">
      <max_step_size>0.0020833333333333333</max_step_size>
      <real_time_factor>1</real_time_factor>
    </physics>
    <gravity>0 0 -9.81</gravity>
    <model name="field">
      <static>true</static>
      <link name="link">
)";

inline std::string placed(const FieldBox& box) {
    return fmt::format(
        "<pose>{:.5f} {:.5f} {:.5f} 0 0 {:.5f}</pose><geometry><box><size>{:.5f} {:.5f} {:.5f}"
        "</size></box></geometry>",
        box.x, box.y, box.z, box.yaw, box.length, box.width, box.height);
}

inline void add_visual(Text& text, const std::string& name, const FieldBox& box, std::string_view colour) {
    add(text, "        <visual name=\"{}\">{}<material><diffuse>{} 1</diffuse></material></visual>\n", name,
        placed(box), colour);
}

/// A box that is seen, with friction of 0.3.
inline void add_solid(Text& text, const std::string& name, const FieldBox& box, std::string_view restitution,
                      std::string_view colour) {
    add(text,
        "        <collision "
        "name=\"{}\">{}<surface><friction><ode><mu>0.3</mu><mu2>0.3</mu2></ode></friction><bounce>"
        "<restitution_coefficient>{}</restitution_coefficient></bounce></surface></collision>\n",
        name, placed(box), restitution);
    add_visual(text, name, box, colour);
}

}  // namespace roboss
