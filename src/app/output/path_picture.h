// A picture of where robots went: their paths over the static shapes of the world, seen from above, as SVG.
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "model/model.h"

namespace roboss {

struct RobotPath {
    std::string robot;
    std::vector<Vec3> points_W;  // m, in the order of time
};

struct PictureOptions {
    std::string title;
    std::string subtitle;
    double width_px = 1200;
};

/// SVG text. Planes are left out; a shape that stands higher is painted darker. A path's length is that in
/// the ground plane.
std::string path_picture(const Model& model, const std::vector<RobotPath>& paths,
                         const PictureOptions& options);

Result<> write_path_picture(const std::string& file, const Model& model, const std::vector<RobotPath>& paths,
                            const PictureOptions& options);

}  // namespace roboss
