// Messages that decode and have invalid contents: no role aborts.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "faulty_cluster.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

/// What one run of this seed met.
struct Met {
    std::map<std::string, std::uint64_t> garbled;
    std::uint64_t refused = 0;
};

Met run_garbled(const std::shared_ptr<const Model>& model, std::uint64_t seed) {
    constexpr int kTurns = 400;
    FaultOptions faults{seed, 0.02, 0.02, static_cast<std::int64_t>(seed % 4)};
    faults.garble = 0.25;
    ControllerOptions options;
    options.checkpoint_ticks = 10 + static_cast<Tick>(seed % 20);
    options.window = static_cast<Tick>(seed % 6);
    FaultyCluster cluster(model, options, faults, {100, 0, 200, 300, 2000}, 1 + seed % 3);
    ControlOptions program;
    program.period_s = 0.016;
    program.synchronous = seed % 2 == 0;
    cluster.add_program("driver", program);
    cluster.run_until(1 << 20, kTurns);
    return {cluster.bus().garbled(), cluster.bus().refused()};
}

std::uint64_t number_from(const char* variable, std::uint64_t otherwise) {
    const char* text = std::getenv(variable);
    return text == nullptr ? otherwise : std::stoull(text);
}

/// ROBOSS_SEED=N begins with that seed, ROBOSS_SEEDS=N takes so many. The last line before an abort names the
/// seed.
TEST(BadMessages, NoRoleAbortsWhateverAMessageSays) {
    constexpr std::uint64_t kSeeds = 300;
    const auto model = carts_world(3);
    std::map<std::string, std::uint64_t> met;
    std::uint64_t refused = 0;
    const std::uint64_t first = number_from("ROBOSS_SEED", 1), seeds = number_from("ROBOSS_SEEDS", kSeeds);
    for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
        std::fprintf(stderr, "\rseed %llu ", static_cast<unsigned long long>(seed));
        const Met run = run_garbled(model, seed);
        for (const auto& [kind, count] : run.garbled) met[kind] += count;
        refused += run.refused;
    }
    std::fprintf(stderr, "\n");
    if (seeds < kSeeds) return;
    for (const char* kind : {"Assignment", "WindowResult", "StateRequest", "StateReply", "Observation",
                             "ClientReply", "ReplyAck", "Hello", "ClientHello", "Welcome", "ClientWelcome",
                             "Heartbeat", "OrdersAhead", "Cut", "Late", "LeaveRequest", "Goodbye"})
        EXPECT_GT(met[kind], 5u) << kind << ": such messages were not tested";
    EXPECT_GT(refused, 1000u);
}

}  // namespace
}  // namespace roboss::test
