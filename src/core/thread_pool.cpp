// The pool: workers sleep between batches, or look out for the next one, and claim items with atomic
// counters.
#include "core/thread_pool.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <system_error>

namespace roboss {
namespace {

// The word that tells of a batch: bit 63 to 16 its number, bit 15 whether workers may join, the rest how many
// are at it.
constexpr std::uint64_t kOpen = std::uint64_t{1} << 15, kBatch = std::uint64_t{1} << 16, kBusy = kOpen - 1;

constexpr std::uint64_t kUpper = std::uint64_t{1} << 32;  // one of the upper half of a share

/// Some ten nanoseconds in which the other thread of a core may have its units.
void relax() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
}

/// Waits for `is_so` a short while, first in a loop, then by giving way to other threads of the machine.
/// False if it did not come.
template <class IsSo>
bool look_out(int rounds, const IsSo& is_so) {
    constexpr int kPauses = 32, kLoops = 8;  // some microseconds
    for (int round = 0; round < rounds; ++round) {
        for (int i = 0; i < kPauses; ++i) {
            if (is_so()) return true;
            relax();
        }
        if (round >= kLoops) std::this_thread::yield();
    }
    return false;
}

constexpr int kRoundsForBatch = 40, kRoundsForOthers = 20;

}  // namespace

ThreadPool::ThreadPool(unsigned threads) {
    shares_ = std::make_unique<Share[]>(std::max(threads, 1U));
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

bool ThreadPool::Share::claim(bool from_front, std::size_t& item) {
    std::uint64_t left = items.load(std::memory_order_relaxed);
    while (left / kUpper < left % kUpper) {
        if (!items.compare_exchange_weak(left, from_front ? left + kUpper : left - 1)) continue;
        item = static_cast<std::size_t>(from_front ? left / kUpper : left % kUpper - 1);
        return true;
    }
    return false;
}

void ThreadPool::claim_shares(std::size_t worker) {
    for (std::size_t k = 0; k < threads(); ++k)
        for (std::size_t item = 0; shares_[(worker + k) % threads()].claim(k == 0, item);)
            (*work_)(item, worker);
}

/// Tells the workers of a batch, and wakes as many sleepers as there are items for.
void ThreadPool::start(std::size_t count, const Work& work, Batch kind) {
    work_ = &work;
    count_ = count;
    kind_ = kind;
    next_.store(0, std::memory_order_relaxed);
    for (std::size_t w = 0; kind == Batch::kShares && w < threads(); ++w) {
        const std::size_t first = count * w / threads(), end = count * (w + 1) / threads();
        shares_[w].items.store(first * kUpper + end, std::memory_order_relaxed);
    }
    batch_ = ((batch_ & ~(kBatch - 1)) + kBatch) | kOpen;
    if (sleepers_ == 0) return;
    { const std::lock_guard lock(mutex_); }  // who found no batch is asleep by now
    for (std::size_t i = std::min(count - 1, sleepers_.load()); i > 0; --i) start_.notify_one();
}

/// Waits for the workers that have joined.
void ThreadPool::finish(const std::function<void()>& idle) {
    batch_ &= ~kOpen;
    const auto all_done = [this] { return (batch_ & kBusy) == 0; };
    if (look_out(kRoundsForOthers, all_done)) return;
    std::unique_lock lock(mutex_);
    caller_sleeps_ = true;
    while (idle && !done_.wait_for(lock, std::chrono::milliseconds(10), all_done)) {
        lock.unlock();
        idle();
        lock.lock();
    }
    done_.wait(lock, all_done);
    caller_sleeps_ = false;
}

void ThreadPool::claim(std::size_t worker, Batch kind) {
    kind == Batch::kShares ? claim_shares(worker) : claim_all(worker);
}

void ThreadPool::run_batch(std::size_t count, const Work& work, Batch kind,
                           const std::function<void()>& idle) {
    if (workers_.empty() || count < 2) {
        for (std::size_t item = 0; item < count; ++item) work(item, 0);
        return;
    }
    start(count, work, kind);
    claim(0, kind);
    finish(idle);
}

void ThreadPool::run(std::size_t count, const Work& work, const std::function<void()>& idle) {
    run_batch(count, work, Batch::kLong, idle);
}

void ThreadPool::run_short(std::size_t count, const Work& work) {
    run_batch(count, work, Batch::kShort, {});
}

void ThreadPool::run_shares(std::size_t count, const Work& work) {
    run_batch(count, work, Batch::kShares, {});
}

/// True if there is a batch to join that the worker has not served, and it has joined it.
bool ThreadPool::join(std::uint64_t& served, Batch& kind) {
    std::uint64_t batch = batch_;
    while ((batch & kOpen) != 0 && batch / kBatch != served)
        if (batch_.compare_exchange_weak(batch, batch + 1)) {
            served = batch / kBatch;
            kind = kind_;
            return true;
        }
    return false;
}

void ThreadPool::leave() {
    if ((--batch_ & kBusy) != 0 || !caller_sleeps_) return;
    { const std::lock_guard lock(mutex_); }
    done_.notify_one();
}

void ThreadPool::serve(std::size_t worker) {
    std::uint64_t served = 0;
    Batch kind = Batch::kLong;  // of the last one
    while (true) {
        const auto joined = [&] { return join(served, kind); };
        if (kind == Batch::kLong || !look_out(kRoundsForBatch, joined)) {
            std::unique_lock lock(mutex_);
            ++sleepers_;
            start_.wait(lock, [&] { return ending_ || joined(); });
            --sleepers_;
            if (ending_) return;
        }
        claim(worker, kind);
        leave();
    }
}

}  // namespace roboss
