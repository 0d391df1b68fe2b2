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

#include "core/union_find.h"
#include "physics/bodies/body_solver.h"
#include "physics/solver/solver.h"
#include "physics/step_profile.h"

namespace roboss {

class IslandParts {
  public:
    using Problem = IslandSolver::Problem;

    /// As IslandSolver::solve, for the whole contact island. `impulse` of the normals of contacts: what they
    /// carried last.
    SolveReport solve(const Problem& problem, std::vector<double>& v);
    /// Robots of the largest part of the last call.
    int largest_part() const { return largest_part_; }
    /// What friction is off by in the parts of the last call, if that solved for velocities.
    void profile_friction(const Problem& p, SolverProfile& profile) const;

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

    void prepare(const Problem& p, std::size_t n);
    void join_by_pushing(const Problem& p, const std::vector<double>& v);
    bool join_violated(const Problem& p, const std::vector<double>& v);
    void join_all();
    void sort_by_parts(const Problem& p);
    SolveReport solve_part(const Problem& p, std::size_t part, std::vector<double>& v);
    static bool has_parts(const Problem& p);
    bool is_of_bodies(const Problem& p, std::size_t part) const;
    void take_part(const Problem& p, std::size_t part, const std::vector<double>& v);
    void take_columns(const Problem& p, std::size_t& first, std::size_t& last);
    void give_back(const Problem& p, std::size_t part, std::vector<double>& v) const;
    void finish_left_out(const Problem& p, const std::vector<double>& v) const;
    bool is_left_out(std::size_t contact) const {
        return part_of_[ends_[contact].a] != part_of_[ends_[contact].b];
    }

    IslandSolver solver_;
    BodySolver bodies_;
    UnionFind joined_;
    int largest_part_ = 0;
    std::vector<std::uint32_t> robot_of_;     // by degree of freedom
    std::vector<Ends> ends_;                  // by contact
    std::vector<std::uint32_t> part_of_;      // by robot
    std::vector<std::uint32_t> joint_first_;  // by robot, and the end: of its joint rows
    std::vector<char> changed_;               // by robot: a contact joined it since it was solved
    ByPart robots_, couplings_, contacts_, angulars_;
    std::vector<std::uint32_t> keys_, local_contact_;
    // The part that is solved
    std::vector<int> shift_;  // by robot: of its degrees of freedom
    std::vector<const Mechanics<double>*> part_robots_;
    std::vector<int> part_offsets_;
    IslandRows rows_;
    std::vector<double> v_;
};

}  // namespace roboss
