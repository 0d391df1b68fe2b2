// Control programs out of shared libraries.
#include <gtest/gtest.h>

#include <fstream>

#include "client/plugin.h"
#include "simulation/simulation.h"
#include "test_worlds.h"

namespace roboss::test {
namespace {

std::string library(const std::string& name) {
    return std::string(ROBOSS_TEST_PLUGINS) + "/" + name + ".so";
}

TEST(Plugins, AProgramOutOfALibraryMovesItsRobot) {
    const auto model = pair_world();
    auto program = load_control_program(library("good_program"));
    ASSERT_TRUE(program.ok()) << program.error().text();
    std::vector<NamedProgram> programs;
    programs.push_back({"pusher", std::move(program).value()});
    auto simulation = Simulation::create(model, {}, std::move(programs));
    ASSERT_TRUE(simulation.value()->run_until(200).ok());
    EXPECT_GT(simulation.value()->states()[2].q[0], 8.2);
}

void expect_refused(const std::string& path, const std::string& code) {
    const auto program = load_control_program(path);
    ASSERT_FALSE(program.ok());
    EXPECT_NE(program.error().message.find(path), std::string::npos) << program.error().text();
    EXPECT_EQ(program.error().code, code) << program.error().text();
    EXPECT_FALSE(program.error().remedy.empty());
}

TEST(Plugins, WhatCannotBeLoadedIsRefusedByName) {
    expect_refused(library("nothing"), "no-file");
    expect_refused(library("no_program"), "no-entry-point");
    expect_refused(library("old_program"), "abi-mismatch");
    const std::string text = ::testing::TempDir() + "/roboss_text.so";
    std::ofstream(text) << "not a library";
    expect_refused(text, "not-loadable");
}

}  // namespace
}  // namespace roboss::test
