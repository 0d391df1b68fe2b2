// roboss-peers: RoBOSS beside other engines on the same scenes, in the same run.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>

#include "app/commands/numbers.h"
#include "peers/agreement.h"
#include "peers/contest.h"
#include "peers/price_list.h"
#include "peers/rows.h"
#include "peers/trial.h"

namespace {

using namespace roboss::bench;
using roboss::positive_number;

struct BenchOptions {
    std::vector<std::string> scenes;
    std::vector<std::size_t> robots;
    ContestOptions contest;
    bool quick = false, alone = false, check = false, price_list = false;
    std::string json;
};

bool is_wanted(const std::vector<std::string>& wanted, const std::string& name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
}

std::string help() {
    std::string text =
        "RoBOSS beside other physics engines: the same scenes, the same run, one thread, dt 2 ms.\n"
        "Engines step by turns, each in a process of its own; counted is the CPU time of their steps, for\n"
        "one step of one robot. Results are checked, and rows that are wrong say so.\n\nScenes:\n";
    for (const SceneKind& scene : scenes()) {
        text += "  " + scene.name + ": " + scene.what + " (";
        for (std::size_t i = 0; i < scene.robots.size(); ++i)
            text += (i > 0 ? ", " : "") + std::to_string(scene.robots[i]);
        text += ")\n";
    }
    text += "  threads: the 2000 cars as `roboss run` steps them, on one thread and on two\n\nEngines here:";
    for (const EngineKind& engine : contestants()) text += " " + engine.name;
    return text +
           "\n\nExamples:\n  roboss-peers --quick\n  roboss-peers --scene city --robots 500 --engine "
           "RoBOSS --alone --steps 1000";
}

/// One engine in this process, block by block: for profilers and debuggers.
int run_alone(const SceneKind& kind, std::size_t robots, const EngineKind& engine,
              const ContestOptions& options) {
    const Scene scene = kind.make(robots);
    Trial trial(engine, scene, options.accuracy);
    trial.run(options.settle);
    const int ticks = options.block_of(options.steps_of(robots));
    for (int block = 0; block < options.blocks; ++block) {
        const Spent spent = trial.run(ticks);
        const double steps = static_cast<double>(ticks) * static_cast<double>(robots);
        std::printf("%s: %.3f us a robot-step (CPU), %.3f (wall)\n", trial.engine().name().c_str(),
                    1e6 * spent.cpu / steps, 1e6 * spent.wall / steps);
    }
    const Verdict verdict = trial.judge();
    std::printf("%s: %s; %.0f bytes a robot\n", verdict.good ? "right" : "WRONG", verdict.text.c_str(),
                trial.memory_bytes() / static_cast<double>(robots));
    return verdict.good ? 0 : 1;
}

int run_all_alone(const BenchOptions& options) {
    int result = 0;
    for (const SceneKind& scene : scenes())
        for (const EngineKind& engine : contestants())
            if (is_wanted(options.scenes, scene.name) && is_wanted(options.contest.engines, engine.name))
                for (std::size_t robots : options.robots.empty() ? scene.robots : options.robots)
                    result |= run_alone(scene, robots, engine, options.contest);
    return result;
}

std::vector<Row> run_contests(const BenchOptions& options) {
    std::vector<Row> rows;
    const auto add = [&](const std::vector<Row>& more) { rows.insert(rows.end(), more.begin(), more.end()); };
    for (const SceneKind& scene : scenes()) {
        if (!is_wanted(options.scenes, scene.name)) continue;
        for (std::size_t robots : options.robots.empty() ? scene.robots : options.robots) {
            if (options.quick && options.robots.empty() && robots > 500 && scene.robots.size() > 1) continue;
            const std::size_t size = options.quick && robots > 2000 && options.robots.empty() ? 300 : robots;
            std::fprintf(stderr, "%s, %zu robots\n", scene.name.c_str(), size);
            add(hold_contest(scene, size, options.contest));
        }
    }
    if (is_wanted(options.scenes, "threads") && is_wanted(options.contest.engines, "RoBOSS")) {
        std::fprintf(stderr, "threads, 2000 cars\n");
        add(compare_threads(2000, options.contest));
    }
    return rows;
}

int run_price_list(const BenchOptions& options) {
    const std::vector<Price> prices = make_price_list(options.scenes, options.robots, options.contest);
    print_price_list(prices);
    return options.json.empty() || write_json(options.json, prices) ? 0 : 2;
}

void add_options(CLI::App& app, BenchOptions& options) {
    app.add_option("--scene", options.scenes, "only these scenes");
    app.add_option("--robots", options.robots, "instead of the scenes' own sizes")->check(positive_number());
    app.add_option("--engine", options.contest.engines, "only these engines; ratios need RoBOSS among them");
    app.add_option("--steps", options.contest.steps,
                   "counted steps (otherwise a thousand, or 100000 robot-steps if that is more)")
        ->check(positive_number());
    app.add_option("--settle", options.contest.settle, "steps before")->check(positive_number());
    app.add_option("--blocks", options.contest.blocks,
                   "number of blocks of counted steps; the median is reported")
        ->check(positive_number());
    app.add_option("--limit", options.contest.limit_s,
                   "seconds of counted steps an engine and scene; a slower engine counts fewer steps");
    app.add_option("--start-limit", options.contest.start_limit_s,
                   "seconds of building and settling; a slower engine is left out");
    app.add_option("--accuracy", options.contest.accuracy,
                   "1: as each engine is set up with care; 10: ten times the iterations or a tenth of the "
                   "tolerance")
        ->check(positive_number());
    app.add_flag("--quick", options.quick, "about two minutes: small sizes, short limits");
    app.add_flag("--alone", options.alone, "in this process, without turns: for profilers");
    app.add_flag("--check-engines", options.check,
                 "instead: do small mechanisms move alike in all engines? (signs, frames, units)");
    app.add_flag("--price-list", options.price_list,
                 "instead: what RoBOSS' settings fast, standard and high cost and give");
    app.add_option("--json", options.json, "also write the rows to this file");
}

}  // namespace

int main(int argc, char** argv) {
    BenchOptions options;
    CLI::App app{help()};
    add_options(app, options);
    CLI11_PARSE(app, argc, argv);
    if (options.quick) options.contest.limit_s = 2, options.contest.start_limit_s = 5;
    try {
        if (options.check) return engines_agree() ? 0 : 1;
        if (options.alone) return run_all_alone(options);
        if (options.price_list) return run_price_list(options);
        const std::vector<Row> rows = run_contests(options);
        if (rows.empty()) {
            std::fprintf(stderr, "roboss-peers: no such scene or engine; --help lists them\n");
            return 2;
        }
        print_table(rows);
        if (!options.json.empty() && !write_json(options.json, rows)) return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "roboss-peers: %s\n", error.what());
        return 1;
    }
    return 0;
}
