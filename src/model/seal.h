// The last step of making a Model, by compile and by the decoder of its bytes: what follows from all its
// numbers. And what every reader of a Model relies on, checked where one comes from outside.
#pragma once

#include "model/model.h"

namespace roboss {

/// Computes the types' paths and hashes, the tree over the scenery, and the Model's hash.
void seal(Model& model);

/// Whether every index of the Model points to something and every count fits; "" if so, else what does not.
/// Call it before seal() and before anything else reads the Model.
std::string broken_part(const Model& model);

}  // namespace roboss
