// LocalBatch: many runs, of one world or of several, on one pool of threads, each stepped by one thread at a
// time. For learning and sampling: small worlds, many of them.
#pragma once

#include <functional>

#include "core/thread_pool.h"
#include "local/local_run.h"

namespace roboss {

/// See the top of the file. Not for use by several threads at once.
class LocalBatch {
  public:
    /// `count` runs at the beginning of the world; run i has the seed options.seed + i. `options.threads`
    /// step them. Errors: those of LocalRun::create().
    static Result<std::unique_ptr<LocalBatch>> create(std::shared_ptr<const Model> model, std::size_t count,
                                                      const LocalRunOptions& options = {});

    /// The same, run i of models[i].
    static Result<std::unique_ptr<LocalBatch>> create(const std::vector<std::shared_ptr<const Model>>& models,
                                                      const LocalRunOptions& options = {});

    std::size_t size() const { return runs_.size(); }        ///< how many runs
    LocalRun& run(std::size_t i) { return *runs_[i]; }       ///< each goes its own way
    std::size_t threads() const { return pool_.threads(); }  ///< that step

    /// Advances all runs by `ticks` time steps. result[i] is that of LocalRun::step(): a run that stops keeps
    /// no other from going on.
    std::vector<Result<>> step(Tick ticks);
    /// Calls work(i, run) for each run, some at the same time.
    void for_each(const std::function<void(std::size_t i, LocalRun& run)>& work);

  private:
    explicit LocalBatch(unsigned threads) : pool_(threads) {}

    ThreadPool pool_;
    std::vector<std::unique_ptr<LocalRun>> runs_;
};

}  // namespace roboss
