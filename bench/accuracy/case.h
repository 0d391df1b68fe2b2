// An accuracy case: a motion whose truth is known from elsewhere (a closed form, a converged reference,
// common sense about things at rest), what is read off it, and how far each figure may be from the truth. A
// case is written once and run on RoBOSS and on every peer.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engines/engine.h"

namespace roboss::bench {

/// An engine as one row of figures asks for it.
struct Contender {
    const EngineKind* kind = nullptr;
    double dt_s = 1e-3;
    double accuracy = 1;                                          // EngineOptions::accuracy
    double patience_s = std::numeric_limits<double>::infinity();  // wall time before a case is cut short
};

/// Passes if |figure - target| <= bound, without a target if figure <= bound; without a bound it is only
/// stated.
struct Quantity {
    std::string name;
    std::string unit;
    std::optional<double> bound = {};
    std::optional<double> target = {};
};

struct Outcome {
    std::vector<double> figures;                        // one a Quantity; not a number: the state blew up
    std::string remark = {};                            // e.g. that it was cut short
    std::vector<std::pair<double, double>> trace = {};  // time and value, for a picture
    double share = 1;                                   // simulated, of the time asked for
    bool possible = true;                               // false: the engine cannot express the world
};

struct Case {
    std::string name;  // for --case
    std::string title;
    std::string oracle;  // what the truth is and where it comes from
    std::vector<Quantity> quantities;
    std::function<Outcome(const Contender&)> run;
    bool from_issue = true;      // false: beyond the list of must-haves
    bool ours_only = false;      // asks for what no peer has
    bool of_the_kernel = false;  // asks the double kernel itself, not an engine
    bool also_coarse = false;    // in the second table, at 2 ms
    bool slow = false;           // some ten seconds: not for every test run
    std::string remark = {};     // what a reader should know about the figures
    double dt_s = 1e-3;
};

bool passes(const Quantity& quantity, double figure);

std::vector<Case> free_motion_cases();
std::vector<Case> dynamics_cases();
std::vector<Case> convergence_cases();
std::vector<Case> slope_cases();
std::vector<Case> impact_cases();
std::vector<Case> car_cases();
std::vector<Case> resting_cases();
std::vector<Case> gripper_cases();
std::vector<Case> loop_cases();
std::vector<Case> motor_cases();
std::vector<Case> walker_cases();
std::vector<Case> random_cases();

/// All of them, in the order of the table.
std::vector<Case> all_cases();

}  // namespace roboss::bench
