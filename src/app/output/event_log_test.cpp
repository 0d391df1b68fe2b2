// What the log reports of a run.
#include "app/output/event_log.h"

#include <gtest/gtest.h>

#include <support/bodies.h>

#include <cstdio>
#include <fstream>

namespace roboss {
namespace {

std::unique_ptr<Simulation> nine_boxes(std::size_t simulators) {
    World world = test::empty_world(1e-3);
    for (int i = 0; i < 9; ++i)
        test::place(world, test::solid_box(1, {0.1, 0.1, 0.1}, test::surface(0.5)),
                    "box_" + std::to_string(i), {{2.0 * i, 0, 1}, {}});
    Diagnostics diagnostics;
    SimulationOptions options;
    options.simulators = simulators;
    auto made = Simulation::create(compile(world, {}, diagnostics), options, {});
    return std::move(made.value());
}

TEST(EventLog, TellsWhoHasWhatAfterAWindow) {
    const std::unique_ptr<Simulation> simulation = nine_boxes(2);
    ASSERT_TRUE(simulation->run_until(100, [] { return true; }).ok());
    const std::vector<std::string> lines = state_lines(*simulation);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0].find("event=state time_s=0.100 simulators=2 robots=9 islands=9 "), 0u) << lines[0];
    for (const char* each : {" window=", " windows=", " repeated=0 ", " efficiency="})
        EXPECT_NE(lines[0].find(each), std::string::npos) << lines[0];
    EXPECT_EQ(lines[1].find("event=load simulator=0 "), 0u) << lines[1];
    EXPECT_EQ(lines[2].find("event=load simulator=1 "), 0u) << lines[2];
    EXPECT_NE(lines[1].find(" has=0"), std::string::npos)
        << "the first robot is the first Simulator's: " << lines[1];
}

TEST(EventLog, IsAddedToAndQuotesWhatIsSaid) {
    const std::string path = testing::TempDir() + "roboss_test_event.log";
    std::remove(path.c_str());
    for (const char* text : {"robot \"a\" has\nleft", "and came back"}) {
        Result<EventLog> log = EventLog::open(path, 1);
        ASSERT_TRUE(log.ok());
        log.value().event(7, text);
    }
    std::ifstream file(path);
    std::string line;
    ASSERT_TRUE(std::getline(file, line));
    EXPECT_NE(line.find("Z level=info tick=7 event=notice text=\"robot \\\"a\\\" has left\""),
              std::string::npos)
        << line;
    ASSERT_TRUE(std::getline(file, line));
    EXPECT_FALSE(std::getline(file, line));
    std::remove(path.c_str());
}

TEST(EventLog, ThatCannotBeWrittenIsRefusedByName) {
    const Result<EventLog> log = EventLog::open(testing::TempDir(), 1);  // a folder
    ASSERT_FALSE(log.ok());
    EXPECT_NE(log.error().message.find(testing::TempDir()), std::string::npos);
}

}  // namespace
}  // namespace roboss
