// The pool: workers sleep between batches and claim items with one atomic counter.
#include "core/thread_pool.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <system_error>

namespace roboss {

ThreadPool::ThreadPool(unsigned threads) {
    if (threads > 1) workers_.reserve(threads - 1);
    for (unsigned i = 1; i < threads; ++i) {
        try {
            workers_.emplace_back([this, i] { serve(i); });
        } catch (const std::system_error&) {
            break;
        } catch (const std::bad_alloc&) {
            break;
        }
    }
}

ThreadPool::~ThreadPool() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    start_.notify_all();
    for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::claim_all(std::size_t worker) {
    for (std::size_t item = next_.fetch_add(1); item < count_; item = next_.fetch_add(1))
        (*work_)(item, worker);
}

void ThreadPool::run(std::size_t count, const Work& work, const std::function<void()>& idle) {
    if (workers_.empty() || count < 2) {
        for (std::size_t item = 0; item < count; ++item) work(item, 0);
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        work_ = &work;
        count_ = count;
        next_ = 0;
        open_ = true;
        ++batch_;
    }
    for (std::size_t i = 0; i < std::min(count - 1, workers_.size()); ++i) start_.notify_one();
    claim_all(0);
    std::unique_lock lock(mutex_);
    open_ = false;
    const auto all_done = [this] { return busy_ == 0; };
    while (idle && !done_.wait_for(lock, std::chrono::milliseconds(10), all_done)) {
        lock.unlock();
        idle();
        lock.lock();
    }
    done_.wait(lock, all_done);
}

void ThreadPool::serve(std::size_t worker) {
    std::uint64_t served = 0;
    while (true) {
        {
            std::unique_lock lock(mutex_);
            start_.wait(lock, [&] { return ending_ || (open_ && batch_ != served); });
            if (ending_) return;
            served = batch_;
            ++busy_;
        }
        claim_all(worker);
        const std::lock_guard lock(mutex_);
        if (--busy_ == 0) done_.notify_one();
    }
}

}  // namespace roboss
