// The worlds of this repository that have a file of orders (worlds/NAME.sdf with NAME.jsonl): drives, joint
// controllers, belts, bonds, air and water. Whatever happens to the cluster, they end with the hash of the
// undisturbed run; their Models survive their bytes.
#include <gtest/gtest.h>

#include <filesystem>

#include "app/worlds/orders_file.h"
#include "faulty_cluster.h"
#include "sdf/load_world.h"
#include "simulation/simulation.h"
#include "wire/model_codec.h"

namespace roboss::test {
namespace {

constexpr Tick kTicks = 300;

/// Names of the worlds with orders.
std::vector<std::string> acting_worlds() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(ROBOSS_WORLDS)) {
        std::filesystem::path orders = entry.path();
        if (orders.extension() != ".sdf") continue;
        if (std::filesystem::exists(orders.replace_extension(".jsonl")))
            names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

class ActingWorld : public testing::TestWithParam<std::string> {
  protected:
    void SetUp() override {
        const std::string path = std::string(ROBOSS_WORLDS) + "/" + GetParam();
        Diagnostics found;
        const auto world = load_world(path + ".sdf", {}, found);
        ASSERT_TRUE(world);
        model_ = compile(*world, {}, found);
        ASSERT_NE(model_, nullptr);
        orders_ = load_orders(path + ".jsonl", *model_, found);
        ASSERT_FALSE(found.has_errors());
        ASSERT_FALSE(orders_.empty());
        squeeze_orders();
    }

    /// The whole list within the ticks of the test, so that every order takes effect.
    void squeeze_orders() {
        Tick last = 1;
        for (const Order& order : orders_) last = std::max(last, order.apply_at);
        if (last < kTicks) return;
        for (Order& order : orders_) order.apply_at = order.apply_at * (kTicks - 20) / last;
    }

    std::uint64_t undisturbed_hash() const {
        auto simulation = Simulation::create(model_, {});
        for (const Order& order : orders_) EXPECT_TRUE(simulation.value()->submit(order).ok());
        EXPECT_TRUE(simulation.value()->run_until(kTicks).ok());
        return simulation.value()->hash();
    }

    std::shared_ptr<const Model> model_;
    std::vector<Order> orders_;
};

TEST_P(ActingWorld, SurvivesItsBytes) {
    const auto back = decode_model(encode_model(*model_));
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back.value()->hash, model_->hash);
}

TEST_P(ActingWorld, EndsWithTheUndisturbedHashWhateverTheBusDoesAndWhoeverDies) {
    const std::uint64_t expected = undisturbed_hash();
    std::uint64_t losses = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        FaultOptions faults;
        faults.seed = seed;
        faults.drop = 0.02 * static_cast<double>(seed % 6);
        faults.duplicate = 0.02 * static_cast<double>(seed % 5);
        faults.delay_ms_max = static_cast<std::int64_t>(seed % 10);
        ControllerOptions options;
        options.checkpoint_ticks = 10 + static_cast<Tick>(seed % 5) * 12;
        options.window = seed % 3 == 0 ? 0 : static_cast<Tick>(seed % 7 + 1);
        FaultyCluster cluster(model_, options, faults, {150, 60, 50, 250, 2000}, 1 + seed % 4);
        cluster.turn();  // makes the Controller
        for (const Order& order : orders_) ASSERT_TRUE(cluster.controller().submit(order).ok());
        ASSERT_TRUE(cluster.run_until(kTicks)) << "stuck at tick " << cluster.controller().tick();
        EXPECT_EQ(cluster.controller().hash(), expected);
        losses += cluster.controller().counters().losses;
    }
    EXPECT_GT(losses, 0u);  // else this test did not test
}

INSTANTIATE_TEST_SUITE_P(Worlds, ActingWorld, testing::ValuesIn(acting_worlds()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace roboss::test
