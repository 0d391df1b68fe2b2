// See hessian.h.
#include "physics/hessian.h"

#include <algorithm>

namespace roboss {

void Hessian::start(std::span<const Mechanics<double>* const> robots, std::span<const int> offsets,
                    IslandRows& rows, std::size_t n) {
    robots_ = robots;
    offsets_ = offsets;
    n_ = n;
    is_tree_ = robots.size() == 1 && !robots[0]->touches_robot && rows.couplings.empty();
    if (is_tree_) return tree_.start(*robots[0], rows);
    start_fronts(rows);
    add_mass();
    hold_nothing(rows);
}

void Hessian::start_fronts(IslandRows& rows) {
    group_first_.assign(offsets_.begin(), offsets_.end());
    group_first_.push_back(static_cast<int>(n_));
    unknowns_.clear(), cliques_.clear();
    const auto add = [&](const auto& dof_of, std::size_t first, std::size_t last) {
        const std::size_t begin = unknowns_.size();
        for (std::size_t c = first; c < last; ++c) unknowns_.push_back(dof_of(c));
        cliques_.push_back({begin, unknowns_.size()});
    };
    const auto contact_dof = [&](std::size_t c) { return rows.columns.dof[c]; };
    for (const ContactRow& row : rows.contacts) add(contact_dof, row.first, row.last);
    for (const AngularRow& row : rows.angulars) add(contact_dof, row.first, row.last);
    const auto coupling_dof = [&](std::size_t c) { return rows.coupling_columns[c].dof; };
    for (const CouplingRow& row : rows.couplings) add(coupling_dof, row.first, row.last);
    fronts_.analyse(group_first_, unknowns_, cliques_);
    sort_columns(rows);
}

/// The columns of the robot that is eliminated last come first, so that places in a front descend.
void Hessian::sort_columns(IslandRows& rows) {
    const auto sort = [&](std::size_t first, std::size_t last, std::size_t clique) {
        if (first == last) return;
        int* local = fronts_.place(clique).local;
        const std::size_t count = last - first;
        std::size_t turn = 1;
        while (turn < count && local[turn] < local[turn - 1]) ++turn;
        if (turn == count) return;
        const auto rotate = [&](auto* x) { std::rotate(x, x + turn, x + count); };
        rotate(rows.columns.dof.data() + first), rotate(rows.columns.n.data() + first);
        rotate(rows.columns.t1.data() + first), rotate(rows.columns.t2.data() + first);
        rotate(local);
    };
    std::size_t clique = 0;
    for (const ContactRow& row : rows.contacts) sort(row.first, row.last, clique++);
    for (const AngularRow& row : rows.angulars) sort(row.first, row.last, clique++);
}

void Hessian::assemble(IslandRows& rows, bool coupled) {
    if (is_tree_) return tree_.assemble(rows, coupled);
    add_changes(rows);
    fronts_.begin_factor(!coupled);
    if (coupled) add_slides(rows);
}

void Hessian::add_mass() {
    fronts_.clear();
    for (std::size_t r = 0; r < robots_.size(); ++r) {
        const Mechanics<double>& robot = *robots_[r];
        const DofPaths& paths = robot.type->paths;
        for (std::size_t i = 0; i < paths.size(); ++i)
            for (std::size_t k = 0; k < paths.length(i); ++k)
                fronts_.add(r, offsets_[r] + static_cast<int>(i), offsets_[r] + paths.path(i)[k],
                            robot.mass_matrix[paths.row(i) + k]);
    }
}

void Hessian::add_changes(IslandRows& rows) {
    std::size_t robot = 0;  // joint rows come robot by robot
    for (JointRow& row : rows.joints) {
        const double change = row.d - row.d_held;
        row.d_held = row.d;
        while (row.dof >= group_first_[robot + 1]) ++robot;
        fronts_.add(robot, row.dof, row.dof, change);
    }
    std::size_t clique = 0;
    for (ContactRow& row : rows.contacts)
        add_block(rows.columns, row.first, row.last, clique++, row.normal, row.slip);
    for (AngularRow& row : rows.angulars)
        add_block(rows.columns, row.first, row.last, clique++, row.spin, row.roll);
    for (CouplingRow& row : rows.couplings) add_coupling(rows, row, clique++);
}

/// J^T D J of one contact, or of its angular row.
void Hessian::add_block(const ContactColumns& columns, std::size_t first, std::size_t last,
                        std::size_t clique, BoundedRow& normal, FrictionDisc& disc) {
    const CurvatureChange<double> d = take_change(normal, disc);
    if (first == last || d.nothing()) return;
    const std::size_t count = last - first;
    const double *cn = columns.n.data() + first, *c1 = columns.t1.data() + first,
                 *c2 = columns.t2.data() + first;
    const FrontFactor::Place place = fronts_.place(clique);
    for (std::size_t a = 0; a < count; ++a) {
        const double n = d.n * cn[a], t1 = d.t11 * c1[a] + d.t12 * c2[a], t2 = d.t12 * c1[a] + d.t22 * c2[a];
        double* h = place.matrix + static_cast<std::size_t>(place.local[a]) * place.stride;
        for (std::size_t b = 0; b <= a; ++b) h[place.local[b]] += n * cn[b] + t1 * c1[b] + t2 * c2[b];
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
        const std::size_t count = row.last - row.first;
        const double *cn = rows.columns.n.data() + row.first, *c1 = rows.columns.t1.data() + row.first,
                     *c2 = rows.columns.t2.data() + row.first;
        const FrontFactor::Place place = fronts_.unsymmetric_place(c);
        for (std::size_t a = 0; a < count; ++a) {
            const double slide = disc.d_1n * c1[a] + disc.d_2n * c2[a];
            double* h = place.matrix + static_cast<std::size_t>(place.local[a]) * place.stride;
            for (std::size_t b = 0; b < count; ++b) h[place.local[b]] += slide * cn[b];
        }
    }
}

bool Hessian::solve(std::vector<double>& x) {
    if (is_tree_) return tree_.solve(x);
    if (!fronts_.factor()) return false;
    fronts_.solve(x);
    return true;
}

}  // namespace roboss
