// Breadcrumbs: the models in <breadcrumb> elements become robots of the world that are stored until they are
// dropped (onboard_kinds/breadcrumbs.h).
#pragma once

#include <string>
#include <vector>

#include "sdf/conversion.h"

namespace roboss::sdf_import {

/// Name of the model in the <breadcrumb> of a plugin; empty: there is none.
std::string name_of_crumb(const Element& plugin);

/// The copies that one plugin of one model may drop.
struct CrumbSupply {
    std::string carrier;             // the model that drops them
    int supply = 0;                  // which of its BreadcrumbsSpec, from 0
    std::string topic;               // of the command
    Pose X_MC;                       // where a crumb appears, in the carrier's frame
    std::vector<std::string> names;  // of the copies
    int limit = -1;                  // as written; negative: none
};

/// A model of the file and its place in World::prototypes.
struct PrototypeSource {
    std::size_t prototype = 0;
    Element model;
};

/// Adds the crumbs of all models of the world. A plugin whose crumb cannot be read is not run (reported).
std::vector<CrumbSupply> add_crumbs(const std::vector<PrototypeSource>& sources, const Import& import,
                                    World& world);

}  // namespace roboss::sdf_import
