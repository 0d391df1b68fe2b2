// Equalities and contact rules between bodies.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "mjcf/robots.h"

namespace roboss::mjcf {

/// Pairs of bodies of different fixed robots that an equality ties: they become one robot.
std::vector<std::pair<std::size_t, std::size_t>> tied_bodies(const Tree& tree,
                                                             std::span<const Reading> parts);

/// <connect>: a ball joint, <weld>: a fixed joint, <joint>: a joint that follows another one.
void read_equalities(Robots& robots, std::span<const Reading> parts);

/// Geoms of <pair>s get a bit of the masks for each pair. Before the robots are made.
void read_contact_pairs(Tree& tree, std::span<const Reading> parts);
/// <exclude>: links that do not touch each other.
void read_contact_excludes(Robots& robots, std::span<const Reading> parts);

}  // namespace roboss::mjcf
