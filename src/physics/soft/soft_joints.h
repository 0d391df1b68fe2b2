// Motors, limits and friction of joints in the soft solver: rows of one robot alone, solved after the
// contacts of each pass. Motors and friction are the exact solver's bounded rows (dynamics/axis_rows.h), with
// an impulse of a substep. Hard limits are pushed out softly as contacts are.
#pragma once

#include <span>
#include <vector>

#include "physics/soft/soft_tree.h"
#include "physics/solver/rows.h"

namespace roboss::soft {

/// True for limits and joint friction, which an axis without a hard motor remembers in place of its motor.
bool is_remembered(const JointRow& row);

/// A row on one degree of freedom.
struct AxisRow {
    std::size_t first = 0;      // of its whitened columns
    const int* path = nullptr;  // their degrees of freedom
    std::size_t count = 0;
    double mobility = 0;        // along it
    bool is_limit = false;      // hard
    double side = 1, room = 0;  // of a limit: pushes to larger or smaller values; left, or passed by
    double target = 0, compliance = 0, low = 0, high = 0;  // of others, in a substep
    double impulse = 0, total = 0;                         // of the substep, of the tick
};

class Joints {
  public:
    void clear() { rows_.clear(), columns_.clear(), first_.assign(1, 0); }
    /// Adds those of the robot; `joints` are the exact solver's rows of it, whose degrees of freedom begin at
    /// `offset`.
    void add(const Model& model, const Tree& tree, std::span<const JointRow> joints, int offset);
    bool has_rows(std::size_t tree) const { return first_[tree + 1] > first_[tree]; }
    /// Warm start of the robot that was added as the `tree`-th, on its coordinates.
    void warm(std::size_t tree, double* velocity) const;
    void solve(std::size_t tree, const Substep& substep, bool recovers, const double* displacement,
               double* velocity);
    /// Takes motion along the rows that gave something out of it, by impulses along them.
    void take_out(std::size_t tree, double* motion) const;
    /// Impulses of the tick, in the order in which rows were added.
    void give(std::span<JointRow> joints) const;

  private:
    void add_columns(const Tree& tree, std::size_t dof, AxisRow& row);
    std::span<AxisRow> rows_of(std::size_t tree) {
        return std::span(rows_).subspan(first_[tree], first_[tree + 1] - first_[tree]);
    }
    double impulse_of(const AxisRow& row, const Substep& substep, bool recovers, double speed,
                      double moved) const;

    std::vector<AxisRow> rows_;
    std::vector<double> columns_;
    std::vector<std::size_t> first_;  // by tree, and the end
};

}  // namespace roboss::soft
