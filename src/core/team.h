// A thread pool that one call may share its work with, or none. Unlike the pool itself it keeps the
// floating-point environment of a step, and a run of it allocates nothing.
#pragma once

#include <functional>

#include "core/float_env.h"
#include "core/thread_pool.h"

namespace roboss {

class Team {
  public:
    /// The calling thread alone.
    Team() = default;
    /// All threads of the pool, which must not be running.
    explicit Team(ThreadPool& pool) : pool_(&pool) {}

    std::size_t size() const { return pool_ == nullptr ? 1 : pool_->threads(); }

    /// work(item, worker) once for every item in 0 .. count-1; worker < size(). Returns when all are done.
    template <class Work>
    void run(std::size_t count, const Work& work) const {
        if (size() == 1 || count < 2) {
            for (std::size_t item = 0; item < count; ++item) work(item, std::size_t{0});
            return;
        }
        const auto work_exactly = [&work](std::size_t item, std::size_t worker) {
            const ExactFloatScope exact;
            work(item, worker);
        };
        pool_->run(count, std::cref(work_exactly));
    }

  private:
    ThreadPool* pool_ = nullptr;
};

}  // namespace roboss
