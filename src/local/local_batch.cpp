// See local_batch.h.
#include "local/local_batch.h"

namespace roboss {

Result<std::unique_ptr<LocalBatch>> LocalBatch::create(std::shared_ptr<const Model> model, std::size_t count,
                                                       const LocalRunOptions& options) {
    return create(std::vector(count, std::move(model)), options);
}

Result<std::unique_ptr<LocalBatch>> LocalBatch::create(
    const std::vector<std::shared_ptr<const Model>>& models, const LocalRunOptions& options) {
    std::unique_ptr<LocalBatch> batch(new LocalBatch(options.threads));
    for (std::size_t i = 0; i < models.size(); ++i) {
        Result<std::unique_ptr<LocalRun>> run =
            LocalRun::create(models[i], {.threads = 1, .lanes = options.lanes, .seed = options.seed + i});
        if (!run) return run.error();
        batch->runs_.push_back(std::move(run).value());
    }
    return batch;
}

std::vector<Result<>> LocalBatch::step(Tick ticks) {
    std::vector<Result<>> results(runs_.size(), Ok{});
    for_each([&](std::size_t i, LocalRun& run) { results[i] = run.step(ticks); });
    return results;
}

void LocalBatch::for_each(const std::function<void(std::size_t i, LocalRun& run)>& work) {
    pool_.run(runs_.size(), [&](std::size_t i, std::size_t) { work(i, *runs_[i]); });
}

}  // namespace roboss
