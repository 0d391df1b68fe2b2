// See hessian.h.
#include "physics/solver/hessian.h"

#include <algorithm>
#include <cmath>

namespace roboss {
namespace {

/// Whether the matrix has the curvatures of a point, but for that share.
bool is_held(const BoundedRow& normal, const FrictionDisc& disc, double lack) {
    const double change = std::fabs(disc.d_11 - disc.held_11) + std::fabs(disc.d_12 - disc.held_12) +
                          std::fabs(disc.d_22 - disc.held_22);
    return normal.d == normal.d_held && change <= lack * std::max(disc.held_11, disc.held_22);
}

}  // namespace

void Hessian::start(std::span<const Mechanics<double>* const> robots, std::span<const int> offsets,
                    IslandRows& rows, std::size_t n) {
    robots_ = robots;
    offsets_ = offsets;
    n_ = n;
    if (robots.size() == 1 && rows.couplings.empty() &&
        std::ranges::none_of(rows.contacts, &ContactRow::joins)) {
        form_ = Form::kTree;
        return tree_.start(*robots[0], rows);
    }
    if (NetHessian::suits(robots, rows)) {
        form_ = Form::kNet;
        return net_.start(robots, offsets, rows);
    }
    form_ = Form::kFronts;
    start_fronts(rows);
    add_mass();
    hold_nothing(rows);
}

void Hessian::start_fronts(const IslandRows& rows) {
    group_first_.assign(offsets_.begin(), offsets_.end());
    group_first_.push_back(static_cast<int>(n_));
    heads_.clear();
    for (const Mechanics<double>* robot : robots_) heads_.push_back(robot->type->free_base ? 6 : 0);
    unknowns_.clear(), cliques_.clear(), clique_of_.clear();
    // Points of one pair of bodies follow each other and have the same unknowns.
    const auto add = [&](const auto& dof_of, std::size_t first, std::size_t last) {
        const std::size_t begin = unknowns_.size();
        for (std::size_t c = first; c < last; ++c) unknowns_.push_back(dof_of(c));
        if (!cliques_.empty() && is_last_clique(begin)) {
            unknowns_.resize(begin);
        } else {
            cliques_.push_back({begin, unknowns_.size()});
        }
        clique_of_.push_back(cliques_.size() - 1);
    };
    const auto contact_dof = [&](std::size_t c) { return rows.columns.dof[c]; };
    for (const ContactRow& row : rows.contacts) add(contact_dof, row.first, row.last);
    for (const AngularRow& row : rows.angulars) add(contact_dof, row.first, row.last);
    const auto coupling_dof = [&](std::size_t c) { return rows.coupling_columns[c].dof; };
    for (const CouplingRow& row : rows.couplings) add(coupling_dof, row.first, row.last);
    choose_fronts();
    fronts().analyse(group_first_, heads_, unknowns_, cliques_);
}

/// Those that know the answer, else those that were analysed longest ago.
void Hessian::choose_fronts() {
    kept_ = 0;
    if (n_ > kSmall) return;
    for (std::size_t k = 1; k < kKept; ++k) {
        if (!fronts_[k].knows(group_first_, heads_, unknowns_, cliques_)) continue;
        kept_ = k;
        return;
    }
    kept_ = oldest_;
    oldest_ = oldest_ + 1 == kKept ? 1 : oldest_ + 1;
}

/// Whether the unknowns from `begin` on are those of the last clique.
bool Hessian::is_last_clique(std::size_t begin) const {
    const FrontFactor::Clique& last = cliques_.back();
    return std::ranges::equal(std::span(unknowns_).subspan(begin),
                              std::span(unknowns_).subspan(last.first, last.last - last.first));
}

void Hessian::assemble(IslandRows& rows, bool coupled, double lack) {
    if (form_ == Form::kTree) return tree_.assemble(rows, coupled, lack);
    if (form_ == Form::kNet) return net_.assemble(rows, team_);
    add_changes(rows, lack);
    fronts().begin_factor(!coupled);
    if (coupled) add_slides(rows);
}

void Hessian::add_mass() {
    fronts().clear();
    for (std::size_t r = 0; r < robots_.size(); ++r)
        fronts().add(r, robots_[r]->type->paths, robots_[r]->mass_matrix);
}

void Hessian::add_changes(IslandRows& rows, double lack) {
    std::size_t robot = 0;  // joint rows come robot by robot
    for (JointRow& row : rows.joints) {
        const double change = row.d - row.d_held;
        row.d_held = row.d;
        while (row.dof >= group_first_[robot + 1]) ++robot;
        fronts().add(robot, row.dof, change);
    }
    const std::size_t* clique = clique_of_.data();
    const auto add = [&](std::size_t first, std::size_t last, BoundedRow& normal, FrictionDisc& disc) {
        if (first != last && !is_held(normal, disc, lack))
            add_block(rows.columns, first, *clique, take_change(normal, disc));
        ++clique;
    };
    for (ContactRow& row : rows.contacts) add(row.first, row.last, row.normal, row.slip);
    for (AngularRow& row : rows.angulars) add(row.first, row.last, row.spin, row.roll);
    for (CouplingRow& row : rows.couplings) add_coupling(rows, row, *clique++);
}

/// J^T D J of one contact, or of its angular row.
void Hessian::add_block(const ContactColumns& columns, std::size_t first, std::size_t clique,
                        const CurvatureChange<double>& d) {
    const double *cn = columns.n.data() + first, *c1 = columns.t1.data() + first,
                 *c2 = columns.t2.data() + first;
    const FrontFactor::Place place = fronts().place(clique);
    for (std::size_t r = 0; r < place.runs.size(); ++r) {
        for (std::size_t k = 0; k < place.runs[r].count; ++k) {
            const std::size_t a = place.runs[r].first + k;
            const jacobian::Along<double> share = d.times(cn[a], c1[a], c2[a]);
            double* h = place.matrix + (place.runs[r].place + k) * place.stride;
            for (const FrontFactor::Run& run : place.runs.subspan(r))
                jacobian::add_run(cn + run.first, c1 + run.first, c2 + run.first, share, run.count,
                                  h + run.place);
        }
    }
}

void Hessian::add_coupling(const IslandRows& rows, CouplingRow& row, std::size_t clique) {
    const double change = row.d - row.d_held;
    row.d_held = row.d;
    if (row.first == row.last || change == 0) return;
    const FrontFactor::Place place = fronts().place(clique);
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
        const double *cn = rows.columns.n.data() + row.first, *c1 = rows.columns.t1.data() + row.first,
                     *c2 = rows.columns.t2.data() + row.first;
        const FrontFactor::Place place = fronts().unsymmetric_place(clique_of_[c]);
        for (const FrontFactor::Run& along : place.runs) {
            for (std::size_t k = 0; k < along.count; ++k) {
                const std::size_t a = along.first + k;
                const double slide = disc.d_1n * c1[a] + disc.d_2n * c2[a];
                double* h = place.matrix + (along.place + k) * place.stride;
                for (const FrontFactor::Run& run : place.runs)
                    jacobian::add_run(cn + run.first, slide, run.count, h + run.place);
            }
        }
    }
}

bool Hessian::solve(std::vector<double>& x) {
    if (form_ == Form::kTree) return tree_.solve(x);
    if (form_ == Form::kNet) return net_.solve(x, team_), true;
    return fronts().solve(x);
}

}  // namespace roboss
