// The pool runs every item exactly once, batch after batch.
#include "core/thread_pool.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>

namespace roboss {
namespace {

TEST(ThreadPool, RunsEveryItemOnceInEveryBatch) {
    for (const unsigned threads : {0u, 1u, 2u, 5u}) {
        ThreadPool pool(threads);
        for (std::size_t batch = 0; batch < 200; ++batch) {
            std::vector<int> hits(batch, 0);
            pool.run(batch, [&](std::size_t item, std::size_t worker) {
                ASSERT_LT(worker, pool.threads());
                ++hits[item];
            });
            for (const int hit : hits) ASSERT_EQ(hit, 1);
        }
    }
}

TEST(ThreadPool, BatchesSmallerThanThePoolMixWithLargeOnes) {
    ThreadPool pool(9);
    for (std::size_t batch = 0; batch < 2'000; ++batch) {
        std::vector<int> hits(batch % 7 == 0 ? 40 : 2 + batch % 3, 0);
        pool.run(hits.size(), [&](std::size_t item, std::size_t) { ++hits[item]; });
        for (const int hit : hits) ASSERT_EQ(hit, 1) << "batch " << batch;
    }
}

TEST(ThreadPool, ShortBatchesRunEveryItemOnceToo) {
    for (const unsigned threads : {1U, 2U, 3U, 5U}) {
        ThreadPool pool(threads);
        for (std::size_t batch = 0; batch < 20'000; ++batch) {
            std::vector<int> hits(batch % 23, 0);
            const auto hit = [&](std::size_t item, std::size_t worker) {
                ASSERT_LT(worker, pool.threads());
                ++hits[item];
            };
            if (batch % 3 == 0)
                pool.run_short(hits.size(), hit);
            else
                pool.run_shares(hits.size(), hit);
            if (batch % 5000 == 0) pool.run(hits.size(), [](std::size_t, std::size_t) {});  // to sleep
            for (const int count : hits) ASSERT_EQ(count, 1) << "batch " << batch;
        }
    }
}

TEST(ThreadPool, AnItemOfAShortBatchMayWaitForThoseBeforeIt) {
    ThreadPool pool(4);
    for (int batch = 0; batch < 500; ++batch) {
        std::atomic<std::size_t> done{0};
        pool.run_short(50, [&](std::size_t item, std::size_t) {
            while (done != item) std::this_thread::yield();
            ++done;
        });
        ASSERT_EQ(done, 50U);
    }
}

// Stacks of threads need address space: a process with little left is one whose system starts few threads.
void work_with_little_address_space() {
    constexpr rlim_t kLittle = rlim_t{256} << 20;
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t most = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + kLittle;
    const rlimit limit{most, most};
    if (setrlimit(RLIMIT_AS, &limit) != 0) std::exit(1);
    ThreadPool pool(1000);
    if (pool.threads() >= 1000) std::exit(2);
    std::vector<int> hits(5'000, 0);
    pool.run(hits.size(), [&](std::size_t item, std::size_t) { ++hits[item]; });
    std::exit(std::ranges::all_of(hits, [](int hit) { return hit == 1; }) ? 0 : 3);
}

TEST(ThreadPoolDeathTest, ASystemThatStartsNoMoreThreadsGivesAPoolOfFewer) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers need much address space themselves";
#endif
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(work_with_little_address_space(), testing::ExitedWithCode(0), "");
}

TEST(ThreadPool, ShowsSignsOfLifeWhileTheCallerWaitsForOthers) {
    using namespace std::chrono;
    ThreadPool pool(2);
    std::atomic<bool> was_idle{false};
    std::atomic<int> taken{0};
    const auto work = [&](std::size_t, std::size_t worker) {
        ++taken;
        while (taken < 2) std::this_thread::yield();  // so each thread has one item
        const auto end = steady_clock::now() + seconds(20);
        while (worker != 0 && !was_idle && steady_clock::now() < end)
            std::this_thread::sleep_for(milliseconds(1));
    };
    pool.run(2, work, [&] { was_idle = true; });
    EXPECT_TRUE(was_idle);
}

}  // namespace
}  // namespace roboss
