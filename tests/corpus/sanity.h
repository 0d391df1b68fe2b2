// Sanity of a run that nobody commands: each robot moves by no more than gravity and its motors explain, and
// what sleeps at the end is at rest. The yardstick of tools/check_corpus.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/model.h"
#include "model/robot_state.h"

namespace roboss::corpus {

// The bounds.
inline constexpr double kGainMost = 0.2;           // J/kg beyond what explains it: a hop of 2 cm
inline constexpr double kFallErrorMost = 0.05;     // of the height that was lost
inline constexpr double kSleeperMovesMost = 3e-3;  // m, in the second after the end, awake

/// The robots that touched each other in the run, directly or by way of others.
struct Figures {
    std::string robot;         // the first of them
    double gain = 0;           // J/kg: most energy beyond that of the start and what motors put in
    double explained = 0;      // J/kg: by pushing apart what lay in each other, and by errors of a fall
    double time_s = 0;         // of the most
    double speed = 0;          // m/s, of the fastest link's centre
    double depth = 0;          // m, of the deepest contact
    double sleeper_moves = 0;  // m: how far a sleeper of the end moved in the second after it, awake
    bool driven = false;       // wind, water, rotors, belts or scripts act on them: the gain says nothing

    bool is_sane() const;
};

struct Sanity {
    std::vector<Figures> groups;  // the worst first
    double not_finite_s = -1;     // when a state was no number; negative: never
    std::size_t robots = 0, asleep = 0;

    bool is_sane() const;
};

/// Steps the world so long. `awake`: the same world, compiled so that nothing sleeps.
Sanity judge(const Model& model, const Model& awake, double seconds);

}  // namespace roboss::corpus
