// The parts of NetHessian: each body of a robot with many loops, moving about its centre of mass, and every
// other robot with its degrees of freedom; their matrices P, with the rows that act on one part alone.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "physics/dynamics/robot_work.h"
#include "physics/solver/rows.h"

namespace roboss {

/// The Jacobian of a row on one part; part -1: none.
struct PartJacobian {
    int part = -1;
    std::size_t at = 0;  // in NetParts::jacobians()
};

class NetParts {
  public:
    void start(std::span<const Mechanics<double>* const> robots, std::span<const int> offsets,
               const IslandRows& rows);

    std::size_t count() const { return parts_.size(); }
    std::size_t robots() const { return robots_.size(); }
    const Mechanics<double>& robot(std::size_t r) const { return *robots_[r]; }
    /// Of the robot's degree of freedom in the island.
    std::size_t dof(std::size_t robot, std::size_t own) const {
        return static_cast<std::size_t>(offsets_[robot]) + own;
    }
    bool is_net(std::size_t robot) const { return !robots_[robot]->type->elimination.empty(); }
    /// -1: the fixed base.
    int part_of(std::size_t robot, int body) const;
    std::size_t robot_of(int dof) const;
    /// The parts at both sides of a contact, by its place and columns.
    std::pair<int, int> parts_of(const IslandRows& rows, std::size_t contact) const;

    /// A wrench about the origin of the body's robot, on the body; `sign` times it.
    PartJacobian add_wrench(int part, const Spatial& wrench, double sign);
    /// The three of a contact, or of its angular row, at the side of part `part`.
    std::array<PartJacobian, 3> add_contact(const IslandRows& rows, std::size_t contact, bool is_a, int part);
    std::array<PartJacobian, 3> add_angular(const IslandRows& rows, std::size_t angular, bool is_a, int part);
    const std::vector<double>& jacobians() const { return jacobians_; }
    std::size_t size_of(int part) const { return parts_[static_cast<std::size_t>(part)].size; }

    /// P with the present curvatures of rows on one part, factored: P = L L^T.
    void factor(const IslandRows& rows);
    /// x := L^-1 x, L^-T x, of one part.
    void over_factor(int part, double* x) const;
    void over_transpose(int part, double* x) const;

    /// Vectors over all parts: where a part's begins, and their size. A robot that is a part has its degrees
    /// of freedom there.
    std::size_t first_of(int part) const { return parts_[static_cast<std::size_t>(part)].first; }
    std::size_t size() const { return size_; }
    int robot_part(std::size_t robot) const { return part_of_robot_[robot]; }

  private:
    struct Part {
        std::size_t robot = 0;
        int body = -1;  // -1: the whole robot
        std::size_t size = 0, first = 0, matrix_at = 0;
    };
    void add_part(std::size_t robot, int body, std::size_t size);
    void set_body(const Part& part);
    void set_robot(const Part& part);
    void fold_joints(const IslandRows& rows);
    void fold_couplings(const IslandRows& rows);
    void fold_contacts(const IslandRows& rows);
    void fold(const Part& part, const double* x, const double* y, double d);
    void fold_point(const std::array<PartJacobian, 3>& j, double normal, const FrictionDisc& disc);
    double* matrix_of(const Part& part) { return matrices_.data() + part.matrix_at; }
    std::size_t room(int part);
    std::array<PartJacobian, 3> add_columns(const IslandRows& rows, std::size_t first, std::size_t last,
                                            int part);

    std::span<const Mechanics<double>* const> robots_;
    std::span<const int> offsets_;
    std::vector<Part> parts_;
    std::vector<int> part_of_robot_;  // of a net: of its first body
    std::size_t size_ = 0;
    std::vector<double> masses_, matrices_;  // P without rows, P
    std::vector<double> jacobians_;
    struct OnePart {
        std::size_t row = 0;
        bool angular = false;
        std::array<PartJacobian, 3> j;
    };
    std::vector<OnePart> folded_;  // contacts and angular rows on one part
    std::vector<double> column_;
};

}  // namespace roboss
