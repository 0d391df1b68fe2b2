// The loops of a robot with many of them, solved with every body for itself: the conditions of all joints
// are rows of one sparse matrix (model/joint_elimination.h), factored by fronts. A net of n plates costs
// O(n^1.5), where the matrix of its loops alone costs O(n^3).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/team.h"
#include "physics/dynamics/body_branches.h"
#include "physics/dynamics/robot_work.h"
#include "physics/sparse/block_ldlt.h"

namespace roboss {

struct Equalities;

/// As EqualitySolver, for types with an elimination.
class SparseEqualitySolver : BlockLdlt::Source {
  public:
    /// Whose threads may share the work.
    void share_with(const Team& team) { team_ = team; }
    /// `work`: placed; its mass matrix is not needed. Locked degrees of freedom (none: empty) do not move.
    void prepare(const RobotWork& work, std::span<const char> locked, const Equalities& equalities);
    /// change: of the robot's v, by impulses of the loops alone, such that J change = wanted.
    void solve(std::span<const double> wanted, std::span<double> change);
    /// The acceleration by forces along the degrees of freedom, with that of the loops J a = wanted: as the
    /// tree's acceleration and then solve(), without its mass matrix.
    void accelerate(std::span<const double> forces, std::span<const double> wanted,
                    std::span<double> acceleration);

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

    /// What the joint between a body and its parent bears: wrenches about O.
    struct TreeRows {
        std::array<Spatial, 6> wrench;
        std::size_t count = 0;
    };

    struct Axes {
        std::array<Spatial, 6> axis;
        std::array<std::size_t, 6> dof;
        std::size_t count = 0;
    };

    void prepare_bodies();
    Axes axes_of(std::size_t body, const Vec3& p) const;
    Spatial wrench_of(std::size_t body, std::span<const double> forces) const;
    void move_bodies(std::span<const double> forces);
    void set_lacking(std::span<const double> wanted);
    double asked(std::size_t row, std::span<const double> wanted) const;
    void push_bodies();
    void gather_rows(const Equalities& equalities);
    TreeRows tree_rows(std::size_t body) const;
    void put_rows(std::size_t node, const Equalities& equalities);
    void scale_rows(std::size_t node);
    void add_rows(std::size_t position, BlockLdlt& matrix) const override;
    void read_joint(std::size_t body, std::span<double> change) const;
    void read_joints(std::span<double> change) const;

    Spatial moved(int body, const Spatial& wrench) const;
    bool is_locked(std::size_t dof) const { return !locked_.empty() && locked_[dof] != 0; }

    const RobotWork* work_ = nullptr;
    std::span<const char> locked_;
    std::vector<BodyMobility> mobilities_;
    std::vector<std::size_t> first_row_;  // by node
    std::vector<Row> rows_;               // node by node
    std::vector<double> scale_;           // of each row
    std::vector<int> wanted_of_;          // of each row: index of its loop row; -1: of the tree
    std::vector<std::size_t> loop_rows_;  // by loop: its first row in the equalities; and the end
    std::vector<TreeRows> tree_rows_;     // by body
    std::vector<std::size_t> count_;      // of rows, by node
    BlockLdlt matrix_;
    Team team_;
    BodyBranches branches_;
    std::vector<double> x_;                         // impulses, by row
    std::vector<Spatial> change_, joint_wrenches_;  // by body
};

}  // namespace roboss
