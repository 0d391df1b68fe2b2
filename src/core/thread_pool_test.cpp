// The pool runs every item exactly once, batch after batch.
#include "core/thread_pool.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace roboss
