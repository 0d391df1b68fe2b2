// A thread pool that one call may share its work with, or none. Unlike the pool itself it keeps the
// floating-point environment of a step, and a run of it allocates nothing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace roboss {

class ThreadPool;

class Team {
  public:
    /// The calling thread alone.
    Team() = default;
    /// All threads of the pool, which must not be running.
    explicit Team(ThreadPool& pool) : pool_(&pool) {}

    std::size_t size() const;

    /// work(item, worker) once for every item in 0 .. count-1; worker < size(). Returns when all are done.
    /// Each worker begins with a share of its own, those from first_of(count, worker) on, in their order
    /// (ThreadPool::run_shares).
    template <class Work>
    void run(std::size_t count, const Work& work) const {
        run_task(count, {&call<Work>, &work}, true);
    }
    /// Likewise, but items are claimed in ascending order, so one may wait for those before it.
    template <class Work>
    void run_in_order(std::size_t count, const Work& work) const {
        run_task(count, {&call<Work>, &work}, false);
    }
    std::size_t first_of(std::size_t count, std::size_t worker) const { return count * worker / size(); }
    /// Sorts items for run(): by ascending key(item), of which no two are equal, and within each worker's
    /// share the largest weight(item) first.
    template <class Item, class Weight, class Key>
    void sort_shares(std::span<Item> items, const Weight& weight, const Key& key) const {
        std::ranges::sort(items, {}, key);
        for (std::size_t worker = 0; worker < size(); ++worker) {
            const std::size_t begin = first_of(items.size(), worker),
                              end = first_of(items.size(), worker + 1);
            std::ranges::sort(items.subspan(begin, end - begin), [&](const Item& a, const Item& b) {
                return std::pair(weight(b), key(a)) < std::pair(weight(a), key(b));
            });
        }
    }
    /// work(first, last) for blocks of the items 0 .. count-1: side by side if there are at least two, else
    /// all at once.
    template <class Work>
    void run_blocks(std::size_t count, std::size_t block, const Work& work) const {
        if (size() == 1 || count <= block) return work(std::size_t{0}, count);
        run((count + block - 1) / block, [&](std::size_t k, std::size_t) {
            const std::size_t first = k * block, rest = count - first;
            work(first, first + (rest < block ? rest : block));
        });
    }

  private:
    struct Task {
        void (*call)(const void* work, std::size_t item, std::size_t worker);
        const void* work;
    };
    void run_task(std::size_t count, const Task& task, bool by_shares) const;
    template <class Work>
    static void call(const void* work, std::size_t item, std::size_t worker) {
        (*static_cast<const Work*>(work))(item, worker);
    }

    ThreadPool* pool_ = nullptr;
};

}  // namespace roboss
