// See hessian.h.
#include "physics/hessian.h"

#include <algorithm>

#include "physics/tree_factor.h"

namespace roboss {

void Hessian::start(std::span<const RobotWork* const> robots, std::span<const int> offsets,
                    const IslandRows& rows, std::size_t n) {
    robots_ = robots;
    offsets_ = offsets;
    n_ = n;
    tree_ = robots.size() == 1 && !robots[0]->touches_robot && rows.couplings.empty();
    if (!tree_) start_fronts(rows);
}

void Hessian::start_fronts(const IslandRows& rows) {
    group_first_.assign(offsets_.begin(), offsets_.end());
    group_first_.push_back(static_cast<int>(n_));
    unknowns_.clear(), cliques_.clear();
    const auto add = [&](const auto& columns, std::size_t first, std::size_t last) {
        const std::size_t begin = unknowns_.size();
        for (std::size_t c = first; c < last; ++c) unknowns_.push_back(columns[c].dof);
        cliques_.push_back({begin, unknowns_.size()});
    };
    for (const ContactRow& row : rows.contacts) add(rows.columns, row.first, row.last);
    for (const AngularRow& row : rows.angulars) add(rows.columns, row.first, row.last);
    for (const CouplingRow& row : rows.couplings) add(rows.coupling_columns, row.first, row.last);
    fronts_.analyse(group_first_, unknowns_, cliques_);
}

void Hessian::assemble(const IslandRows& rows, bool coupled) {
    coupled_ = coupled;
    add_mass();
    if (tree_) {
        for (const JointRow& row : rows.joints) h_[static_cast<std::size_t>(row.dof) * (n_ + 1)] += row.d;
    } else {
        std::size_t robot = 0;  // joint rows come robot by robot
        for (const JointRow& row : rows.joints) {
            while (row.dof >= group_first_[robot + 1]) ++robot;
            fronts_.add(robot, row.dof, row.dof, row.d);
        }
    }
    std::size_t clique = 0;
    for (const ContactRow& row : rows.contacts)
        add_block(rows, row.first, row.last, clique++, row.normal, row.slip);
    for (const AngularRow& row : rows.angulars)
        add_block(rows, row.first, row.last, clique++, row.spin, row.roll);
    for (const CouplingRow& row : rows.couplings) add_coupling(rows, row, clique++);
}

void Hessian::add_mass() {
    if (tree_) {
        h_.assign(robots_[0]->mass_matrix.begin(), robots_[0]->mass_matrix.end());
        if (coupled_) upper_.assign(h_.begin(), h_.end());
        return;
    }
    fronts_.clear(!coupled_);
    for (std::size_t r = 0; r < robots_.size(); ++r) {
        const RobotWork& robot = *robots_[r];
        const std::vector<int>& parent = robot.type->dof_parent;
        const std::size_t nv = parent.size();
        for (std::size_t i = 0; i < nv; ++i)
            for (int j = static_cast<int>(i); j >= 0; j = parent[static_cast<std::size_t>(j)])
                fronts_.add(r, offsets_[r] + static_cast<int>(i), offsets_[r] + j,
                            robot.mass_matrix[i * nv + static_cast<std::size_t>(j)]);
    }
}

/// J^T D J of one contact, or of its angular row.
void Hessian::add_block(const IslandRows& rows, std::size_t first, std::size_t last, std::size_t clique,
                        const BoundedRow& normal, const FrictionDisc& disc) {
    if (first == last || (normal.d == 0 && disc.d_11 == 0 && disc.d_22 == 0)) return;
    const std::span columns(rows.columns.data() + first, last - first);
    if (tree_) {
        add_to_tree(columns, normal, disc);
    } else {
        add_to_front(columns, fronts_.place(clique), normal, disc);
    }
}

/// Columns of one path descend: the lower triangle is all that follows.
void Hessian::add_to_tree(std::span<const ContactColumn> columns, const BoundedRow& normal,
                          const FrictionDisc& disc) {
    for (std::size_t a = 0; a < columns.size(); ++a) {
        const ContactColumn& x = columns[a];
        const double n = normal.d * x.n, t1 = disc.d_11 * x.t1 + disc.d_12 * x.t2,
                     t2 = disc.d_12 * x.t1 + disc.d_22 * x.t2;
        double* h = h_.data() + static_cast<std::size_t>(x.dof) * n_;
        if (!coupled_) {
            for (std::size_t b = a; b < columns.size(); ++b) {
                const ContactColumn& y = columns[b];
                h[y.dof] += n * y.n + t1 * y.t1 + t2 * y.t2;
            }
            continue;
        }
        const double slide = disc.d_1n * x.t1 + disc.d_2n * x.t2;  // along x, by the normal velocity
        double* upper = upper_.data() + static_cast<std::size_t>(x.dof) * n_;
        for (std::size_t b = a; b < columns.size(); ++b) {
            const ContactColumn& y = columns[b];
            const double both = n * y.n + t1 * y.t1 + t2 * y.t2;
            h[y.dof] += both + slide * y.n;
            upper[y.dof] += both + (disc.d_1n * y.t1 + disc.d_2n * y.t2) * x.n;
        }
    }
}

void Hessian::add_to_front(std::span<const ContactColumn> columns, const FrontFactor::Place& place,
                           const BoundedRow& normal, const FrictionDisc& disc) {
    for (std::size_t a = 0; a < columns.size(); ++a) {
        const ContactColumn& x = columns[a];
        const double n = normal.d * x.n + disc.d_1n * x.t1 + disc.d_2n * x.t2,
                     t1 = disc.d_11 * x.t1 + disc.d_12 * x.t2, t2 = disc.d_12 * x.t1 + disc.d_22 * x.t2;
        const int i = place.local[a];
        double* row = place.matrix + static_cast<std::size_t>(i) * place.stride;
        for (std::size_t b = 0; b < columns.size(); ++b) {
            const int j = place.local[b];
            if (!coupled_ && j < i) continue;
            const ContactColumn& y = columns[b];
            row[j] += n * y.n + t1 * y.t1 + t2 * y.t2;
        }
    }
}

void Hessian::add_coupling(const IslandRows& rows, const CouplingRow& row, std::size_t clique) {
    if (row.first == row.last || row.d == 0) return;
    const FrontFactor::Place place = fronts_.place(clique);
    const CouplingColumn* columns = rows.coupling_columns.data() + row.first;
    const std::size_t count = row.last - row.first;
    for (std::size_t a = 0; a < count; ++a) {
        const int i = place.local[a];
        for (std::size_t b = 0; b < count; ++b) {
            const int j = place.local[b];
            if (!coupled_ && j < i) continue;
            place.matrix[static_cast<std::size_t>(i) * place.stride + static_cast<std::size_t>(j)] +=
                row.d * columns[a].j * columns[b].j;
        }
    }
}

bool Hessian::solve(std::span<double> x) {
    if (!tree_) {
        if (!fronts_.factor()) return false;
        fronts_.solve(x);
        return true;
    }
    const std::vector<int>& parent = robots_[0]->type->dof_parent;
    if (coupled_) {
        if (!tree_factor_general(parent, h_, upper_)) return false;
        tree_solve_general(parent, h_, upper_, x.data());
    } else {
        tree_factor(parent, h_);
        tree_solve(parent, h_, x.data());
    }
    return true;
}

}  // namespace roboss
