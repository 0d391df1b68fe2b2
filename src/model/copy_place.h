// Where a copy of something stands in the world, and what it is called there.
#pragma once

#include <string>

#include "math/pose.h"

namespace roboss {

/// A place for a copy of the models of a file.
struct CopyPlace {
    std::string name;  ///< in the world; empty: the name in the file
    Pose X_WA;         ///< m, of the file's world frame in the world
    /// Compares all members.
    friend bool operator==(const CopyPlace&, const CopyPlace&) = default;
};

}  // namespace roboss
