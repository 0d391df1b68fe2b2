// What was measured, and what writes it down: as a page for people, as JSON for programs, as a picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "accuracy/case.h"

namespace roboss::bench {

inline constexpr const char* kOurs = "RoBOSS";
inline constexpr const char* kFloats = "RoBOSS-float";  // ours, in a table of its own

/// One case on one engine.
struct Result {
    std::size_t which = 0;  // in Results::cases
    std::string engine;
    double dt_s = 0;
    bool coarse = false;  // of the second table
    Outcome outcome;
    double wall_s = 0;
};

struct EngineNote {
    std::string name, version, settings;
};

struct Results {
    std::vector<Case> cases;
    std::vector<EngineNote> engines;   // those of the tables side by side
    std::optional<EngineNote> floats;  // of the table of floats, if it was measured
    std::vector<Result> results;
    std::string commit, compiler, processor;
};

/// nullptr if it was not measured.
const Result* find(const Results& all, std::size_t which, const std::string& engine, bool coarse);

/// Whether every figure of ours at the cases' own steps keeps its bound.
bool all_ours_pass(const Results& all);

std::string to_markdown(const Results& all, const std::string& picture);
std::string to_json(const Results& all);
/// Energy error of the swinging arm over time, a curve an engine; empty if that case was not measured.
std::string to_svg(const Results& all);

}  // namespace roboss::bench
