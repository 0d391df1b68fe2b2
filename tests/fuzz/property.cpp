#include "fuzz/property.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "fuzz/shot.h"

namespace roboss::fuzz {
namespace {

/// Those that are meant to pass, or all.
std::vector<std::string> shots(bool passes_only) {
    std::vector<std::string> names;
    for (const ShotKind& kind : shot_kinds())
        if (kind.passes || !passes_only) names.emplace_back(kind.name);
    return names;
}

std::vector<Property> make_properties() {
    const std::vector<double> steps{1e-3, 2e-3, 4e-3}, spins{1, 10, 30, 100};
    const auto passive = kinds_where([](const SceneKind& k) { return k.passive; });
    const auto isolated = kinds_where([](const SceneKind& k) { return k.isolated; });
    const auto any = kinds_where([](const SceneKind&) { return true; });
    return {
        {"energy",
         "the energy of a passive system never grows by more than 1e-3 of itself",
         "largest growth, E(t) / lowest E before - 1",
         passive,
         steps,
         spins,
         {0},
         10,
         run_energy},
        {"momentum",
         "linear and angular momentum stay within 1e-6 where nothing acts from outside",
         "largest drift, relative to the sum of the links' own momenta",
         isolated,
         steps,
         spins,
         {0},
         10,
         run_momentum},
        {"finite",
         "no state becomes infinite or not a number; the invariants of states hold after each tick",
         "fastest base or joint, rad/s or m/s",
         any,
         {1e-3, 2e-3, 4e-3, 5e-3},
         spins,
         {0},
         5,
         run_finite},
        {"start",
         "joints start within their limits and behind their leaders; a robot stands on the ground",
         "largest distance from that, m or rad",
         {"tree", "loop", "coupled"},
         {1e-3},
         {0},
         {0},
         0,
         run_start},
        {"ghost",
         "a robot that passes clear of everything is not pushed, not by one bit",
         "largest change of a velocity, m/s or rad/s",
         shots(true),
         steps,
         {0, 20, 100},
         {2, 5, 20, 100, 1000},
         0,
         run_ghost},
        {"tunnel",
         "nothing passes through anything",
         "deepest overlap, relative to what is allowed",
         shots(false),
         steps,
         {0, 20, 100},
         {2, 5, 20, 50, 100},
         0,
         run_tunnel},
    };
}

/// Those of robots that start overlapping.
std::vector<Property> make_overlap_properties() {
    const std::vector<double> steps{1e-3, 2e-3, 4e-3};
    const auto overlapping = kinds_where([](const SceneKind& k) { return k.overlaps; });
    return {
        {"asleep",
         "robots that start overlapping end where they would without sleep: within 2 mm, and 1 mm/s asleep",
         "largest distance from there, of the bound",
         overlapping,
         steps,
         {0},
         {0},
         4,
         run_asleep},
        {"thrown",
         "what starts in the ground gets no more speed than its surfaces give recovery, and by falling",
         "largest kinetic energy beyond that of the fall, of the bound",
         {"sunk"},
         steps,
         {0},
         {0},
         2,
         run_thrown},
    };
}

/// Those of whole runs.
std::vector<Property> make_run_properties() {
    const auto any = kinds_where([](const SceneKind&) { return true; });
    return {
        {"hash",
         "the state hash is the same for any threads, lanes, Simulators, windows and grouping",
         "configurations of five whose hash differs from the first",
         any,
         {1e-3, 2e-3, 4e-3, 5e-3},
         {1, 10, 30, 100},
         {0},
         0.5,
         run_hash},
        {"cluster",
         "a cluster with faults and losses ends with the state hash of the undisturbed run",
         "Simulators lost",
         any,
         {1e-3, 2e-3, 4e-3, 5e-3},
         {1, 10, 30},
         {0},
         0.3,
         run_cluster},
        {"branches",
         "a journal of additions, removals, rewinds, resets and saves replays through each lineage with the "
         "committed hashes",
         "states compared",
         any,
         {1e-3, 2e-3, 4e-3, 5e-3},
         {1, 10},
         {0},
         0.3,
         run_branches},
    };
}

std::string text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", value);
    return buffer;
}

}  // namespace

std::vector<std::string> kinds_where(bool (*wanted)(const SceneKind&)) {
    std::vector<std::string> names;
    for (const SceneKind& kind : scene_kinds())
        if (wanted(kind)) names.emplace_back(kind.name);
    return names;
}

std::span<const Property> properties() {
    static const std::vector<Property> all = [] {
        std::vector<Property> list = make_properties();
        std::ranges::move(make_overlap_properties(), std::back_inserter(list));
        std::ranges::move(make_run_properties(), std::back_inserter(list));
        return list;
    }();
    return all;
}

const Property* find_property(const std::string& name) {
    for (const Property& property : properties())
        if (property.name == name) return &property;
    return nullptr;
}

Setting Property::setting(std::uint64_t seed) const {
    const std::uint64_t kind = seed % kinds.size();
    // Not in their own order, and each kind elsewhere, so that few seeds already have much of all. 7 divides
    // no number of combinations, so a kind meets each of them once before it meets one again.
    constexpr std::uint64_t kStride = 7;
    std::uint64_t turn = kStride * (seed / kinds.size() + kind);
    const auto next = [&](const std::vector<double>& choices) {
        const double choice = choices[turn % choices.size()];
        turn /= choices.size();
        return choice;
    };
    turn %= steps_s.size() * spins.size() * speeds.size();
    Setting s;
    s.seed = seed, s.kind = kinds[kind];
    s.dt_s = next(steps_s), s.spin = next(spins), s.speed = next(speeds);
    return s;
}

std::string replay_command(const Property& property, const Request& request) {
    const Setting& s = request.setting;
    std::string command = "roboss-fuzz --property " + property.name + " --seed " + std::to_string(s.seed) +
                          " --kind " + s.kind + " --dt " + text(s.dt_s) + " --spin " + text(s.spin);
    if (property.speeds.size() > 1) command += " --speed " + text(s.speed);
    if (property.seconds > 0) command += " --seconds " + text(request.seconds);
    return command;
}

}  // namespace roboss::fuzz
