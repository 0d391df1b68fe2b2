// Checkpoints: all states at a committed tick, kept by the Controller, and which robots may have interacted
// since. From them it recomputes what a lost Simulator held. The next checkpoint is fetched from the
// Simulators while they step on:
//
//     none --begin--> fetching --all states are here--> fetched --replace--> it is the checkpoint; none
//                        \--a Simulator is lost: abandon--> none
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bus/state_pull.h"
#include "model/model.h"
#include "roles/controller/state_directory.h"
#include "schedule/islands.h"

namespace roboss {

class Checkpoints {
  public:
    using States = std::shared_ptr<std::vector<RobotState>>;  // by RobotId

    Checkpoints(std::shared_ptr<const Model> model, Tick tick, std::vector<RobotState> states);

    /// Of the checkpoint.
    Tick tick() const { return base_.tick; }
    /// Never changed any more.
    const States& states() const { return base_.states; }
    /// Sends states of the checkpoint to a Simulator that asks for them.
    void serve(Bus& bus, const Address& from, const StateRequest& request) const;
    /// These robots and all that they may have interacted with since. Ascending. `wanted`: by RobotId.
    std::vector<RobotId> closure(const std::vector<bool>& wanted);
    /// Connects robots that may have interacted since the checkpoint.
    UnionFind& touched() { return base_.touched; }

    /// A window was committed; `busiest_s`: stepping CPU time of its busiest Simulator.
    void committed(const Islands& islands, double busiest_s);
    /// That CPU time, summed since the last checkpoint was begun.
    double work_s() const { return work_s_; }

    // The next checkpoint.
    /// Somebody needs all states at the committed tick: a checkpoint begins at the next window boundary.
    void request() { requested_ = true; }
    bool requested() const { return requested_; }
    /// Begins a checkpoint at the committed tick, unless one is under way or there already, or states are
    /// lost. Only notes which states are needed, since assignments wait for it; advance() fetches them.
    void begin(StateDirectory& directory, const Roster& roster);
    bool under_way() const { return next_.has_value(); }
    /// The checkpoint is of this tick, or the next one will be.
    bool has_or_fetches(Tick tick) const { return base_.tick == tick || (next_ && next_->tick == tick); }
    void accept(const StateReply& reply);
    /// To be called before the next commit, so that the directory still has the holders of its tick.
    void advance(Bus& bus, const StateDirectory& directory, const Roster& roster, std::int64_t resend_ms);
    bool fetched() const { return pull_.complete(); }
    /// The fetched one becomes the checkpoint. False while an earlier tick is wanted, which could not be
    /// recomputed from it.
    bool replace(StateDirectory& directory);
    /// A Simulator was lost, and so are states that are not here yet. Returns the tick of the abandoned
    /// checkpoint. None: nothing was being fetched. A request for it is kept.
    std::optional<Tick> abandon(StateDirectory& directory);

    /// All states at `tick`, if they are here.
    const std::vector<RobotState>* states_at(Tick tick) const;

  private:
    struct Checkpoint {
        Tick tick = 0;
        States states;  // null: not being fetched yet
        UnionFind touched;
        bool requested = false;
    };
    std::shared_ptr<const Model> model_;
    Checkpoint base_;
    std::optional<Checkpoint> next_;
    StatePull pull_;
    double work_s_ = 0;
    bool requested_ = false;
};

}  // namespace roboss
