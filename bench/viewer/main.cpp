// roboss-viewer-cost: what browsers cost a run of moving cars. Rounds without and with viewers take turns,
// medians are told: bytes to a browser, CPU of the gateway's thread, CPU of the run's thread a tick (the
// simulation's speed, without what else the machine does) and ticks a second of wall time.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "browser.h"
#include "car_field.h"
#include "live_run.h"
#include "median.h"

namespace roboss::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Question {
    int cars = 2000, viewers = 2, rounds = 5;
    double rate = 30, seconds = 4;
    std::string json;
};

struct Round {
    double ticks_per_s = 0, cpu_us_per_tick = 0, gateway_cores = 0, bytes_per_s = 0, states_per_s = 0;
};

/// All cars drive in circles from the first tick on.
std::vector<Order> drive(const Model& model) {
    std::vector<Order> orders;
    for (std::size_t r = 0; r < model.robots.size(); ++r)
        for (std::size_t j = 0; j < model.type_of(RobotId(r)).joints.size(); ++j)
            orders.push_back({0, ClientId(), orders.size(), RobotId(r),
                              SetJoint{JointId(j), 0, MotorMode::kVelocity, j % 2 == 0 ? 8.0 : 10.0, 2.0}});
    return orders;
}

double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

Round play(const std::shared_ptr<const Model>& model, const Question& question, int viewers) {
    test::LiveRunOptions options;
    options.speed = 0;
    options.orders = drive(*model);
    test::LiveRun run(model, options);
    const test::ViewerUrl url(run.url());
    std::vector<std::unique_ptr<test::Browser>> browsers;
    std::vector<std::thread> threads;
    std::atomic<bool> end = false;
    for (int i = 0; i < viewers; ++i) {
        browsers.push_back(std::make_unique<test::Browser>(url));
        browsers.back()->send({{"type", "watch"}, {"rate", question.rate}});
        threads.emplace_back([&end, browser = browsers.back().get()] {
            browser->until([&end] { return end.load(); }, 600'000);
        });
    }
    std::this_thread::sleep_for(std::chrono::seconds(1));  // cars drive, browsers have the scene
    const auto then = Clock::now();
    const Tick tick = run.tick();
    const double run_cpu = run.run_cpu_s(), gateway_cpu = run.gateway().load().cpu_s;
    const std::uint64_t bytes = run.gateway().load().sent_bytes;
    std::this_thread::sleep_for(std::chrono::duration<double>(question.seconds));
    const double wall_s = seconds_since(then);
    const auto ticks = static_cast<double>(run.tick() - tick);
    Round round{ticks / wall_s, 1e6 * (run.run_cpu_s() - run_cpu) / ticks,
                (run.gateway().load().cpu_s - gateway_cpu) / wall_s,
                static_cast<double>(run.gateway().load().sent_bytes - bytes) / wall_s / std::max(viewers, 1),
                0};
    end = true;
    for (std::thread& thread : threads) thread.join();
    for (const auto& browser : browsers)
        round.states_per_s += static_cast<double>(browser->states()) / (wall_s + 1) / viewers;
    return round;
}

Round median_of(const std::vector<Round>& rounds) {
    const auto of = [&](double Round::*field) {
        std::vector<double> values;
        for (const Round& round : rounds) values.push_back(round.*field);
        return median(std::move(values));
    };
    return {of(&Round::ticks_per_s), of(&Round::cpu_us_per_tick), of(&Round::gateway_cores),
            of(&Round::bytes_per_s), of(&Round::states_per_s)};
}

void tell(const char* name, const Round& r) {
    std::printf("%-14s %10.0f %14.1f %12.1f %% %12.2f %12.1f\n", name, r.ticks_per_s, r.cpu_us_per_tick,
                100 * r.gateway_cores, 1e-6 * r.bytes_per_s, r.states_per_s);
}

nlohmann::json json_of(const Round& r) {
    return {{"ticks_per_s", r.ticks_per_s},
            {"run_cpu_us_per_tick", r.cpu_us_per_tick},
            {"gateway_cores", r.gateway_cores},
            {"bytes_per_s_per_browser", r.bytes_per_s},
            {"states_per_s", r.states_per_s}};
}

int measure(const Question& question) {
    Diagnostics diagnostics;
    const auto model = compile(car_field_world(question.cars, 0.002), {}, diagnostics);
    std::vector<Round> none, some;
    std::vector<double> cpu_ratio, wall_ratio;
    for (int i = 0; i < question.rounds; ++i) {
        none.push_back(play(model, question, 0));
        some.push_back(play(model, question, question.viewers));
        cpu_ratio.push_back(some.back().cpu_us_per_tick / none.back().cpu_us_per_tick);
        wall_ratio.push_back(some.back().ticks_per_s / none.back().ticks_per_s);
    }
    std::printf("%d cars, %d viewers at %g States a second, medians of %d rounds of %g s\n", question.cars,
                question.viewers, question.rate, question.rounds, question.seconds);
    std::printf("%-14s %10s %14s %14s %12s %12s\n", "", "ticks/s", "run CPU us/tick", "gateway CPU",
                "MB/s browser", "States/s");
    tell("no viewer", median_of(none));
    tell("viewers", median_of(some));
    std::printf("run CPU a tick with viewers / without: %.4f; ticks a second: %.4f\n", median(cpu_ratio),
                median(wall_ratio));
    if (question.json.empty()) return 0;
    const char* commit = std::getenv("ROBOSS_COMMIT");
    std::ofstream(question.json) << nlohmann::json{
        {"commit", commit != nullptr ? commit : "unknown"},
        {"cars", question.cars},
        {"viewers", question.viewers},
        {"rate", question.rate},
        {"none", json_of(median_of(none))},
        {"some", json_of(median_of(some))},
        {"cpu_ratio", median(cpu_ratio)},
        {"wall_ratio",
         median(wall_ratio)}}.dump(2);
    return 0;
}

}  // namespace
}  // namespace roboss::bench

int main(int argc, char** argv) {
    CLI::App app{"What browsers cost a run of moving cars."};
    roboss::bench::Question question;
    app.add_option("--cars", question.cars)->capture_default_str();
    app.add_option("--viewers", question.viewers)->check(CLI::Range(1, 16))->capture_default_str();
    app.add_option("--rate", question.rate, "States a second")->capture_default_str();
    app.add_option("--rounds", question.rounds)->check(CLI::Range(1, 100))->capture_default_str();
    app.add_option("--seconds", question.seconds, "of a round")->capture_default_str();
    app.add_option("--json", question.json, "write the rows to this file");
    CLI11_PARSE(app, argc, argv);
    return roboss::bench::measure(question);
}
