// A run saved half-way goes on exactly; whatever is wrong with a file is said in words.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

namespace fs = std::filesystem;

class SavedRuns : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ =
            fs::path(::testing::TempDir()) /
            ("roboss_saved_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string file(const std::string& name) const { return (folder_ / name).string(); }

    fs::path folder_;
};

std::vector<NamedProgram> drivers() {
    ControlOptions quick, late;
    quick.period_s = 0.014;
    late.period_s = 0.03;
    late.latency_s = 0.08;  // orders for observations before the save are still to come after it
    std::vector<NamedProgram> programs;
    programs.push_back({"quick", std::make_unique<DrivingProgram>(quick)});
    programs.push_back({"late", std::make_unique<DrivingProgram>(late)});
    return programs;
}

std::unique_ptr<Simulation> make(const std::shared_ptr<const Model>& model, const SavedRun* from = nullptr,
                                 std::size_t simulators = 2) {
    SimulationOptions options;
    options.simulators = simulators;
    options.world_file = "carts.sdf";
    options.controller.seed = 42;
    auto made = Simulation::create(model, options, drivers(), from);
    EXPECT_TRUE(made.ok());
    std::unique_ptr<Simulation> simulation = std::move(made).value();
    for (const Tick tick : {50, 150, 320}) {
        if (tick < simulation->tick()) continue;
        const Order order{tick, ClientId(), static_cast<std::uint64_t>(tick), RobotId(1u),
                          ApplyWrench{LinkId(0u), {0, 20, 30}, {}, 10}};
        EXPECT_TRUE(simulation->submit(order).ok());
    }
    return simulation;
}

TEST_F(SavedRuns, GoOnToTheSameHash) {
    const auto model = carts_world(4);
    auto whole = make(model);
    ASSERT_TRUE(whole->run_until(400).ok());
    for (const Tick half :
         {0, 1, 105, 150, 203, 210}) {  // on and between the Clients' observations and the orders
        auto first = make(model);
        ASSERT_TRUE(first->run_until(half).ok());
        ASSERT_TRUE(first->save(file("half.roboss")).ok());
        const Result<SavedRun> loaded = load_run(file("half.roboss"), *model);
        ASSERT_TRUE(loaded.ok()) << loaded.error().text();
        EXPECT_EQ(loaded.value().tick, half);
        EXPECT_EQ(loaded.value().seed, 42u);
        EXPECT_EQ(loaded.value().world_file, "carts.sdf");
        EXPECT_EQ(state_hash_of(*model, loaded.value()), first->hash());
        auto second = make(model, &loaded.value(), 3);
        EXPECT_EQ(second->tick(), half);
        EXPECT_EQ(second->hash(), first->hash());
        ASSERT_TRUE(second->run_until(400).ok());
        EXPECT_EQ(second->hash(), whole->hash()) << "saved at tick " << half;
        ASSERT_TRUE(first->run_until(400).ok());
        EXPECT_EQ(first->hash(), whole->hash()) << "saving disturbed the run at tick " << half;
    }
}

void expect_refused(const std::string& path, const Model& model, const std::string& code) {
    const Result<SavedRun> loaded = load_run(path, model);
    ASSERT_FALSE(loaded.ok()) << "expected: " << code;
    EXPECT_EQ(loaded.error().code, code) << loaded.error().text();
    EXPECT_NE(loaded.error().text().find(path), std::string::npos) << loaded.error().text();
    EXPECT_FALSE(loaded.error().remedy.empty());
}

TEST_F(SavedRuns, FilesThatAreNoneAreRefusedByName) {
    const auto model = carts_world(2);
    expect_refused(file("nothing.roboss"), *model, "no-file");
    std::ofstream(file("text.roboss"))
        << "this is not a checkpoint, only some text that is long enough to be looked at";
    expect_refused(file("text.roboss"), *model, "not-a-journal");
    std::ofstream(file("empty.roboss")).flush();
    expect_refused(file("empty.roboss"), *model, "not-a-journal");
}

TEST_F(SavedRuns, AnotherWorldIsRefused) {
    const auto model = carts_world(2), other = carts_world(3);
    auto simulation = make(model);
    ASSERT_TRUE(simulation->save(file("run.roboss")).ok());
    expect_refused(file("run.roboss"), *other, "another-world");
}

TEST_F(SavedRuns, NoDamageGoesUnnoticed) {
    const auto model = carts_world(2);
    auto simulation = make(model);
    ASSERT_TRUE(simulation->run_until(37).ok());
    ASSERT_TRUE(simulation->save(file("run.roboss")).ok());
    const std::uint64_t hash = simulation->hash();
    std::ifstream in(file("run.roboss"), std::ios::binary);
    const std::string good((std::istreambuf_iterator<char>(in)), {});
    const auto write = [&](const std::string& bytes) {
        std::ofstream(file("bad.roboss"), std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    };
    for (std::size_t size = 0; size < good.size(); size += 1 + good.size() / 40) {
        write(good.substr(0, size));
        EXPECT_FALSE(load_run(file("bad.roboss"), *model).ok()) << "cut to " << size << " of " << good.size();
    }
    int refused = 0;
    for (std::size_t at = 0; at < good.size(); at += 61) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ 0x10);
        write(bad);
        const Result<SavedRun> loaded = load_run(file("bad.roboss"), *model);
        if (!loaded.ok()) {
            ++refused;
        } else {  // in a part of the file that is not used
            EXPECT_EQ(state_hash_of(*model, loaded.value()), hash) << "byte " << at;
        }
    }
    EXPECT_GT(refused, 30);
}

TEST_F(SavedRuns, APlaceThatCannotBeWrittenIsNamed) {
    const auto model = carts_world(2);
    auto simulation = make(model);
    const Result<> saved = simulation->save(file("no_such_folder/run.roboss"));
    ASSERT_FALSE(saved.ok());
    EXPECT_NE(saved.error().text().find("no_such_folder"), std::string::npos);
}

}  // namespace
}  // namespace roboss::test
