// Placements: every model of a world with its name and its pose as written (relative to whatever it says),
// from <model>, <include> and <population>.
#pragma once

#include <string>
#include <vector>

#include "sdf/conversion.h"
#include "sdf/include_store.h"

namespace roboss::sdf_import {

struct Placement {
    std::string name;
    Element model;
    Pose X_RP;                    // placement frame (else the model frame) in the frame it is relative to
    std::string relative_to;      // empty: the world
    std::string placement_frame;  // empty: the model frame
    bool is_static = false;
    Element where;
    bool left_out = false;  // something in it is wrong (reported)
};

/// All models under `world` (a <world>, or the <sdf> of a file with a model only). What is wrong is reported,
/// as errors of models that are left out.
std::vector<Placement> collect_placements(const Element& world, IncludeStore& includes, const Import& import);

/// The placement of a <model> or <include>; nothing if an include leads nowhere.
std::optional<Placement> placement_of(const Element& element, IncludeStore& includes, const Import& import);

/// The poses (of clone i in the population's frame of reference) that a <population> asks for; empty if it is
/// wrong (reported).
std::vector<Pose> population_poses(const Element& population, const Import& import);

}  // namespace roboss::sdf_import
