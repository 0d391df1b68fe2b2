// Makes a ModelSpec of a model that libsdformat has read: frames and joints from libsdformat, numbers from
// the source. Nested models are flattened, their links and joints named "inner::link".
#pragma once

#include <optional>
#include <string>

#include "sdf/conversion.h"

namespace roboss::sdf_import {

class ReadModel;

/// `is_static`: what the model's place in the world says (an <include> may override the model's own word).
ModelSpec convert_model(const ReadModel& read, bool is_static, const Import& import);

/// The pose in the model frame of "link", "frame", "joint", "nested" or "nested::link" at zero joints;
/// nullopt: unknown.
std::optional<Pose> pose_in_model(const ReadModel& read, const std::string& scoped_name);

}  // namespace roboss::sdf_import
