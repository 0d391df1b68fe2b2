// What the settings of the accuracy cost, and what they give: fast, standard and high, on scenes in which
// many touch.
#pragma once

#include <string>
#include <vector>

#include "peers/contest.h"

namespace roboss::bench {

/// A line of the price list. Figures are the worst of the run, the counts means.
struct Price {
    std::string scene, setting;
    std::size_t robots = 0;
    Row cost;              // of a contest in which the settings step by turns
    SolverFigures solver;  // of all steps, the settling ones included
    double overlap_m = 0;  // deepest between two robots at the end
    std::string skipped;   // why there are no figures; empty: there are
};

/// Of these scenes, or of shapes (3000), city (2000 cars) and spiders (200).
std::vector<Price> make_price_list(const std::vector<std::string>& scenes,
                                   const std::vector<std::size_t>& robots, const ContestOptions& options);

void print_price_list(const std::vector<Price>& prices);

/// With commit, compiler, processor. False, with a message printed, if the file cannot be written.
bool write_json(const std::string& path, const std::vector<Price>& prices);

}  // namespace roboss::bench
