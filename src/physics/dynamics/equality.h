// Equalities: what loops, gearboxes and mimic joints ask of one robot's velocities, always and in both
// directions. They become rows of the contact island's solver where something else pushes too; where nothing
// does, they are solved exactly here, and here the coordinates are put back onto them after each tick.
#pragma once

#include <span>
#include <vector>

#include "physics/dynamics/body_walk.h"
#include "physics/dynamics/robot_work.h"
#include "physics/dynamics/sparse_equality.h"

namespace roboss {

/// One column of a row's Jacobian.
struct EqualityColumn {
    int dof = 0;  // in the robot's v
    double j = 0;
};

struct EqualityRow {
    std::size_t first = 0, last = 0;  // columns
    double error = 0;                 // m or rad
    double curvature = 0;             // second derivative of the error with all joint accelerations zero
    double mobility = 0;              // scale of J M^-1 J^T
    int loop = -1;                    // in RobotType::loops, if it is of one
    Spatial wrench;                   // of a loop: on its body B about O, per unit of impulse
};

struct Equalities {
    std::vector<EqualityColumn> columns;
    std::vector<EqualityRow> rows;
    bool has_columns = true;
    std::vector<Spatial> motions;  // of the bodies; a buffer
    // without columns: the first row of each loop, and the end; and of which elimination they are
    std::vector<std::size_t> first_row;
    std::uint64_t stamp = 0;
};

/// All equalities of a placed robot (moved, too, if the curvatures are wanted) at coordinates q.
void gather_equalities(const RobotWork& work, std::span<const double> q, Equalities& equalities);
/// The same without columns if EqualitySolver needs none; then by the threads of a team.
void gather_for_solver(const RobotWork& work, std::span<const double> q, Equalities& equalities,
                       const Team& team = {});

/// Takes locked degrees of freedom (none: empty) out of the rows.
void leave_out_locked(std::span<const char> locked, Equalities& equalities);

/// J x of one row that has columns.
double times_row(const Equalities& equalities, const EqualityRow& row, std::span<const double> x);

/// J x of all rows, with locked degrees of freedom at rest.
void times_rows(const RobotWork& work, std::span<const double> x, std::span<const char> locked,
                Equalities& equalities, std::vector<double>& result);

/// Solves J M^-1 J^T impulses = wanted by Cholesky's method with diagonal pivoting, or joint by joint where a
/// robot has many loops (sparse_equality.h). Rows that others imply (a planar linkage in space has three of
/// them) are met with those, and get no impulse.
class EqualitySolver {
  public:
    /// Whose threads may share the work.
    void share_with(const Team& team) { by_joints_.share_with(team); }
    /// Whether prepare() needs the mass matrix.
    static bool needs_mass_matrix(const RobotType& type) { return type.elimination.empty(); }
    /// `work`: placed, its mass matrix factored by tree_factor, if it is needed, with what is locked;
    /// `locked` and `equalities` as leave_out_locked takes them.
    void prepare(const RobotWork& work, std::span<const char> locked, const Equalities& equalities);
    /// change = M^-1 J^T impulses, such that J change = wanted.
    void solve(std::span<const double> wanted, std::span<double> change);
    /// SparseEqualitySolver::accelerate, for types that need no mass matrix.
    void accelerate(std::span<const double> forces, std::span<const double> wanted,
                    std::span<double> acceleration) {
        by_joints_.accelerate(forces, wanted, acceleration);
    }

  private:
    void factor();
    void solve_dense(std::span<const double> wanted, std::span<double> change);

    bool sparse_ = false;
    SparseEqualitySolver by_joints_;

    std::size_t n_ = 0, m_ = 0, rank_ = 0;
    std::vector<double> y_;      // m x n: M^-1 J^T, a row each
    std::vector<double> a_;      // m x m, scaled to mobility 1
    std::vector<double> scale_;  // of each row
    std::vector<std::size_t> order_;
    std::vector<double> x_;
};

/// Puts a robot's coordinates and velocities back onto its equalities, with the least change in the metric
/// of its mass: momentum stays. Degrees of freedom that are `locked` do not move.
class EqualityProjection {
  public:
    void share_with(const Team& team) { solver_.share_with(team), walk_.share_with(team); }
    void close_coordinates(const RobotWork& robot, std::span<double> q, std::span<const char> locked = {});
    void close_velocities(const RobotWork& robot, std::span<const double> q, std::span<double> v,
                          std::span<const char> locked = {});

  private:
    void prepare(const RobotType& type, std::span<const char> locked);
    void place(const RobotWork& robot, std::span<const double> q);
    double largest_error() const;

    RobotWork work_;
    Equalities equalities_;
    EqualitySolver solver_;
    BodyWalk walk_;
    std::vector<double> wanted_, change_, q_before_;
};

}  // namespace roboss
