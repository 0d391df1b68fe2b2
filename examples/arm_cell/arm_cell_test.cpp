// The controller of a cell against a scripted plant: boxes that are missed or lost. Then whole cells: boxes
// are moved and none falls, with equal hashes on one and four Simulators and in a continued run.
#include <gtest/gtest.h>
#include <support/world_text.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/worlds/cell_world.h"
#include "cell.h"
#include "client/plugin.h"
#include "simulation/simulation.h"

namespace arm_cell {
namespace {

/// Joints that follow at once, a box that stands at the light barrier, and a hand whose box may vanish.
struct Plant {
    Cell cell{Gripper::kFingers, Cell::rest()};
    Readings readings;
    Orders orders;
    bool box_there = true, sees = true;  // before the light barrier; by the scanner
    std::function<bool(const Cell&)> holds = [](const Cell&) { return true; };

    Plant() { readings.q = Cell::rest(); }
    void run(double until_s) {
        while (readings.time_s < until_s) {
            readings.barrier_broken = cell.wants_barrier() && box_there && cell.state.phase == Phase::kIdle;
            const bool held = holds(cell);
            readings.eye = held ? 0.04 : 0.09;
            readings.opening = held ? 0.03 : 0;
            std::optional<SeenBox> seen;
            if (sees && cell.wants_scan(readings.time_s))
                seen = SeenBox{0.03, kBeltAside, kBeltTop + 0.06, 0.5};
            orders = cell.step(readings, seen, held);
            readings.time_s += kPeriod;
            readings.q = cell.state.motion.at(readings.time_s);
        }
    }
};

TEST(Cell, MovesABoxInFiveSeconds) {
    Plant plant;
    plant.run(30);
    EXPECT_GE(plant.cell.state.moved, 5);
    EXPECT_EQ(plant.cell.state.dropped + plant.cell.state.missed + plant.cell.state.discarded, 0);
}

TEST(Cell, ABoxThatIsLostOnTheWayIsCountedAndTheCellGoesOn) {
    Plant plant;
    int carries = 0;
    Phase before = Phase::kIdle;
    plant.holds = [&](const Cell& cell) {
        if (cell.state.phase == Phase::kCarry && before != Phase::kCarry) ++carries;
        before = cell.state.phase;
        const bool first_way = carries == 1 && (before == Phase::kCarry || before == Phase::kSetDown);
        return !first_way;
    };
    plant.run(30);
    EXPECT_EQ(plant.cell.state.dropped, 1);
    EXPECT_GE(plant.cell.state.moved, 4);
}

TEST(Cell, ABoxThatTheScannerDoesNotSeeRunsOnUntilTheBarrierIsClear) {
    Plant plant;
    plant.sees = false;
    plant.run(2);
    EXPECT_EQ(plant.cell.state.discarded, 1);
    EXPECT_TRUE(plant.orders.belt_runs) << "as long as the box breaks the barrier";
    plant.box_there = false;
    plant.run(2.1);
    plant.box_there = true;
    plant.sees = true;
    plant.run(10);
    EXPECT_EQ(plant.cell.state.discarded, 1);
    EXPECT_GE(plant.cell.state.moved, 1);
}

TEST(Cell, AMissedBoxIsFetchedAgain) {
    Plant plant;
    plant.holds = [](const Cell& cell) { return cell.state.missed >= 2; };
    plant.run(20);
    EXPECT_EQ(plant.cell.state.missed, 2);
    EXPECT_GE(plant.cell.state.moved, 1);
    EXPECT_EQ(plant.cell.state.dropped, 0);
}

std::shared_ptr<const roboss::Model> compiled(const std::string& text) {
    return roboss::test::compiled_text(text, "cells.sdf");
}

std::unique_ptr<roboss::Simulation> cells(const std::shared_ptr<const roboss::Model>& model,
                                          std::size_t simulators, const roboss::SavedRun* from = nullptr) {
    std::vector<roboss::NamedProgram> programs;
    for (const char* library : {ROBOSS_ARM_CELL, ROBOSS_ARM_FEEDER})
        programs.push_back({library, roboss::load_control_program(library).value()});
    roboss::SimulationOptions options;
    options.simulators = simulators;
    return roboss::Simulation::create(model, options, std::move(programs), from).value();
}

/// Boxes that stand on the out belt of a cell.
int on_out_belt(roboss::Simulation& simulation, int cell) {
    int count = 0;
    for (int i = 0; i < kBoxes; ++i) {
        const roboss::RobotId box = *simulation.model().find_robot(box_name(cell, i));
        const roboss::Vec3 p = base_pose(simulation.states()[box.index()]).p;
        const double height = kind_of_box(i).height;
        const bool at_y = std::fabs(p.y - cell_origin(cell).y + kBeltAside) < 0.01;
        if (at_y && std::fabs(p.z - kBeltTop - height / 2) < 1e-4) ++count;
    }
    return count;
}

constexpr double kSeconds = ROBOSS_ARM_CELL_SECONDS;

void expect_equal_runs(const std::string& gripper) {
    const auto model = compiled(roboss::cell_sdf({2, gripper}));
    const auto tick = [&](double seconds) { return roboss::Tick(std::llround(seconds / model->dt_s)); };
    auto one = cells(model, 1), four = cells(model, 4);
    ASSERT_TRUE(one->run_until(tick(kSeconds)).ok());
    ASSERT_TRUE(four->run_until(tick(0.55 * kSeconds)).ok());
    const roboss::SavedRun saved = four->saved_run();
    auto continued = cells(model, 4, &saved);
    ASSERT_TRUE(continued->run_until(tick(kSeconds)).ok());
    EXPECT_EQ(one->hash(), continued->hash());
    if (kSeconds < 15) return;
    for (const int cell : {0, 1}) EXPECT_GE(on_out_belt(*one, cell), 1) << gripper << ' ' << cell;
}

TEST(ArmCells, WithFingersAreTheSameOnOneAndFourSimulatorsAndWhenContinued) {
    expect_equal_runs("fingers");
}

TEST(ArmCells, WithSuctionAreTheSameOnOneAndFourSimulatorsAndWhenContinued) {
    expect_equal_runs("suction");
}

TEST(ArmCells, WithSlipperyPadsMoveNoBox) {
    std::string text = roboss::cell_sdf({1, "fingers"});
    const std::string pads = "<mu>1</mu><mu2>1</mu2>";
    int count = 0;
    for (std::size_t at = text.find(pads); at != std::string::npos; at = text.find(pads, at), ++count)
        text.replace(at, pads.size(), "<mu>0.02</mu><mu2>0.02</mu2>");
    ASSERT_EQ(count, 2);
    auto one = cells(compiled(text), 1);
    ASSERT_TRUE(one->run_until(roboss::Tick(std::llround(kSeconds / one->model().dt_s))).ok());
    EXPECT_EQ(on_out_belt(*one, 0), 0) << "nothing but friction holds a box";
}

TEST(ArmCells, AShortRunReportsItsCountsAtItsEnd) {
    const std::string file = ::testing::TempDir() + "roboss_cells.json";
    std::filesystem::remove(file);
    ::setenv("ROBOSS_CELLS_RESULT", file.c_str(), 1);
    auto one = cells(compiled(roboss::cell_sdf({1, "fingers"})), 1);
    ASSERT_TRUE(one->run_until(50).ok());
    EXPECT_FALSE(std::filesystem::exists(file));
    one.reset();
    ::unsetenv("ROBOSS_CELLS_RESULT");
    std::string line;
    std::getline(std::ifstream(file) >> std::ws, line);
    EXPECT_TRUE(line.starts_with("{\"time_s\": 0, \"cells\": [{\"moved\": 0")) << line;
    std::filesystem::remove(file);
}

TEST(ArmCells, ARunOfSecondsReportsAllOfThem) {
    const std::string file = ::testing::TempDir() + "roboss_cells_whole.json";
    ::setenv("ROBOSS_CELLS_RESULT", file.c_str(), 1);
    for (const char* every : {"1", "2", "600"}) {
        std::filesystem::remove(file);
        ::setenv("ROBOSS_CELLS_REPORT", every, 1);
        auto one = cells(compiled(roboss::cell_sdf({1, "fingers"})), 1);
        ASSERT_TRUE(one->run_until(roboss::Tick(std::llround(2 / one->model().dt_s))).ok());
        one.reset();
        std::string line;
        std::getline(std::ifstream(file) >> std::ws, line);
        EXPECT_TRUE(line.starts_with("{\"time_s\": 2, ")) << "every " << every << " s: " << line;
    }
    ::unsetenv("ROBOSS_CELLS_REPORT");
    ::unsetenv("ROBOSS_CELLS_RESULT");
    std::filesystem::remove(file);
}

TEST(ArmCells, AResultFileThatCannotBeWrittenEndsTheRunAtItsStart) {
    for (const char* variable : {"ROBOSS_CELLS_RESULT", "ROBOSS_CELLS_FEEDER_RESULT"}) {
        ::setenv(variable, "/no_such_folder/cells.json", 1);
        auto one = cells(compiled(roboss::cell_sdf({1, "fingers"})), 1);
        EXPECT_FALSE(one->run_until(50).ok()) << variable;
        ::unsetenv(variable);
    }
}

}  // namespace
}  // namespace arm_cell
