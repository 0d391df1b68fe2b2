// Puts the robots of a contact island back onto their bonds after the tick, with the least change in the
// metric of their masses: so bonds do not drift, and what is done is done by impulses that balance each
// other. Loops, gearboxes and mimic joints of the robots are kept. Cf. EqualityProjection for one robot.
//
// J M^-1 J^T is factored within its envelope (Jennings 1966), rows in the order of BondOrder: a train of n
// robots costs O(n), robots that all hold one body O(n^3).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "physics/bonds/bond_order.h"
#include "physics/bonds/bond_rows.h"
#include "physics/dynamics/equality.h"

namespace roboss {

class BondProjection {
  public:
    /// Moves the robots of the bonds, whose states have been advanced by a tick; the work of `robots` is left
    /// alone. What the change of the velocities takes is added to the bonds' impulses.
    void close(std::span<const RobotWork> robots, std::span<const HeldBond> bonds);

  private:
    struct Column {
        std::size_t dof = 0;  // among those of all robots here
        double j = 0;
    };
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    struct Row {
        std::size_t first = 0, last = 0;                 // columns
        std::array<std::size_t, 2> slots{kNone, kNone};  // robots that it moves
        std::array<std::size_t, 2> y{};                  // where their parts of M^-1 J^T begin in y_
        double error = 0, scale = 0;
        int bond = -1;  // index; -1: a robot's own equality
        Spatial axis;   // of a bond
    };

    void gather_robots(std::span<const RobotWork> robots, std::span<const HeldBond> bonds);
    std::size_t slot_of(std::uint32_t robot) const;
    void place();
    double gather_rows();
    void add_bond_rows(std::size_t number);
    void add_own_rows(std::size_t slot);
    void sort_rows();
    void prepare();
    void prepare_row(Row& row);
    void factor();
    void solve(std::span<const double> wanted);
    double times(const Row& row, std::span<const double> x) const;
    double coupling(const Row& row, const Row& other) const;
    /// Entry of row i in the order and column j, which is in its envelope.
    double& at(std::size_t i, std::size_t j) { return a_[start_[i] + (j - begin_[i])]; }

    std::vector<std::uint32_t> members_;  // robots of bonds, ascending
    std::vector<RobotWork> works_;        // of these; the first are in use
    std::vector<std::size_t> offsets_;    // of these; the last entry: all degrees of freedom
    std::vector<HeldBond> bonds_;         // with indices into works_
    std::vector<Column> columns_;
    std::vector<Row> rows_;
    Equalities own_;
    std::vector<double> y_, a_, x_, wanted_, change_, impulses_;
    BondOrder places_;                // of the robots
    std::vector<std::size_t> order_;  // rows as they are factored
    std::vector<std::size_t> begin_,  // first column of each row's envelope
        start_,                       // where it is in a_
        earliest_;                    // by robot: the first row that moves it
    double slack_ = 0;                // m or rad: an error that counts as none
};

}  // namespace roboss
