// LocalRun gives the state hashes of tests/golden_hashes.txt: those of all runs without control programs, for
// any number of threads and lanes and any length of a call of step().
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <sstream>

#include "app/worlds/orders_file.h"
#include "local/local_run.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

/// A line of the list.
struct Golden {
    std::uint64_t hash = 0;
    std::string world, orders, accuracy;
    double duration_s = 0;
    bool floats = false;
};

/// Options of `roboss run` that spread a run over threads and Simulators; its hash is the same without them.
constexpr std::array kSpread{"--simulators", "--threads", "--lanes", "--window"};

/// nullopt: a run that a LocalRun does not make.
std::optional<Golden> parse(const std::string& line) {
    std::istringstream words(line);
    Golden golden;
    std::string word, value;
    words >> std::hex >> golden.hash >> std::dec >> golden.world;
    while (words >> word) {
        if (word == "--merge-islands") continue;
        words >> value;
        if (word == "--client") return {};
        if (word == "--orders") {
            golden.orders = value;
        } else if (word == "--duration") {
            golden.duration_s = std::stod(value);
        } else if (word == "--precision") {
            golden.floats = value == "float";
        } else if (word == "--accuracy") {
            golden.accuracy = value;
        } else {
            EXPECT_NE(std::find(kSpread.begin(), kSpread.end(), word), kSpread.end())
                << "this test ignores " << word;
        }
    }
    if (golden.world == "worlds/errands.sdf") return {};  // refused: MessageBoards
    return golden;
}

/// One of each set of lines that differ only in how the run is spread.
std::vector<Golden> read_list() {
    std::ifstream file(ROBOSS_SOURCE "/tests/golden_hashes.txt");
    std::vector<Golden> all;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') continue;
        const std::optional<Golden> golden = parse(line);
        const auto is_same = [&](const Golden& other) { return other.hash == golden->hash; };
        if (golden && std::none_of(all.begin(), all.end(), is_same)) all.push_back(*golden);
    }
    return all;
}

std::string path_of(const std::string& file) {
    return std::string(ROBOSS_SOURCE "/") + file;
}

std::shared_ptr<const Model> load(const Golden& golden) {
    Diagnostics diagnostics;
    const std::optional<World> world = load_world(path_of(golden.world), {}, diagnostics);
    CompileOptions options;
    if (golden.floats) options.precision = Precision::kFloat;
    options.accuracy.setting = golden.accuracy;
    return world ? compile(*world, options, diagnostics) : nullptr;
}

std::uint64_t hash_of(const Golden& golden, const std::shared_ptr<const Model>& model,
                      const LocalRunOptions& options, Tick call) {
    Result<std::unique_ptr<LocalRun>> made = LocalRun::create(model, options);
    LocalRun& run = *made.value();
    Diagnostics diagnostics;
    if (!golden.orders.empty()) {
        for (const Order& order : load_orders(path_of(golden.orders), *model, diagnostics))
            EXPECT_TRUE(run.submit(order).ok());
    }
    const Tick end = tick_at(golden.duration_s, model->dt_s);
    while (run.tick() < end) {
        const Result<> stepped = run.step(std::min(call, end - run.tick()));
        EXPECT_TRUE(stepped.ok());
        if (!stepped) return 0;
    }
    return run.hash();
}

TEST(LocalRun, HasTheHashesOfRobossRunForAnyThreadsLanesAndCalls) {
    const std::vector<Golden> list = read_list();
    EXPECT_GE(list.size(), 14U);
    for (const Golden& golden : list) {
        SCOPED_TRACE(golden.world + (golden.floats ? ", floats " : " ") + golden.accuracy);
        const std::shared_ptr<const Model> model = load(golden);
        ASSERT_TRUE(model);
        EXPECT_EQ(hash_of(golden, model, {}, 1'000'000), golden.hash);
        // Every second world in each of two other ways.
        const bool even = (&golden - list.data()) % 2 == 0;
        const LocalRunOptions other =
            even ? LocalRunOptions{.threads = 3} : LocalRunOptions{.threads = 2, .lanes = 1};
        EXPECT_EQ(hash_of(golden, model, other, even ? 50 : 7), golden.hash);
    }
}

}  // namespace
}  // namespace roboss
