#include "app/processes/memory_guard.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <vector>

namespace roboss {
namespace {

namespace fs = std::filesystem;

/// So much address space more may be used by this process; for death tests.
void limit_memory(std::size_t more) {
    std::ifstream statm("/proc/self/statm");
    std::size_t pages = 0;
    statm >> pages;
    const rlim_t bytes = pages * static_cast<std::size_t>(getpagesize()) + more;
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_AS, &limit);
}

/// Allocates 1 MiB again and again until the guard says that it is enough; its words.
std::string fill(MemoryGuard& guard) {
    std::vector<std::vector<char>> all;
    for (int i = 0; i < 10'000; ++i) {
        if (const auto why = guard.exceeded()) return *why;
        all.emplace_back(1 << 20, 'x');
    }
    return "nothing";
}

TEST(MemoryGuardDeathTest, TheFirstAllocationThatFailsIsReportedAndThereIsMemoryForMore) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_EXIT(
        {
            MemoryGuard guard;
            limit_memory(std::size_t{64} << 20);
            const std::string why = fill(guard);
            const std::vector<char> more(8 << 20, 'y');
            _exit(why.find("limit of the process") != std::string::npos && more.back() == 'y' ? 7 : 1);
        },
        testing::ExitedWithCode(7), "");
}

TEST(MemoryGuardDeathTest, OneThatNeedsMoreThanTheReserveEndsWithTheReason) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    EXPECT_EXIT(
        {
            MemoryGuard guard;
            limit_memory(std::size_t{64} << 20);
            const std::vector<char> much(std::size_t{1} << 30, 'z');
            _exit(much.back() == 'z' ? 1 : 2);
        },
        testing::ExitedWithCode(3), "out-of-memory");
}

TEST(MemoryGuard, AControlGroupsLimitIsRead) {
    std::string folder = testing::TempDir() + "roboss-group-XXXXXX";
    ASSERT_NE(mkdtemp(folder.data()), nullptr);
    const auto write = [&](const char* file, const char* text) {
        std::ofstream(folder + "/" + file) << text;
    };
    EXPECT_FALSE(memory_of_group(folder)) << "it has no files";
    write("memory.max", "max\n");
    write("memory.current", "5000\n");
    EXPECT_FALSE(memory_of_group(folder)) << "it has no limit";
    write("memory.max", "8000\n");
    write("memory.stat", "anon 3000\ninactive_file 1200\nactive_file 300\n");
    ASSERT_TRUE(memory_of_group(folder));
    EXPECT_EQ(memory_of_group(folder)->limit, 8000u);
    EXPECT_EQ(memory_of_group(folder)->used, 3500u);
    fs::remove_all(folder);
}

TEST(MemoryGuard, TheGroupIsTheOneOfVersionTwo) {
    EXPECT_EQ(folder_of_group("12:cpu:/a\n0::/user.slice/run\n", "/sys/fs/cgroup"),
              "/sys/fs/cgroup/user.slice/run");
    EXPECT_EQ(folder_of_group("0::/\n", "/sys/fs/cgroup"), "/sys/fs/cgroup/");
    EXPECT_EQ(folder_of_group("", "/sys/fs/cgroup"), "/sys/fs/cgroup");
}

}  // namespace
}  // namespace roboss
