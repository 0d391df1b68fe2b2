// Solves a contact island in parts. Contacts that would not push keep robots in one contact island (they may
// push in the next tick), but they carry no impulse, so what they join can be solved apart: of a falling heap
// of a hundred bodies mostly a few push each other. Contacts between parts are left out at first where they
// would not push at the velocities before the tick and carried nothing in the last one. After the solve they
// are checked at the velocities found; parts that one of them would push are joined and solved again. The
// result is the solution of the whole island: a row that does not push has no impulse there either.
//
// The parts depend on the island alone, in the order of its robots and contacts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/team.h"
#include "core/union_find.h"
#include "physics/bodies/body_solver.h"
#include "physics/solver/solver.h"
#include "physics/step_profile.h"

namespace roboss {

class IslandParts {
  public:
    using Problem = IslandSolver::Problem;

    /// As IslandSolver::solve, for the whole contact island. `impulse` of the normals of contacts: what they
    /// carried last. Parts are shared by the threads of the team.
    ///
    /// `solved`: v already solves all rows for the velocity but for the contacts from this one on (0: none).
    /// Then parts stay as they are where the displacement asks for nothing else.
    SolveReport solve(Problem problem, std::vector<double>& v, const Team& team = {}, std::size_t solved = 0);
    /// Robots of the largest part of the last call.
    int largest_part() const { return largest_part_; }
    /// What friction is off by in the parts of the last call, if that solved for velocities.
    void profile_friction(const Problem& p, SolverProfile& profile) const;
    /// The parts that the last call solved, by method.
    const SolveCounts& solves() const { return solves_; }

  private:
    /// The two robots of a contact (numbers in the problem); a == b if it joins none.
    struct Ends {
        std::uint32_t a = 0, b = 0;
    };
    /// Items (contacts ...) in the order of their parts.
    struct ByPart {
        std::vector<std::uint32_t> items, first;  // `first`: of each part, and the end
        void sort(std::size_t parts, std::span<const std::uint32_t> part_of_item);
        std::span<const std::uint32_t> of(std::size_t part) const {
            return std::span(items).subspan(first[part], first[part + 1] - first[part]);
        }
    };

    /// Solves parts, one at a time; each thread has one.
    struct PartSolver {
        IslandSolver islands;
        BodySolver bodies;
        // The part as a problem of its own
        std::vector<int> shift;  // by robot: of its degrees of freedom
        std::vector<const Mechanics<double>*> robots;
        std::vector<int> offsets;
        std::vector<std::uint32_t> local_contact;
        IslandRows rows;
        std::vector<double> v;
    };

    void prepare(const Problem& p, std::size_t n);
    void join_by_pushing(const Problem& p, const std::vector<double>& v);
    bool join_violated(const Problem& p, const std::vector<double>& v);
    void join_all();
    void mark_open(const Problem& p, std::size_t solved);
    void sort_by_parts(const Problem& p);
    static bool has_parts(const Problem& p);
    static bool is_plain_body(const Problem& p);
    void list_changed(const Problem& p, const Team& team);
    void solve_changed(const Problem& p, const Team& team, std::vector<double>& v, SolveReport& report);
    SolveReport solve_part(const Problem& p, std::size_t part, PartSolver& s, std::vector<double>& v,
                           const Team& team) const;
    bool is_of_bodies(const Problem& p, std::size_t part) const;
    void take_part(const Problem& p, std::size_t part, const std::vector<double>& v, PartSolver& s) const;
    void take_columns(const Problem& p, PartSolver& s, std::size_t& first, std::size_t& last) const;
    void give_back(const Problem& p, std::size_t part, const PartSolver& s, std::vector<double>& v) const;
    void finish_left_out(const Problem& p, const std::vector<double>& v) const;
    bool is_left_out(std::size_t contact) const {
        return part_of_[ends_[contact].a] != part_of_[ends_[contact].b];
    }

    UnionFind joined_;
    bool in_parts_ = false;  // the last call solved them
    int largest_part_ = 0;
    SolveCounts solves_{};
    std::vector<std::uint32_t> robot_of_;     // by degree of freedom
    std::vector<Ends> ends_;                  // by contact
    std::vector<std::uint32_t> part_of_;      // by robot
    std::vector<std::uint32_t> joint_first_;  // by robot, and the end: of its joint rows
    std::vector<char> changed_;  // by robot: its rows are not solved, or a contact joined it since
    ByPart robots_, couplings_, contacts_, angulars_;
    std::vector<std::uint32_t> keys_;
    std::vector<std::uint32_t> to_solve_;  // parts
    std::size_t together_ = 0;             // of these, the first: a team solves one after the other
    std::vector<SolveReport> reports_;     // of these
    std::vector<PartSolver> solvers_ = std::vector<PartSolver>(1);
};

}  // namespace roboss
