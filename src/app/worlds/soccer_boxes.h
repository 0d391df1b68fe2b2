// Boxes of a soccer field as text of a world file: walls, lines, parts of robots.
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

}  // namespace roboss
