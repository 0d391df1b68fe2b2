// roboss-peers: RoBOSS beside other engines on the same scenes, in the same run.
#include <CLI/CLI.hpp>

#include <cstdio>

#include "peers/trial.h"

using namespace roboss::bench;

int main(int argc, char** argv) {
    CLI::App app{"RoBOSS beside other physics engines on the same scenes"};
    std::string scene_name = "cars", engine_name = "RoBOSS";
    std::size_t robots = 500;
    int steps = 1000, settle = 200;
    app.add_option("--scene", scene_name, "cars or city");
    app.add_option("--robots", robots, "how many");
    app.add_option("--engine", engine_name, "which engine");
    app.add_option("--steps", steps, "counted steps");
    app.add_option("--settle", settle, "steps before, not counted");
    CLI11_PARSE(app, argc, argv);
    for (const SceneKind& kind : scenes()) {
        if (kind.name != scene_name) continue;
        const Scene scene = kind.make(robots);
        for (const EngineKind& engine : engines()) {
            if (engine.name != engine_name) continue;
            Trial trial(engine, scene);
            trial.run(settle);
            for (int done = 0; done < steps; done += steps / 5) {
                const Spent spent = trial.run(steps / 5);
                std::printf("%.3f us a robot-step (CPU), %.3f (wall)\n",
                            1e6 * spent.cpu / (steps / 5) / static_cast<double>(robots),
                            1e6 * spent.wall / (steps / 5) / static_cast<double>(robots));
            }
            const Verdict verdict = trial.judge();
            std::printf("%s: %s; heap %.0f bytes a robot\n", verdict.good ? "right" : "WRONG",
                        verdict.text.c_str(), trial.heap_bytes() / static_cast<double>(robots));
        }
    }
    return 0;
}
