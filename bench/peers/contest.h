// All engines on one scene: built one after the other, then stepped in blocks by turns, so that whatever else
// the machine does meets them all.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace roboss::bench {

struct ContestOptions {
    std::vector<std::string> engines;  // names; empty: all
    int settle = 200, blocks = 9;
    int steps = 0;         // counted; 0: a thousand, more of few robots
    double accuracy = 1;   // EngineOptions
    double limit_s = 120;  // of counted steps an engine and scene; less of them where it would take longer
    double start_limit_s = 40;  // of building and settling; beyond, the engine is left out

    /// Of few robots so many that a block is not over in a moment of whatever else the machine does.
    int steps_of(std::size_t robots) const {
        return steps > 0 ? steps : std::max(1000, 100000 / static_cast<int>(robots));
    }
    /// Steps of one block, of so many in all: rounded up, so that none of these is missing.
    int block_of(int all) const { return (all + blocks - 1) / blocks; }
};

/// A line of the table. Times in microseconds for one step of one robot.
struct Row {
    std::string scene, engine, settings;
    std::size_t robots = 0;
    std::string skipped;                              // why there are no figures; empty: there are
    int steps = 0;                                    // counted
    double us_median = 0, us_least = 0, us_most = 0;  // of the blocks
    double ratio = 0;                                 // to RoBOSS in the same contest; 0: not known
    double real_time_factor = 0;                      // simulated time by CPU time; 0: not known
    double build_s = 0, bytes_per_robot = 0;
    bool right = false;
    std::string verdict;

    /// From those of the blocks; there must be one.
    void set_times(const std::vector<double>& us);
};

/// Between these engines; ratios are to the first.
std::vector<Row> hold_contest(const SceneKind& kind, std::size_t robots, const ContestOptions& options,
                              std::span<const EngineKind> engines = contestants());

/// RoBOSS alone, as `roboss run` steps: cars in windows and islands, on one thread and on two, by the wall.
std::vector<Row> compare_threads(std::size_t cars, const ContestOptions& options);

}  // namespace roboss::bench
