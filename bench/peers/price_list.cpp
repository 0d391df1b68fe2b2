// See price_list.h. The costs come from a contest of the three settings; the solver's figures from a second
// run, because keeping them takes time.
#include "peers/price_list.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>

#include "engines/makers.h"
#include "peers/trial.h"
#include "scenes/overlap.h"

namespace roboss::bench {
namespace {

/// RoBOSS by setting, standard first: a contest's ratios are to the first.
std::vector<EngineKind> settings() {
    return {{"standard", make_roboss}, {"fast", make_roboss_fast}, {"high", make_roboss_high}};
}

std::size_t size_of(const SceneKind& scene) {
    return scene.name == "city" ? 2000 : scene.name == "spiders" ? 200 : scene.robots.back();
}

/// The same steps again, with figures.
void measure(const EngineKind& kind, const Scene& scene, int ticks, Price& price) {
    Trial trial(kind, scene, 1, true);
    trial.run(ticks);
    price.solver = trial.engine().solver_figures().value_or(SolverFigures{});
    price.overlap_m = measure_overlap(scene.world, trial.engine()).deepest_m;
}

std::vector<Price> prices_of(const SceneKind& kind, std::size_t robots, const ContestOptions& options) {
    const std::vector<EngineKind> kinds = settings();
    const std::vector<Row> rows = hold_contest(kind, robots, options, kinds);
    const Scene scene = kind.make(robots);
    std::vector<Price> prices;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Price& price = prices.emplace_back();
        price.scene = kind.name, price.setting = kinds[i].name, price.robots = robots;
        price.cost = rows[i], price.skipped = rows[i].skipped;
        if (!price.skipped.empty()) continue;
        std::fprintf(stderr, "  %s: figures\n", price.setting.c_str());
        try {
            measure(kinds[i], scene, options.settle + rows[i].steps, price);
        } catch (const std::exception& error) {
            price.skipped = error.what();
        }
    }
    return prices;
}

}  // namespace

std::vector<Price> make_price_list(const std::vector<std::string>& wanted,
                                   const std::vector<std::size_t>& robots, const ContestOptions& options) {
    const std::vector<std::string> names =
        wanted.empty() ? std::vector<std::string>{"shapes", "city", "spiders"} : wanted;
    ContestOptions contest = options;
    contest.engines.clear();
    std::vector<Price> prices;
    for (const SceneKind& scene : scenes()) {
        if (std::find(names.begin(), names.end(), scene.name) == names.end()) continue;
        const std::size_t size = robots.empty() ? size_of(scene) : robots.front();
        std::fprintf(stderr, "%s, %zu robots\n", scene.name.c_str(), size);
        const std::vector<Price> more = prices_of(scene, size, contest);
        prices.insert(prices.end(), more.begin(), more.end());
    }
    return prices;
}

void print_price_list(const std::vector<Price>& prices) {
    std::printf("%-10s %6s  %-9s %9s %17s %6s %6s %10s %9s %10s %8s %9s  %s\n", "scene", "robots", "setting",
                "us/step", "least - most", "ratio", "steps", "iterations", "residual", "friction", "misses",
                "overlap", "result");
    for (const Price& p : prices) {
        std::printf("%-10s %6zu  %-9s ", p.scene.c_str(), p.robots, p.setting.c_str());
        if (!p.skipped.empty()) {
            std::printf("left out: %s\n", p.skipped.c_str());
            continue;
        }
        std::printf("%9.3f %8.3f -%7.3f %6.2f %6d %10.2f %9.1e %10.1e %7.2f%% %6.2f mm  %s%s\n",
                    p.cost.us_median, p.cost.us_least, p.cost.us_most, p.cost.ratio, p.cost.steps,
                    p.solver.iterations, p.solver.residual, p.solver.friction_error,
                    100 * p.solver.friction_misses, 1e3 * p.overlap_m,
                    p.cost.right ? "" : "WRONG: ", p.cost.verdict.c_str());
    }
}

}  // namespace roboss::bench
