// <actor>: a kinematic body on a timetable. It becomes a model with a link and with its script, so that all
// the rest of the importer treats it as one.
#pragma once

#include "sdf/conversion.h"

namespace roboss::sdf_import {

/// Makes models of the actors under the root and in its worlds. What is only drawn (skin, animation) goes; an
/// actor without links gets one with the size of a person.
void make_models_of_actors(pugi::xml_node root);

/// Reads the script of such a model, a <roboss:actor>.
void convert_actor(const Element& script, const Import& import, ModelSpec& model);

}  // namespace roboss::sdf_import
