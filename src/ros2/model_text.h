// ModelText: what the text of a model's description says at its top: format, name, and where the model stands
// in its own file. The run reads the text itself; this is only what services must know before.
#pragma once

#include <string>

#include "core/result.h"
#include "math/pose.h"

namespace roboss::ros2 {

/// See the top of the file.
struct ModelText {
    std::string format;  ///< "sdf", "urdf", "mjcf"; empty: another one
    std::string name;    ///< of its only model; empty: it has none or several
    Pose X_FM;           ///< m, of its only model in the file
};

/// Reads it. An Error, "bad-model": it is no XML.
Result<ModelText> read_model_text(const std::string& text);

/// A description in SDF that consists of the model at this URI, which the run looks up.
std::string include_of(const std::string& uri);

}  // namespace roboss::ros2
