// A world may hold several <physics> profiles; one of them gives step, pace and accuracy.
#pragma once

#include "sdf/conversion.h"

namespace roboss::sdf_import {

/// Reads the profile called `wanted` (empty: the one with default="true", else the first) and the gravity.
void read_physics(const Element& world, const std::string& wanted, Import& import, World& out);

/// <roboss:accuracy setting="high"><tolerance>1e-10</tolerance>...; the names are judged when compiling.
AccuracySpec read_accuracy(const Element& element, const Import& import);

/// <roboss:precision> in <world> or <physics>: float or double.
void read_precision(const Element& parent, const Import& import, World& out);

/// The number of a child, which must be greater than 0.
double positive_number(const Element& parent, const char* child, double usual, const Import& import);

}  // namespace roboss::sdf_import
