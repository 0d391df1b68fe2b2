// A pool of threads that runs a batch of independent items. Which thread runs an item is open, so no result
// may depend on it; items are claimed in ascending order, so put the largest first. The calling thread works
// too: a pool of one thread starts none. Only as many workers wake as there are items for, and one that wakes
// when the items are done is not waited for; so many threads cost a small batch nothing.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
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
    /// every few milliseconds. One run at a time.
    void run(std::size_t count, const Work& work, const std::function<void()>& idle = {});

  private:
    void serve(std::size_t worker);
    void claim_all(std::size_t worker);

    std::vector<std::thread> workers_;
    std::mutex mutex_;
    std::condition_variable start_, done_;
    const Work* work_ = nullptr;
    std::size_t count_ = 0;
    std::atomic<std::size_t> next_{0};
    bool open_ = false;        // workers may join this batch
    std::size_t busy_ = 0;     // workers that have joined it and not finished
    std::uint64_t batch_ = 0;  // its number, so that no worker serves one twice
    bool ending_ = false;
};

}  // namespace roboss
