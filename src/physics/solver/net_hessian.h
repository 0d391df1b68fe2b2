// The matrix of Newton's method for islands with robots that have many loops (JointElimination): in the
// coordinates of their trees it is full. Here every body of such a robot is a part for itself, every other
// robot a part as a whole, with matrices P; joints and their damping, motors and limits, loops, and contacts
// between parts are rows on one part or two, with curvatures D. Then H x = F is solved by the impulses of the
// rows,
//     (J P^-1 J^T + D^-1) mu = J P^-1 F,   V = P^-1 (F - J^T mu),
// a sparse matrix with a block for all rows of a joint, or of the contacts of two parts (Baraff 1996,
// Linear-time dynamics using Lagrange multipliers). Rows on one part alone, as those of contacts with
// scenery, are in P.
#pragma once

#include <compare>
#include <span>
#include <utility>
#include <vector>

#include "core/block_pattern.h"
#include "core/team.h"
#include "physics/dynamics/robot_work.h"
#include "physics/solver/net_parts.h"
#include "physics/solver/rows.h"
#include "physics/sparse/block_ldlt.h"

namespace roboss {

class NetHessian : BlockLdlt::Source {
  public:
    /// Whether the island is one for it: not where a few bodies with loops are in a pile of many robots,
    /// whose contacts have more rows than they have degrees of freedom.
    static bool suits(std::span<const Mechanics<double>* const> robots, const IslandRows& rows);

    /// As Hessian::start.
    void start(std::span<const Mechanics<double>* const> robots, std::span<const int> offsets,
               const IslandRows& rows);
    /// Takes the rows' curvatures but those that make the matrix unsymmetric.
    void assemble(const IslandRows& rows, const Team& team);
    /// x := H^-1 x, once after assemble.
    void solve(std::span<double> x, const Team& team);

  private:
    enum class Kind : char { kHard, kDof, kCoupling, kNormal, kSlip, kSpin, kRoll };
    /// Of friction (kSlip, kRoll) two rows follow each other.
    struct Row {
        Kind kind = Kind::kHard;
        std::size_t source = 0;  // degree of freedom, coupling, contact or angular row of the island
        PartJacobian a, b;
        double d = 0, scale = 0;
    };
    /// A degree of freedom of a net: what reads it off the motions of two bodies, and acts along it.
    struct Reading {
        std::size_t dof = 0;  // in the island
        PartJacobian a, b;
    };
    /// A joint, or the contacts of two parts.
    struct Node {
        std::size_t first = 0, last = 0;  // in rows_
        int a = -1, b = -1;               // parts
    };
    /// A contact, or its angular row, between two parts.
    struct Meeting {
        int a = 0, b = 0;
        std::size_t row = 0;
        bool angular = false;
        auto operator<=>(const Meeting&) const = default;
    };

    /// A coupling row of a loop of a net.
    struct LoopRow {
        std::size_t robot = 0;
        int loop = 0;
        std::size_t coupling = 0;
        auto operator<=>(const LoopRow&) const = default;
    };

    void add_joints(const IslandRows& rows);
    void add_tree_joint(std::size_t robot, std::size_t body);
    void list_loop_rows(const IslandRows& rows);
    void add_loop(std::size_t robot, std::size_t loop, const IslandRows& rows, std::size_t& next);
    void add_meetings(const IslandRows& rows);
    void link_nodes();
    void number_nodes(std::span<const Mechanics<double>* const> robots);
    void add_row(Kind kind, std::size_t source, const PartJacobian& a, const PartJacobian& b);
    void set_curvatures(const IslandRows& rows);
    void set_disc(const FrictionDisc& disc, Row& first, Row& second);
    void scale(Row& row);
    void add_rows(std::size_t position, BlockLdlt& matrix) const override;
    double product(const Row& p, const Row& q, int part) const;
    double* over(const PartJacobian& j) { return over_.data() + j.at; }
    const double* over(const PartJacobian& j) const { return over_.data() + j.at; }
    void push(const PartJacobian& j, double force);
    double along(const PartJacobian& j) const;
    void spread_forces(std::span<const double> x);
    void read_motions(std::span<double> x) const;

    NetParts parts_;
    std::vector<Row> rows_;
    std::vector<Reading> readings_;
    std::vector<Node> nodes_;
    std::vector<double> damping_;  // by degree of freedom of the island: what stands beside the inertia
    std::vector<char> has_row_;    // likewise: a joint row acts on it
    std::vector<double> joint_d_;  // likewise: curvature of its joint rows
    std::vector<LoopRow> loop_rows_;
    std::vector<Meeting> meetings_;
    std::vector<std::size_t> node_first_, nodes_of_part_;  // by part: its nodes
    std::vector<std::pair<int, int>> links_, linked_;      // of nodes; what own_pattern_ was made for
    std::size_t linked_nodes_ = 0;
    BlockPattern own_pattern_;
    const BlockPattern* pattern_ = nullptr;
    std::vector<std::size_t> counts_;
    BlockLdlt matrix_;
    std::vector<double> over_;  // the rows' Jacobians over the factors of their parts
    std::vector<double> mu_, forces_;
};

}  // namespace roboss
