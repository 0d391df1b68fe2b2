// Newton's method (newton.h) for a part of a contact island in which all robots are single free bodies with
// plain contacts: boxes, balls, debris. The same steps on blocks of six by six (body_island.h), which a
// vector register takes row by row.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "physics/bodies/body_kernel.h"
#include "physics/dynamics/lone_body.h"
#include "physics/solver/rows.h"
#include "physics/solver/slip_disc.h"
#include "physics/solver/solver.h"

namespace roboss {

/// Some robots of a contact island, and the contacts among them and with scenery.
struct BodyPart {
    const IslandSolver::Problem& problem;     // of the whole contact island
    std::span<const std::uint32_t> members;   // robots, ascending
    std::span<const std::uint32_t> contacts;  // contact rows
    std::span<const std::uint32_t> robot_of;  // by degree of freedom
};

class BodySolver {
  public:
    /// True for a single free body.
    static bool can_solve(const Mechanics<double>& robot) { return is_free_body(*robot.type); }
    /// False for friction with a slip compliance.
    static bool can_solve(const ContactRow& row) {
        return row.first != row.last && !slip_disc::slips(row.slip);
    }

    /// Bodies of a part from which on a team is worth its pauses.
    static constexpr std::size_t kWorthATeam = 768;

    /// As IslandSolver::solve, for the part. False if it does not come to a balance: then velocities and rows
    /// are as before, and the report says how many iterations were tried. The team's threads share the work.
    bool solve(const BodyPart& part, std::vector<double>& v, SolveReport& report, const Team& team = {});

  private:
    void take(const BodyPart& part, const std::vector<double>& v);
    void prepare_factor();
    Fill find_fill();
    void take_body(const Mechanics<double>& robot, const double* v, FreeBody& body) const;
    void take_point(const BodyPart& part, const ContactRow& row, BodyPoint& point) const;
    bool iterate(const Accuracy& accuracy);
    bool displace();
    bool change_pushing();
    void start();
    bool take_first_step();
    SweepReport sweep(const SweepPlan& plan);
    void take_swept();
    bool settle_velocities(const Accuracy& accuracy);
    bool settle_displacement(const BodyPart& part);
    bool hardly_moves() const;
    bool keeps_apart() const;
    bool start_from_sweeps();
    void start_from_sticking();
    double balance_tied();
    bool solve_coupled(const Accuracy& accuracy);
    void take_step();
    double line_search(double at_start, double at_end);
    double update_bounds();
    double friction_error() const;
    void give(const BodyPart& part, std::vector<double>& v) const;
    void keep_start();
    void return_to_start();

    const BodyKernel& kernel_ = body_kernel();
    BodyIsland island_;
    bool position_ = false;
    bool swept_ = false;     // sweeps have found velocities; v_start_ holds those before
    bool analysed_ = false;  // the order of the factor is known
    Fill fill_ = Fill::kLittle;
    struct Joined {
        int a = 0, b = -1;  // bodies
    };
    std::size_t deep_bodies_ = 0;      // of the last pile with much fill
    std::vector<Joined> deep_joined_;  // by its points
    double residual_ = 0;
    int iterations_ = 0;
    std::vector<std::uint32_t> local_;  // by robot of the problem: its body
    std::vector<Six> v_start_;
    std::vector<double> start_bounds_;
};

}  // namespace roboss
