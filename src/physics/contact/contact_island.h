// One contact island in one tick: robots of a group that are connected by contacts, near misses or bonds. It
// is solved by itself, so nothing depends on the other robots of the group.
#pragma once

#include <algorithm>
#include <cmath>

#include "physics/island_scratch.h"

namespace roboss {

/// False for what the second look cannot compute with: it ends the run, or soon will.
inline bool is_plausible(std::span<const double> x) {
    constexpr double kMost = 1e7;  // m, rad, m/s, rad/s
    return std::ranges::all_of(x, [](double each) { return std::fabs(each) < kMost; });
}

/// The island as the second look sees it, its first `found` contacts being those of the beginning of the
/// tick.
inline SolvedIsland solved_island(const Model& model, std::span<const RobotWork> robots,
                                  std::span<const std::uint32_t> members, const IslandScratch& s,
                                  std::size_t found) {
    return {model,
            robots,
            members,
            s.offsets_of_group,
            s.group.near_misses,
            {s.contacts.data(), found},
            s.v,
            s.displacement,
            s.drifts,
            s.large_turns,
            false,
            *s.group.free_courses};
}

/// The stages of an island, called by step_robots (tick.h) in the order in which they are declared. Rows,
/// velocities and displacements pass from stage to stage in the scratch.
class ContactIsland {
  public:
    /// `members`, awake, index `robots`, the group's.
    ContactIsland(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
                  IslandScratch& scratch, StepReport& report);

    /// False: one robot that nothing touches and no row drives, or that cannot move.
    bool has_rows() const { return has_rows_; }
    void build_rows();
    /// Also finds which members take the kick-drift step, and stores the warm-start impulses.
    void solve_velocities();
    /// What the members move by, and what stops them before they hit something that they did not touch.
    void solve_displacements();
    void integrate();
    /// Moves apart what sank in by turning; puts bonds right; returns momentum and energy to what contacts
    /// and gravity give.
    void guard();
    void put_to_sleep();

  private:
    // soft_island.cpp
    bool take_soft();
    void solve_soft();
    bool find_soft_hits(std::size_t found, bool first);
    soft::Island soft_island() {
        return {model_, robots_, members_, s_.contacts, s_.surfaces, s_.rows.joints, s_.offsets_of_group};
    }
    bool gather_joints();
    void finish_joints();
    void profile_island(int largest_part);
    void close_bonds();

    const Model& model_;
    std::span<RobotWork> robots_;
    std::span<const std::uint32_t> members_;
    IslandScratch& s_;
    StepReport& report_;
    bool has_rows_ = true;
    bool is_soft_ = false;             // solved by soft substeps (soft/soft_solver.h)
    bool has_joints_ = false;          // and robots with joints are among its members
    bool needs_displacement_ = false;  // it is solved for by itself
    bool drifts_ = false;              // a member takes the kick-drift step
    bool is_tied_ = false;             // a bond joins it to scenery, or to what does not move freely
    bool bounces_ = false;             // throws_back
    bool guards_energy_ = false, guards_momentum_ = false;
    int iterations_before_ = 0, largest_part_ = 0;  // for profiles
};

}  // namespace roboss
