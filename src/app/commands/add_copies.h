// Copies for `roboss control add`: a number of them on a grid, or those of a file.
#pragma once

#include <string>

#include "core/result.h"

namespace roboss {

/// What the options of `roboss control add` say of copies.
struct CopyOptions {
    int count = 1;
    std::string grid;   // "dx dy [columns]", m; empty: 1 m apart
    std::string poses;  // a file of lines "NAME x y z roll pitch yaw"; empty: none
    std::string pose;   // of the first copy: "x y z roll pitch yaw"
    std::string name;   // copies are called NAME_0, NAME_1 ...; empty: by the file
    std::string file;   // SDF, URDF or MJCF
};

/// Lines "NAME x y z roll pitch yaw" for each copy (client/control_text.h). Errors: bad-grid, bad-pose,
/// no-file.
Result<std::string> copies_text(const CopyOptions& options);

}  // namespace roboss
