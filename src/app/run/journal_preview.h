// JournalPreview: shows what a run looked like at an earlier time of its journal, while it goes on. A thread
// of its own, of low priority, reads the journal through a handle of its own and steps the recorded run from
// the nearest checkpoint (simulation/replay.h). Nothing of the run itself is touched.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "journal/journal.h"
#include "simulation/simulation.h"
#include "wire/message.h"
#include "wire/view_state.h"

namespace roboss {

class JournalPreview {
  public:
    explicit JournalPreview(std::string file) : file_(std::move(file)) {}
    ~JournalPreview();
    JournalPreview(const JournalPreview&) = delete;
    JournalPreview& operator=(const JournalPreview&) = delete;

    using Answer = std::function<void(ControlOutcome)>;
    /// A request of `asker`, and who sends it the outcome: RunPreview or ControlRefused.
    struct Request {
        Address asker;
        PreviewRun wanted;
        Answer answer;
    };
    /// The reply shows robots of `shown`. Branch 0 is `present`. A request that waits is refused [superseded]
    /// when the same requester makes another.
    void ask(Request request, std::shared_ptr<const Model> shown, BranchId present);
    struct Reply {
        Answer answer;
        ControlOutcome outcome;
    };
    std::vector<Reply> take_replies();

  private:
    struct Question {
        Request request;
        std::shared_ptr<const Model> shown;
        BranchId present = 0;
    };
    /// A recorded run that can be stepped on, so that the next moment behind it does not start from the
    /// checkpoint.
    struct Warm {
        Address asker;
        BranchId branch = 0;
        Tick until = 0;  // its orders are known up to here
        std::shared_ptr<const Model> model;
        std::unique_ptr<Simulation> simulation;
    };
    static constexpr std::size_t kWarmMost = 3;
    struct Moment {
        Branch branch;
        CheckpointEntry checkpoint;  // the nearest one at or before `tick`
        Tick until = 0;              // next checkpoint, or the end of the branch
        Tick tick = 0;
    };

    void serve();
    ControlOutcome preview(const Question& question);
    Result<Moment> find(const Question& question);
    Result<Moment> look_up(const PreviewRun& wanted, BranchId branch, double dt_s) const;
    Result<Warm*> warm_at(const Question& question, const Moment& moment);
    bool goes_on(const Address& asker);
    RunPreview shown(const Question& question, const Moment& moment, Warm& warm);
    Result<> read_journal();

    std::string file_;
    std::optional<Journal> journal_;  // of the thread, like all up to the mutex
    std::int64_t read_ms_ = 0;
    std::list<Warm> warm_;  // the one used last is the first
    std::shared_ptr<const Model> shown_model_;
    std::optional<ViewLayout> layout_;

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Question> questions_;  // one for each requester
    std::vector<Reply> replies_;
    bool ending_ = false;
    std::thread thread_;  // started by the first question
};

}  // namespace roboss
