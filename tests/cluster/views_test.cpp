// Viewers see committed states as they are, through losses, faults, hand-offs and a Controller that starts
// anew, and change no result.
#include <gtest/gtest.h>

#include "core/hash.h"
#include "faulty_cluster.h"
#include "test_worlds.h"
#include "wire/state_block.h"
#include "wire/view_state.h"

namespace roboss::test {
namespace {

const Address kViewer{Role::kClient, 4242};

/// What a gateway does, as little of it as can be.
class Watcher {
  public:
    Watcher(std::shared_ptr<const Model> model, ViewRequest request)
        : model_(std::move(model)),
          layout_(*model_),
          request_(std::move(request)),
          entries_(model_->robots.size()) {}

    void advance(Bus& bus) {
        if (bus.now_ms() >= ask_ms_) {
            ask_ms_ = bus.now_ms() + 100;
            bus.send(kViewer, kControllerAddress, request_);
        }
        bus.drain(kViewer, inbox_);
        for (const Envelope& envelope : inbox_) {
            if (const auto* views = std::get_if<ViewStates>(&envelope.message)) take(*views);
            if (const auto* reply = std::get_if<StateReply>(&envelope.message))
                exact_[reply->states.tick] = reply->states;
            changed_ = changed_ || std::holds_alternative<ModelChanged>(envelope.message);
        }
    }
    /// The newest entries of all robots are those of these states.
    bool shows(Tick tick, const std::vector<RobotState>& states) const {
        if (tick_ != tick) return false;
        for (std::size_t r = 0; r < states.size(); ++r) {
            std::vector<std::uint8_t> entry;
            layout_.append(*model_, RobotId(r), states[r], entry);
            if (entries_[r] != entry) return false;
        }
        return true;
    }
    int views() const { return views_; }
    Tick tick() const { return tick_; }
    bool changed() const { return changed_; }
    const std::map<Tick, StateBlock>& exact() const { return exact_; }

  private:
    void take(const ViewStates& views) {
        const std::pair stamp(views.epoch, views.serial);
        if (stamp < newest_) return;
        newest_ = stamp;
        tick_ = views.tick;
        ++views_;
        std::size_t offset = 0;
        while (const std::optional<RobotId> robot = layout_.entry_at(views.entries, offset)) {
            const auto first = views.entries.begin() + static_cast<std::ptrdiff_t>(offset);
            const auto size = static_cast<std::ptrdiff_t>(layout_.bytes_of(*robot));
            entries_[robot->index()].assign(first, first + size);
            offset += layout_.bytes_of(*robot);
        }
        EXPECT_EQ(offset, views.entries.size());
    }

    std::shared_ptr<const Model> model_;
    ViewLayout layout_;
    ViewRequest request_;
    std::vector<std::vector<std::uint8_t>> entries_;
    std::map<Tick, StateBlock> exact_;
    std::pair<std::uint32_t, std::uint64_t> newest_;
    std::vector<Envelope> inbox_;
    std::int64_t ask_ms_ = 0;
    Tick tick_ = -1;
    int views_ = 0;
    bool changed_ = false;
};

ControllerOptions cluster_options() {
    ControllerOptions options;
    options.simulators = 3;
    options.loss_ms = 400;
    options.checkpoint_ticks = 60;
    return options;
}

const std::vector<RobotState>& states_of(FaultyCluster& cluster) {
    for (int i = 0; cluster.controller().states() == nullptr && i < 100'000; ++i) {
        cluster.controller().request_states();
        cluster.turn();
    }
    return *cluster.controller().states();
}

/// The hash at `target`, with or without somebody who watches all the time.
std::uint64_t hash_at(Tick target, const Trouble& trouble, const FaultOptions& faults, Watcher* watcher) {
    const auto model = piles_world(4);
    FaultyCluster cluster(model, cluster_options(), faults, trouble, 3);
    cluster.turn();
    cluster.controller().run_until(target);
    for (int i = 0; i < 400'000 && !cluster.controller().resting(); ++i) {
        if (watcher != nullptr) watcher->advance(cluster.bus());
        cluster.turn();
    }
    EXPECT_TRUE(cluster.controller().resting());
    const std::uint64_t hash = cluster.controller().hash();
    if (watcher == nullptr) return hash;
    const std::vector<RobotState> states = states_of(cluster);
    for (int i = 0; i < 100'000 && !watcher->shows(target, states); ++i) {
        watcher->advance(cluster.bus());
        cluster.turn();
    }
    EXPECT_TRUE(watcher->shows(target, states)) << "at tick " << watcher->tick();
    return hash;
}

TEST(Views, ShowCommittedStatesAndChangeNoHashThroughFaultsAndLosses) {
    Trouble trouble;
    trouble.kill = 30, trouble.join = 60, trouble.leave = 20, trouble.rescue = 2000;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        FaultOptions faults;
        faults.seed = seed;
        Watcher watcher(piles_world(4), {piles_world(4)->hash, 5, 0, false, {}});
        const std::uint64_t watched = hash_at(400, trouble, faults, &watcher);
        EXPECT_EQ(to_hex(watched), to_hex(hash_at(400, {}, faults, nullptr))) << "seed " << seed;
        EXPECT_GT(watcher.views(), 5) << "seed " << seed;
    }
}

TEST(Views, GiveExactStatesOfThoseAskedForOnly) {
    const auto model = piles_world(4);
    Watcher watcher(model, {model->hash, 0, 5, false, {RobotId(2u), RobotId(5u), RobotId(9999u)}});
    FaultyCluster cluster(model, cluster_options(), {}, {}, 3);
    cluster.turn();
    cluster.controller().run_until(300);
    for (int i = 0; i < 400'000 && (!cluster.controller().resting() || !watcher.exact().contains(300)); ++i) {
        watcher.advance(cluster.bus());
        cluster.turn();
    }
    ASSERT_TRUE(watcher.exact().contains(300));
    const std::vector<RobotState>& states = states_of(cluster);
    const StateBlock& block = watcher.exact().at(300);
    std::size_t offset = 0;
    for (std::size_t i = 0; i < block.robots.size(); ++i) {
        EXPECT_TRUE(block.robots[i] == RobotId(2u) || block.robots[i] == RobotId(5u));
        const auto state = decode_state(state_bytes(block, i, offset), model->type_of(block.robots[i]));
        ASSERT_TRUE(state.ok());
        EXPECT_EQ(state.value(), states[block.robots[i].index()]);
        offset += block.sizes[i];
    }
    EXPECT_EQ(watcher.views(), 0);
}

TEST(Views, OfAnotherModelAreAnsweredByTheNews) {
    const auto model = piles_world(4);
    Watcher watcher(model, {model->hash ^ 1, 5, 0, false, {}});
    FaultyCluster cluster(model, cluster_options(), {}, {}, 3);
    cluster.turn();
    cluster.controller().run_until(50);
    for (int i = 0; i < 100'000 && !watcher.changed(); ++i) {
        watcher.advance(cluster.bus());
        cluster.turn();
    }
    EXPECT_TRUE(watcher.changed());
    EXPECT_EQ(watcher.views(), 0);
}

TEST(Views, GoOnWhenTheControllerIsStartedAnew) {
    const auto model = piles_world(4);
    Watcher watcher(model, {model->hash, 5, 0, false, {}});
    FaultyCluster cluster(model, cluster_options(), {}, {}, 3);
    ASSERT_TRUE(cluster.run_until(100));
    for (int i = 0; i < 100'000 && watcher.tick() < 100; ++i) {
        watcher.advance(cluster.bus());
        cluster.turn();
    }
    cluster.restart_controller({100, states_of(cluster), {}, 100, {}});
    cluster.controller().run_until(200);
    for (int i = 0; i < 400'000 && !cluster.controller().resting(); ++i) cluster.turn();
    const std::vector<RobotState> states = states_of(cluster);
    for (int i = 0; i < 100'000 && !watcher.shows(200, states); ++i) {
        watcher.advance(cluster.bus());
        cluster.turn();
    }
    EXPECT_TRUE(watcher.shows(200, states));
}

}  // namespace
}  // namespace roboss::test
