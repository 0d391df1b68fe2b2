// Makes a ModelSpec of a model that is read. Nested models are flattened, their links and joints named
// "inner::link".
#pragma once

#include "sdf/conversion.h"

namespace roboss::sdf_import {

struct ModelTree;

/// `is_static`: what the model's place in the world says (an <include> may override the model's own word).
ModelSpec convert_model(const ModelTree& model, bool is_static, const Import& import);

}  // namespace roboss::sdf_import
