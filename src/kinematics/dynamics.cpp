// See dynamics.h.
#include "kinematics/dynamics.h"

#include <algorithm>
#include <array>

#include "kinematics/posed_robot.h"
#include "physics/dynamics/tree_factor.h"

namespace roboss {
namespace {

/// Row i of an array of rows of `columns`; nullptr of an empty array: zeros.
const double* row_of(std::span<const double> array, std::size_t i, std::size_t columns) {
    return array.empty() ? nullptr : &array[i * columns];
}

/// Rows of q, once all arrays are known to have as many.
std::size_t checked_rows(const RobotModel& robot, std::span<const double> q,
                         std::initializer_list<std::span<const double>> optional, std::size_t out,
                         std::size_t out_columns) {
    const std::size_t rows = RobotModel::rows(q.size(), robot.q_columns());
    for (const std::span<const double>& array : optional)
        ROBOSS_CHECK(array.empty() || array.size() == rows * robot.v_columns(), std::to_string(array.size()));
    ROBOSS_CHECK(out == rows * out_columns,
                 std::to_string(out) + " numbers of " + std::to_string(rows) + " rows");
    return rows;
}

/// A robot that moves, and what accelerates it.
class DynamicRobot : public PosedRobot {
  public:
    explicit DynamicRobot(const RobotModel& of)
        : PosedRobot(of), accelerations_(of.type().bodies.size()), a_(of.v_columns()) {}

    /// Newton and Euler: the forces of a moving robot (place(), move()) with accelerations `a`, nullptr:
    /// zeros.
    void add_up_forces(const double* a, const Vec3& gravity, double* out) {
        if (a != nullptr) accelerate(a);
        set_body_impulses<double>(gravity, 1.0, 0.0, work);  // weight minus inertial force, of each body
        sum_impulses<double>(0.0, 0.0, q, v, work);
        for (std::size_t c = 0; c < v.size(); ++c) out[c] = -work.impulse[robot.v_of(c)];
        const std::vector<Dof>& dofs = robot.type().dofs;
        for (std::size_t d = 0; a != nullptr && d < dofs.size(); ++d) {
            const std::size_t column = robot.column_of(d + robot.base_v());
            out[column] += dofs[d].armature * a[column];
        }
    }

    /// work.mass_matrix of a placed robot; the bodies' inertias become those of their subtrees.
    void set_mass_matrix() {
        const RobotType& type = robot.type();
        for (std::size_t b = 0; b < type.bodies.size(); ++b) set_inertia(type.bodies[b], work.bodies[b]);
        work.flows.clear();
        compute_mass_matrix(type, 0.0, work);
    }

    /// Calls put(column i, column j, value) for the entries of the mass matrix on and below its diagonal.
    template <class Put>
    void visit_mass_matrix(Put put) const {
        const DofPaths& paths = robot.type().paths;
        for (std::size_t i = 0; i < paths.size(); ++i)
            for (std::size_t k = 0; k < paths.length(i); ++k)
                put(robot.column_of(i), robot.column_of(static_cast<std::size_t>(paths.path(i)[k])),
                    work.mass_matrix[paths.row(i) + k]);
    }

  private:
    /// Adds what the accelerations of the joints make of those of the bodies.
    void accelerate(const double* a) {
        const RobotType& type = robot.type();
        for (std::size_t c = 0; c < a_.size(); ++c) a_[robot.v_of(c)] = a[c];
        for (std::size_t b = 0; b < type.bodies.size(); ++b) {
            const Body& body = type.bodies[b];
            Spatial& sum = accelerations_[b];
            sum = body.parent < 0 ? Spatial{} : accelerations_[static_cast<std::size_t>(body.parent)];
            for (int k = 0; k < body.nv; ++k) {
                const auto i = static_cast<std::size_t>(body.v_index + k);
                sum += work.axes[i] * a_[i];
            }
            work.bodies[b].bias += sum;
        }
    }

    std::vector<Spatial> accelerations_;
    std::vector<double> a_;
};

}  // namespace

void inverse_dynamics(const RobotModel& robot, std::span<const double> q, std::span<const double> v,
                      std::span<const double> a, const Vec3& gravity, std::span<double> out) {
    const std::size_t columns = robot.v_columns(), rows = checked_rows(robot, q, {v, a}, out.size(), columns);
    DynamicRobot moving(robot);
    for (std::size_t i = 0; i < rows; ++i) {
        moving.place(&q[i * robot.q_columns()]);
        moving.move(row_of(v, i, columns));
        moving.add_up_forces(row_of(a, i, columns), gravity, &out[i * columns]);
    }
}

void gravity_forces(const RobotModel& robot, std::span<const double> q, std::span<double> out) {
    inverse_dynamics(robot, q, {}, {}, robot.model().gravity, out);
}

void coriolis_forces(const RobotModel& robot, std::span<const double> q, std::span<const double> v,
                     std::span<double> out) {
    inverse_dynamics(robot, q, v, {}, Vec3{}, out);
}

void mass_matrices(const RobotModel& robot, std::span<const double> q, std::span<double> out) {
    const std::size_t n = robot.v_columns(), rows = checked_rows(robot, q, {}, out.size(), n * n);
    std::fill(out.begin(), out.end(), 0.0);
    DynamicRobot placed(robot);
    for (std::size_t r = 0; r < rows; ++r) {
        placed.place(&q[r * robot.q_columns()]);
        placed.set_mass_matrix();
        double* matrix = &out[r * n * n];
        placed.visit_mass_matrix([&](std::size_t i, std::size_t j, double value) {
            matrix[i * n + j] = matrix[j * n + i] = value;
        });
    }
}

void forward_dynamics(const RobotModel& robot, std::span<const double> q, std::span<const double> v,
                      std::span<const double> forces, const Vec3& gravity, std::span<double> out) {
    const std::size_t n = robot.v_columns(), rows = checked_rows(robot, q, {v, forces}, out.size(), n);
    const DofPaths& paths = robot.type().paths;
    DynamicRobot moving(robot);
    std::vector<double> x(n);
    for (std::size_t r = 0; r < rows; ++r) {
        moving.place(&q[r * robot.q_columns()]);
        moving.move(row_of(v, r, n));
        double* a = &out[r * n];
        moving.add_up_forces(nullptr, gravity, a);
        moving.set_mass_matrix();
        const double* given = row_of(forces, r, n);
        for (std::size_t c = 0; c < n; ++c) x[robot.v_of(c)] = (given != nullptr ? given[c] : 0.0) - a[c];
        tree_factor(paths, moving.work.mass_matrix.data());
        tree_solve(paths, moving.work.mass_matrix.data(), x.data());
        for (std::size_t c = 0; c < n; ++c) a[c] = x[robot.v_of(c)];
    }
}

void passive_forces(const RobotModel& robot, std::span<const double> q, std::span<const double> v,
                    std::span<double> out) {
    const std::size_t columns = robot.v_columns(), rows = checked_rows(robot, q, {v}, out.size(), columns);
    std::fill(out.begin(), out.end(), 0.0);
    for (std::size_t r = 0; r < rows; ++r) {
        const double* velocity = row_of(v, r, columns);
        for (std::size_t d = 0; d < robot.columns().size(); ++d) {
            const std::size_t entry = robot.v_of(robot.base_v() + d) - robot.base_v();
            const Dof& dof = robot.type().dofs[entry];
            double& force = out[r * columns + robot.base_v() + d];
            if (!robot.columns()[d].is_ball)
                force -= dof.spring_stiffness *
                         (q[r * robot.q_columns() + robot.base_q() + d] - dof.spring_reference);
            if (velocity != nullptr) force -= dof.damping * velocity[robot.base_v() + d];
        }
    }
}

}  // namespace roboss
