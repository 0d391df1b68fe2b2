// The stages of a contact island that soft substeps solve (soft/soft_solver.h).
#include "physics/contact/contact_island.h"

namespace roboss {
namespace {

/// True if what materials make of contact `c` is what they made of the one before it.
bool shares_surfaces(const Contact& before, const SurfacePair& surface, const Contact& c) {
    return soft::are_of_one_patch(before, c) && surface.torsional == 0 && !surface.moves();
}

}  // namespace

/// True where soft substeps solve the island; then it has no rows.
bool ContactIsland::take_soft() {
    if (!s_.bonds.empty() || !soft::can_solve(model_, robots_, members_)) return false;
    s_.surfaces.clear();
    for (const std::uint32_t m : members_)
        for (Contact& c : contacts_of(m, s_.group.contacts)) {
            const bool goes_on =
                !s_.contacts.empty() && shares_surfaces(*s_.contacts.back(), s_.surfaces.back(), c);
            const SurfacePair surface = goes_on ? s_.surfaces.back() : surface_of(model_, robots_, c);
            if (!soft::can_solve(model_, c, surface)) return s_.contacts.clear(), false;
            s_.contacts.push_back(&c), s_.surfaces.push_back(surface);
        }
    if (s_.contacts.empty()) return false;
    has_joints_ = gather_joints();
    if (!s_.soft.take(soft_island())) return s_.contacts.clear(), false;
    s_.soft.take_contacts(soft_island());
    return true;
}

/// Solves, looks for what the motion hits besides its contacts, and solves again with the hits.
void ContactIsland::solve_soft() {
    constexpr int kRounds = 3;
    const std::size_t found = s_.contacts.size();
    s_.look.clear();
    for (int round = 0;; ++round) {
        s_.soft.solve(soft_island(), s_.team);
        s_.soft.mark_pushed(soft_island());
        ++report_.iterations;
        if (round == kRounds || !find_soft_hits(found, round == 0)) break;
        s_.contacts.resize(found), s_.surfaces.resize(found);
        for (Contact& hit : s_.look.hits())
            s_.contacts.push_back(&hit), s_.surfaces.push_back(surface_of(model_, robots_, hit));
        s_.soft.take_contacts(soft_island());
    }
    s_.soft.give_impulses(soft_island());
    if (has_joints_) {
        s_.soft.give_motion(soft_island(), s_.offsets_of_group, s_.v, s_.displacement);
        finish_joints();
    }
    if (!s_.group.profiles_solver) return;
    profile_island(static_cast<int>(members_.size()));
    ++report_.profile.solver.velocities[static_cast<std::size_t>(SolveMethod::kSoft)];
}

/// Looks for shapes that the solved motion hits and that it did not touch; false if there are none.
bool ContactIsland::find_soft_hits(std::size_t found, bool first) {
    s_.soft.give_motion(soft_island(), s_.offsets_of_group, s_.v, s_.displacement);
    if (!is_plausible(s_.displacement)) return false;
    s_.drifts.assign(members_.size(), 0), s_.large_turns.assign(members_.size(), 0);
    SolvedIsland island = solved_island(model_, robots_, members_, s_, found);
    island.passing_only = true;
    return s_.look.find(island, first);
}

}  // namespace roboss
