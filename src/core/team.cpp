// See team.h.
#include "core/team.h"

#include <functional>

#include "core/float_env.h"
#include "core/thread_pool.h"

namespace roboss {

std::size_t Team::size() const {
    return pool_ == nullptr ? 1 : pool_->threads();
}

void Team::run_task(std::size_t count, const Task& task, bool by_shares) const {
    if (size() == 1 || count < 2) {
        for (std::size_t item = 0; item < count; ++item) task.call(task.work, item, 0);
        return;
    }
    const auto work = [&task](std::size_t item, std::size_t worker) {
        const ExactFloatScope exact;
        task.call(task.work, item, worker);
    };
    if (by_shares)
        pool_->run_shares(count, std::cref(work));
    else
        pool_->run_short(count, std::cref(work));
}

}  // namespace roboss
