// A group of robots that may meet each other and no others: one kind of batch of a tick (tick.h).
#pragma once

#include <algorithm>

#include "physics/contact/contact_island.h"
#include "physics/group_scratch.h"

namespace roboss {

/// One call of step_island, as its batches see it.
struct StepCall {
    const Model& model;
    Tick tick;
    std::span<const RobotId> robots;
    std::span<RobotState* const> states;
    std::span<Aabb> bounds;
    const std::vector<char>& ordered;  // by robot: an order changed it at this tick
    StepReport& report;
    StageClock& clock;
};

/// The stages of a group, called by step_robots in the order in which they are declared.
class RobotGroup {
  public:
    /// `chosen`, ascending, index the call's robots; `works`: buffers for as many. A group of one costs no
    /// search for pairs.
    RobotGroup(const StepCall& call, std::span<const std::uint32_t> chosen, std::span<RobotWork> works,
               GroupScratch& scratch)
        : call_(call), chosen_(chosen), robots_(works), s_(scratch) {}

    /// False if a robot is beyond numbers: then it is reported, and none is stepped.
    bool forward_kinematics();
    void wake_left_sleepers() { wake_left(call_.model, robots_, s_.wake); }
    void form_bonds() { s_.bonds.form(call_.model, robots_, s_.wake); }
    void find_pairs() { s_.finder.find_pairs(robots_); }
    void wake_touched_sleepers() { wake_touched(call_.model, robots_, s_.finder, s_.wake); }
    void hold_bonds() { s_.bonds.hold(robots_); }
    bool find_contacts();
    void build_contact_islands();
    /// step(ContactIsland&, StageClock&) for each; those of one robot go in lanes where they can, a few at a
    /// time. A team steps small islands side by side, and shares the work of large ones.
    template <class StepIsland>
    void for_each_contact_island(StepIsland&& step, StageClock& clock);
    void report();

  private:
    bool goes_in_lanes(std::span<const std::uint32_t> members) const;
    std::uint64_t lane_kind(std::uint32_t robot) const;
    Team team() const;
    void start_islands();
    std::size_t count_large();
    void sort_shares(std::size_t first);
    void keep_contact_reports();

    const StepCall& call_;
    std::span<const std::uint32_t> chosen_;
    std::span<RobotWork> robots_;
    GroupScratch& s_;
    std::size_t weight_ = 0;  // of all robots (weight_of)
};

template <class StepIsland>
void RobotGroup::for_each_contact_island(StepIsland&& step, StageClock& clock) {
    const Model& model = call_.model;
    const auto step_one = [&](std::span<const std::uint32_t> members) {
        ContactIsland island(model, robots_, members, s_.island[0], call_.report);
        step(island, clock);
    };
    const auto lane_of = [&](std::uint32_t i) {
        return LaneRobot{robots_[i].id, robots_[i].state, nullptr, true, contacts_of(i, s_.contacts)};
    };
    const auto step_lanes = [&](std::vector<std::uint32_t>& batch) {
        step_batch(s_.lanes, model, batch, call_.report, call_.clock, lane_of,
                   [&](std::uint32_t i, bool stepped) {
                       if (s_.rough) s_.rough_luck.note(stepped);
                       if (!stepped) return step_one({&i, 1});
                       robots_[i].held = true;
                   });
    };
    start_islands();
    s_.islands.for_each_set(s_.members, [&](std::span<const std::uint32_t> members) {
        if (!goes_in_lanes(members)) {
            if (team().size() == 1) return step_one(members);
            return s_.waiting.push_back(members);
        }
        s_.lane_members.push_back({lane_kind(members[0]), members[0]});
    });
    std::ranges::sort(s_.lane_members);
    for (std::size_t k = 0; k < s_.lane_members.size(); ++k) {
        s_.batch.push_back(s_.lane_members[k].robot);
        const bool ends =
            k + 1 == s_.lane_members.size() || s_.lane_members[k + 1].kind != s_.lane_members[k].kind;
        if (ends || s_.batch.size() == s_.lanes.width()) step_lanes(s_.batch);
    }
    if (s_.waiting.empty()) return;
    const std::size_t large = count_large();
    s_.island[0].team = team();
    for (std::size_t i = 0; i < large; ++i) step_one(s_.waiting[i]);
    s_.island[0].team = {};
    sort_shares(large);
    clock.enter(Stage::kVelocities);  // of all that follows; it is most of it
    s_.reports.assign(team().size(), {});
    team().run(s_.waiting.size() - large, [&](std::size_t i, std::size_t worker) {
        ContactIsland island(model, robots_, s_.waiting[large + i], s_.island[worker], s_.reports[worker]);
        StageClock no_clock;
        step(island, no_clock);
    });
    for (const StepReport& report : s_.reports) call_.report.add_solves(report);
}

}  // namespace roboss
