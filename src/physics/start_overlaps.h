// Overlaps at the start that are so deep that pushing them apart would throw a robot. `roboss check` and
// `roboss run` warn of them; a step does not use this file.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "model/model.h"
#include "model/robot_state.h"

namespace roboss {

/// An overlap is told if it is deeper than this, or than kDeepShare of the smaller of the two shapes.
inline constexpr double kDeepFrom = 0.01;  // m
inline constexpr double kDeepShare = 0.1;  // of the shape's largest extent

/// Robots that start in each other or in the scenery, those of a type in the same thing together.
struct StartOverlap {
    RobotId robot;            ///< the deepest of them
    LinkId link;              ///< of it, the deepest in `in`
    std::string in;           ///< name of the model or robot that it lies in; its own: its links overlap
    std::string link_in;      ///< of that, a link
    bool is_scenery = false;  ///< `in` is scenery
    double depth = 0;         ///< m, how deep
    std::size_t links = 0;    ///< links of that robot that lie too deep in it
    std::size_t robots = 0;   ///< robots of its type that lie in such things, itself among them
};

/// The overlaps at these states, of which at least one robot is `first` or behind it; the deepest first.
/// states[i]: of RobotId i.
std::vector<StartOverlap> find_overlaps(const Model& model, std::span<const RobotState> states,
                                        std::size_t first = 0);

/// Warnings about the start of the Model. `world`: it was compiled from, for places; nullptr: not known.
void report_overlaps(const Model& model, const World* world, Diagnostics& diagnostics);
/// The same of robots that came to a run, from `first` on.
void report_overlaps(const Model& model, std::span<const RobotState> states, std::size_t first,
                     Diagnostics& diagnostics);

}  // namespace roboss
