// What must hold of every random world. A property is one file with a function and one row of the table in
// property.cpp; roboss-fuzz and the tests run the same.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fuzz/scene.h"

namespace roboss::fuzz {

/// What came of one seed.
struct Finding {
    bool failed = false;
    double figure = 0;   // what is bounded, the worst of the run; infinite: a state was not finite
    Tick tick = 0;       // of that
    std::string text{};  // what happened, if it failed
};

struct Request {
    Setting setting;
    double seconds = 0;
    /// Receives a line for each tick; empty: nobody wants them.
    std::function<void(const std::string&)> print_line{};
};

struct Property {
    std::string name;
    std::string claim;   // with its bound
    std::string figure;  // what Finding::figure is
    std::vector<std::string> kinds;
    std::vector<double> steps_s, spins, speeds;  // that seeds take by turns; speeds: m/s, of shots
    double seconds = 10;                         // simulated
    Finding (*run)(const Request&) = nullptr;

    /// The setting of a seed: kinds by turns, steps, spins and speeds so that as many consecutive seeds as
    /// there are combinations have every one.
    Setting setting(std::uint64_t seed) const;
};

std::span<const Property> properties();
/// nullptr: there is none of that name.
const Property* find_property(const std::string& name);

/// What replays a seed, as one types it.
std::string replay_command(const Property& property, const Request& request);

/// Names of the scenes for which `wanted` holds.
std::vector<std::string> kinds_where(bool (*wanted)(const SceneKind&));

// The bounds.
inline constexpr double kEnergyGrowthMost = 1e-3;   // of itself
inline constexpr double kStartErrorMost = 1e-6;     // m or rad
inline constexpr double kMomentumDriftMost = 1e-6;  // of what the links' momenta amount to
// m, and m/s since the first fell asleep: how far sleepers are from where they would be
inline constexpr double kSleepersApartMost = 2e-3, kSleepersDriftMost = 1e-3;
inline constexpr double kJudgedBelow =
    0.02;  // m/s or rad/s: while a base or joint is faster, sleepers are not judged
// Kinetic energy beyond that of a fall: in those of the speed of recovery, as a share of that of the fall
// (the error of a step of first order), and as a height, m.
inline constexpr double kThrownMost = 4, kFallErrorMost = 0.05, kThrownHeightMost = 2e-3;

Finding run_energy(const Request& request);
Finding run_momentum(const Request& request);
Finding run_start(const Request& request);
Finding run_finite(const Request& request);
Finding run_asleep(const Request& request);
Finding run_thrown(const Request& request);
Finding run_ghost(const Request& request);
Finding run_tunnel(const Request& request);
Finding run_hash(const Request& request);
Finding run_cluster(const Request& request);
Finding run_branches(const Request& request);

}  // namespace roboss::fuzz
