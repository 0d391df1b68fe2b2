// A pool of threads that runs a batch of independent items. Which thread runs an item is open, so no result
// may depend on it. The calling thread works too: a pool of one thread starts none. Only as many workers wake
// as there are items for, and one that wakes when the items are done is not waited for; unused threads cost
// a small batch nothing.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace roboss {

class ThreadPool {
  public:
    using Work = std::function<void(std::size_t item, std::size_t worker)>;

    /// `threads` counts the calling thread; 0 is taken as 1. A system that starts no more threads gives a
    /// pool of fewer.
    explicit ThreadPool(unsigned threads);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    std::size_t threads() const { return workers_.size() + 1; }

    /// Calls work(item, worker) once for every item in 0 .. count-1 and returns when all are done. worker <
    /// threads(); the calling thread is worker 0; while it waits for the others it calls `idle`, if given,
    /// every few milliseconds. Items are claimed in ascending order, so put the largest first. One run at a
    /// time.
    void run(std::size_t count, const Work& work, const std::function<void()>& idle = {});

    /// Likewise for short batches, one soon after the other: workers look out for the next one for some ten
    /// microseconds before they sleep.
    void run_short(std::size_t count, const Work& work);

    /// Likewise, and each worker has a share of its own, the same in each batch of that size, so what it
    /// works on stays in its cache. It goes through it from the front; those that are done take over items of
    /// others from the back. At most 2^32 - 1 items.
    void run_shares(std::size_t count, const Work& work);

  private:
    /// Items of one worker that are not claimed yet: the first in the upper half, the end in the lower.
    struct alignas(64) Share {
        std::atomic<std::uint64_t> items{0};
        bool claim(bool from_front, std::size_t& item);
    };
    void serve(std::size_t worker);
    enum class Batch { kLong, kShort, kShares };
    void start(std::size_t count, const Work& work, Batch kind);
    void run_batch(std::size_t count, const Work& work, Batch kind, const std::function<void()>& idle);
    void claim(std::size_t worker, Batch kind);
    void claim_all(std::size_t worker);
    void claim_shares(std::size_t worker);
    void finish(const std::function<void()>& idle);
    bool join(std::uint64_t& served, Batch& kind);
    void leave();

    std::vector<std::thread> workers_;
    std::unique_ptr<Share[]> shares_;  // by worker
    const Work* work_ = nullptr;
    std::size_t count_ = 0;
    Batch kind_ = Batch::kLong;
    /// The batch: its number, whether workers may join it, and how many have joined it and not finished.
    alignas(64) std::atomic<std::uint64_t> batch_{0};
    alignas(64) std::atomic<std::size_t> next_{0};
    alignas(64) std::atomic<std::size_t> sleepers_{0};  // workers that wait for start_
    std::atomic<bool> caller_sleeps_{false};            // it waits for done_
    std::atomic<bool> ending_{false};
    std::mutex mutex_;
    std::condition_variable start_, done_;
};

}  // namespace roboss
