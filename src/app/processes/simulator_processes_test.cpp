// Reports on processes that die, hang or join late. The processes are this test program itself, with one
// of the cases of SimulatorProcessesChild.
#include "app/processes/simulator_processes.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <cstdio>
#include <thread>

#include "app/processes/threads.h"

namespace roboss {
namespace {

constexpr std::int64_t kPatience_ms = 1'000;

std::vector<std::string> child(const std::string& does) {
    return {"child", "--gtest_also_run_disabled_tests", "--gtest_brief=1",
            "--gtest_filter=SimulatorProcessesChild.DISABLED_" + does};
}

TEST(SimulatorProcessesChild, DISABLED_Complains) {
    for (int i = 0; i < 9; ++i) std::fprintf(stderr, "message %d\n", i);
    std::fflush(stderr);
    _exit(7);
}

TEST(SimulatorProcessesChild, DISABLED_Sleeps) {
    std::this_thread::sleep_for(std::chrono::seconds(60));
}

LocalProcess started(const std::string& does) {
    Result<LocalProcess> process = LocalProcess::start(child(does));
    EXPECT_TRUE(process.ok());
    return std::move(process).value();
}

TEST(LocalProcess, KeepsTheEndOfWhatItsProcessSaid) {
    LocalProcess process = started("Complains");
    ASSERT_TRUE(process.wait(20'000));
    EXPECT_EQ(process.ended(), "ended with exit code 7");
    EXPECT_EQ(process.last_lines(2), "message 7\nmessage 8");
    EXPECT_EQ(process.last_lines(0), "");
    EXPECT_NE(process.last_lines(1'000).find("message 0\n"), std::string::npos);
}

TEST(LocalProcess, SaysWhatItsProcessDoes) {
    LocalProcess process = started("Sleeps");
    EXPECT_EQ(process.doing(), "running");
    ::kill(process.id(), SIGSTOP);
    for (int i = 0; i < 500 && process.doing() == "running"; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(process.doing(), "stopped (SIGSTOP or a debugger)");
    process.kill();
    ASSERT_TRUE(process.wait(20'000));
    EXPECT_EQ(process.ended(), "was killed by SIGKILL");
}

TEST(SimulatorProcesses, OneThatEndsBeforeTheRunIsNamedWithItsLastWords) {
    SimulatorProcesses processes;
    ASSERT_TRUE(processes.start(child("Sleeps")).ok());
    ASSERT_TRUE(processes.start(child("Complains")).ok());
    Result<> watched = Ok{};
    for (int i = 0; i < 2'000 && watched.ok(); ++i) {
        watched = processes.watch_start({}, 0, 1, kPatience_ms);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_FALSE(watched.ok());
    const std::string& text = watched.error().message;
    EXPECT_EQ(watched.error().code, "process-ended");
    EXPECT_NE(text.find("2 of 2"), std::string::npos) << text;
    EXPECT_NE(text.find("\nmessage 4"), std::string::npos) << text << "the end of its log";
    EXPECT_EQ(text.find("1 of 2"), std::string::npos) << text;
}

TEST(SimulatorProcesses, PatienceLastsAsLongAsSomebodyJoinsOrFetches) {
    SimulatorProcesses processes;
    for (int i = 0; i < 6; ++i) ASSERT_TRUE(processes.start(child("Sleeps")).ok());
    std::int64_t now = 1;
    EXPECT_TRUE(processes.watch_start({}, 0, now, kPatience_ms).ok());
    EXPECT_TRUE(processes.watch_start({}, 5, now += 900, kPatience_ms).ok()) << "something was fetched";
    EXPECT_TRUE(processes.watch_start({}, 5, now += 900, kPatience_ms).ok());
    const Result<> failed = processes.watch_start({}, 5, now += 100, kPatience_ms);
    ASSERT_FALSE(failed.ok());
    const std::string& text = failed.error().message;
    EXPECT_EQ(failed.error().code, "not-joined");
    EXPECT_NE(text.find("1 of 6"), std::string::npos) << text;
    EXPECT_EQ(text.find("5 of 6"), std::string::npos) << "the others are counted";
    EXPECT_NE(text.find("1.0 s"), std::string::npos) << text;
}

TEST(SimulatorProcesses, TheStartIsOverWhenAllHaveJoined) {
    SimulatorProcesses processes;
    ASSERT_TRUE(processes.start(child("Sleeps")).ok());
    EXPECT_TRUE(processes.starting());
    EXPECT_TRUE(processes.watch_start({"elsewhere/1"}, 0, 1, kPatience_ms).ok());
    EXPECT_TRUE(processes.starting());
    EXPECT_TRUE(processes.watch_start(processes.names(), 0, 2, kPatience_ms).ok());
    EXPECT_FALSE(processes.starting());
    EXPECT_TRUE(processes.watch_start({}, 0, 60'000, kPatience_ms).ok())
        << "later losses do not fail the start";
}

TEST(Threads, AreSharedByProcessesAndAtLeastOneEach) {
    EXPECT_GE(cores(), 1);
    EXPECT_EQ(threads_of_each(3, 64), 3);
    EXPECT_EQ(threads_of_each(0, 1), cores());
    EXPECT_EQ(threads_of_each(0, cores()), 1);
    EXPECT_EQ(threads_of_each(0, 100 * cores()), 1);
}

}  // namespace
}  // namespace roboss
