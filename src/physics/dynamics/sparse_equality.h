// The loops of a robot with many of them, solved with every body for itself: the conditions of all joints
// are rows of one sparse matrix (model/joint_elimination.h), factored joint by joint. A net of n plates costs
// O(n^1.5), where the matrix of its loops alone costs O(n^3).
#pragma once

#include <span>
#include <vector>

#include "physics/dynamics/robot_work.h"

namespace roboss {

struct Equalities;

/// As EqualitySolver, for types with an elimination.
class SparseEqualitySolver {
  public:
    /// `work`: placed; its mass matrix is not needed. Locked degrees of freedom (none: empty) do not move.
    void prepare(const RobotWork& work, std::span<const char> locked, const Equalities& equalities);
    /// change: of the robot's v, by impulses of the loops alone, such that J change = wanted.
    void solve(std::span<const double> wanted, std::span<double> change);

  private:
    struct Row {
        Spatial wrench;      // on body B about O, per unit of impulse; the opposite on A; scaled
        Spatial by_a, by_b;  // how the bodies move for it
    };
    struct BodyMobility {
        double inverse_mass = 0;
        Mat3 inverse_inertia;  // about the centre of mass, world axes
        Vec3 centre;           // from O
    };
    /// Columns of `count` entries of a row that come to stand in another row.
    struct Run {
        std::size_t from = 0, to = 0, count = 0;
    };

    void prepare_bodies();
    void gather_rows(const Equalities& equalities);
    void add_tree_rows(std::size_t body);
    void add_tree_row(const Vec3& p, const Spatial& wrench);
    void scale_rows(std::size_t node);
    void lay_out();
    void assemble();
    void factor();
    void eliminate_own(std::size_t node);
    void update_later(std::size_t node);
    void subtract(std::span<const Run> runs, const double* pivots, std::size_t width,
                  std::span<const double> f, double* row) const;
    bool is_laid_out() const;
    void find_runs(std::size_t node, std::size_t edge);
    void substitute();
    void read_joints(std::span<double> change);

    Spatial moved(int body, const Spatial& wrench) const;
    std::size_t rows_of(std::size_t node) const { return first_row_[node + 1] - first_row_[node]; }
    bool is_locked(std::size_t dof) const { return !locked_.empty() && locked_[dof] != 0; }

    const RobotWork* work_ = nullptr;
    std::span<const char> locked_;
    std::vector<BodyMobility> mobilities_;
    std::vector<std::size_t> first_row_;      // by node
    std::vector<Row> rows_;                   // node by node
    std::vector<double> scale_;               // of each row
    std::vector<int> wanted_of_;              // of each row: index of its loop row; -1: of the tree
    std::vector<std::size_t> loop_rows_;      // by loop: its first row in the equalities; and the end
    std::vector<std::size_t> width_, start_;  // by node: entries of its rows in a_, and where they begin
    std::vector<std::size_t> column_;         // by edge: where its columns begin in the rows of its node
    std::vector<Run> runs_;                   // of all edges
    std::vector<std::size_t> first_run_;      // by edge, and the end
    /// What these five were made for: they are the same from stage to stage.
    struct Layout {
        std::vector<std::size_t> rows, last_edges;
        std::vector<int> ends;
    } laid_out_;
    std::vector<double> a_;  // rows of D L^T, reciprocals of D on the diagonal; 0 there: the row is implied
    std::vector<double> x_;  // impulses, by row
    std::vector<Spatial> change_;  // by body
};

}  // namespace roboss
