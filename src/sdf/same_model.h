// Finds models that are equal but for name and pose: the fast pass that lets 10000 equal cars be read once.
#pragma once

#include <cstdint>

#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// Equal for models that are same_model(); rarely equal for others.
std::uint64_t model_hash(const Element& model);

/// The same file and the same elements, attributes and text, leaving out the models' own name, pose and
/// placement frame.
bool same_model(const Element& a, const Element& b);

}  // namespace roboss::sdf_import
