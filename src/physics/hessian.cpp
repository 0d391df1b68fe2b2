// See hessian.h.
#include "physics/hessian.h"

#include <algorithm>

#include "physics/row_math.h"
#include "physics/tree_factor.h"

namespace roboss {

namespace {

std::span<const ContactColumn> columns_of(const IslandRows& rows, std::size_t first, std::size_t last) {
    return {rows.columns.data() + first, last - first};
}

/// Curvatures that the matrix lacks.
struct Change {
    double n = 0, t11 = 0, t12 = 0, t22 = 0;
    bool nothing() const { return n == 0 && t11 == 0 && t12 == 0 && t22 == 0; }
};

Change take_change(BoundedRow& normal, FrictionDisc& disc) {
    const Change change{normal.d - normal.d_held, disc.d_11 - disc.held_11, disc.d_12 - disc.held_12,
                        disc.d_22 - disc.held_22};
    normal.d_held = normal.d;
    disc.held_11 = disc.d_11, disc.held_12 = disc.d_12, disc.held_22 = disc.d_22;
    return change;
}

}  // namespace

void Hessian::start(std::span<const RobotWork* const> robots, std::span<const int> offsets, IslandRows& rows,
                    std::size_t n) {
    robots_ = robots;
    offsets_ = offsets;
    n_ = n;
    tree_ = robots.size() == 1 && !robots[0]->touches_robot && rows.couplings.empty();
    if (!tree_) start_fronts(rows);
    add_mass();
    for_each_bounded(rows, [](BoundedRow& row) { row.d_held = 0; });
    for_each_disc(rows, [](FrictionDisc& disc) { disc.held_11 = disc.held_12 = disc.held_22 = 0; });
}

void Hessian::start_fronts(IslandRows& rows) {
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
    sort_columns(rows);
}

/// The columns of the robot that is eliminated first come first, so that places in a front ascend.
void Hessian::sort_columns(IslandRows& rows) {
    const auto sort = [&](std::size_t first, std::size_t last, std::size_t clique) {
        if (first == last) return;
        int* local = fronts_.place(clique).local;
        const std::size_t count = last - first;
        std::size_t turn = 1;
        while (turn < count && local[turn] > local[turn - 1]) ++turn;
        if (turn == count) return;
        const auto columns = rows.columns.begin() + static_cast<std::ptrdiff_t>(first);
        std::rotate(columns, columns + static_cast<std::ptrdiff_t>(turn),
                    columns + static_cast<std::ptrdiff_t>(count));
        std::rotate(local, local + turn, local + count);
    };
    std::size_t clique = 0;
    for (const ContactRow& row : rows.contacts) sort(row.first, row.last, clique++);
    for (const AngularRow& row : rows.angulars) sort(row.first, row.last, clique++);
}

void Hessian::assemble(IslandRows& rows, bool coupled) {
    coupled_ = coupled;
    add_changes(rows);
    if (tree_) {
        h_.assign(kept_.begin(), kept_.end());
        if (coupled) upper_.assign(kept_.begin(), kept_.end());
    } else {
        fronts_.begin_factor(!coupled);
    }
    if (coupled) add_slides(rows);
}

void Hessian::add_mass() {
    if (tree_) {
        kept_.assign(robots_[0]->mass_matrix.begin(), robots_[0]->mass_matrix.end());
        return;
    }
    fronts_.clear();
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

void Hessian::add_changes(IslandRows& rows) {
    std::size_t robot = 0;  // joint rows come robot by robot
    for (JointRow& row : rows.joints) {
        const double change = row.d - row.d_held;
        row.d_held = row.d;
        if (tree_) {
            kept_[static_cast<std::size_t>(row.dof) * (n_ + 1)] += change;
        } else {
            while (row.dof >= group_first_[robot + 1]) ++robot;
            fronts_.add(robot, row.dof, row.dof, change);
        }
    }
    std::size_t clique = 0;
    for (ContactRow& row : rows.contacts)
        add_block(columns_of(rows, row.first, row.last), clique++, row.normal, row.slip);
    for (AngularRow& row : rows.angulars)
        add_block(columns_of(rows, row.first, row.last), clique++, row.spin, row.roll);
    for (CouplingRow& row : rows.couplings) add_coupling(rows, row, clique++);
}

/// J^T D J of one contact, or of its angular row.
void Hessian::add_block(std::span<const ContactColumn> columns, std::size_t clique, BoundedRow& normal,
                        FrictionDisc& disc) {
    const Change d = take_change(normal, disc);
    if (columns.empty() || d.nothing()) return;
    const FrontFactor::Place place = tree_ ? FrontFactor::Place{} : fronts_.place(clique);
    for (std::size_t a = 0; a < columns.size(); ++a) {
        const ContactColumn& x = columns[a];
        const double n = d.n * x.n, t1 = d.t11 * x.t1 + d.t12 * x.t2, t2 = d.t12 * x.t1 + d.t22 * x.t2;
        if (tree_) {  // columns of one path descend: the lower triangle is all that follows
            double* h = kept_.data() + static_cast<std::size_t>(x.dof) * n_;
            for (std::size_t b = a; b < columns.size(); ++b)
                h[columns[b].dof] += n * columns[b].n + t1 * columns[b].t1 + t2 * columns[b].t2;
            continue;
        }
        double* h = place.matrix + static_cast<std::size_t>(place.local[a]) * place.stride;
        for (std::size_t b = a; b < columns.size(); ++b)
            h[place.local[b]] += n * columns[b].n + t1 * columns[b].t1 + t2 * columns[b].t2;
    }
}

void Hessian::add_coupling(const IslandRows& rows, CouplingRow& row, std::size_t clique) {
    const double change = row.d - row.d_held;
    row.d_held = row.d;
    if (row.first == row.last || change == 0) return;
    const FrontFactor::Place place = fronts_.place(clique);
    const CouplingColumn* columns = rows.coupling_columns.data() + row.first;
    const std::size_t count = row.last - row.first;
    for (std::size_t a = 0; a < count; ++a) {
        const int i = place.local[a];
        for (std::size_t b = 0; b < count; ++b) {
            const int j = place.local[b];
            if (j < i) continue;
            place.matrix[static_cast<std::size_t>(i) * place.stride + static_cast<std::size_t>(j)] +=
                change * columns[a].j * columns[b].j;
        }
    }
}

/// Sliding friction by the normal velocity: the part that is not symmetric.
void Hessian::add_slides(const IslandRows& rows) {
    for (std::size_t c = 0; c < rows.contacts.size(); ++c) {
        const ContactRow& row = rows.contacts[c];
        const FrictionDisc& disc = row.slip;
        if (row.first == row.last || (disc.d_1n == 0 && disc.d_2n == 0)) continue;
        const std::span<const ContactColumn> columns = columns_of(rows, row.first, row.last);
        const FrontFactor::Place place = tree_ ? FrontFactor::Place{} : fronts_.unsymmetric_place(c);
        for (std::size_t a = 0; a < columns.size(); ++a) {
            const double slide = disc.d_1n * columns[a].t1 + disc.d_2n * columns[a].t2;
            for (std::size_t b = 0; b < columns.size(); ++b) {
                const double value = slide * columns[b].n;
                if (!tree_) {
                    place.matrix[static_cast<std::size_t>(place.local[a]) * place.stride +
                                 static_cast<std::size_t>(place.local[b])] += value;
                } else if (b >= a) {  // row a, column b, which is not above a
                    h_[static_cast<std::size_t>(columns[a].dof) * n_ +
                       static_cast<std::size_t>(columns[b].dof)] += value;
                } else {
                    upper_[static_cast<std::size_t>(columns[b].dof) * n_ +
                           static_cast<std::size_t>(columns[a].dof)] += value;
                }
            }
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
