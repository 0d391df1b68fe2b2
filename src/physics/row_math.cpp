// Products with the rows' Jacobian.
#include "physics/row_math.h"

namespace roboss {
namespace {

struct Along {
    double n = 0, t1 = 0, t2 = 0;
};

Along along(const ContactColumns& columns, std::size_t first, std::size_t last, std::span<const double> x) {
    Along sum;
    for (std::size_t c = first; c < last; ++c) {
        const double xi = x[static_cast<std::size_t>(columns.dof[c])];
        sum.n += columns.n[c] * xi, sum.t1 += columns.t1[c] * xi, sum.t2 += columns.t2[c] * xi;
    }
    return sum;
}

template <class Row>
void add_columns(const ContactColumns& columns, const Row& row, const Along& impulse, std::span<double> y) {
    for (std::size_t c = row.first; c < row.last; ++c)
        y[static_cast<std::size_t>(columns.dof[c])] +=
            columns.n[c] * impulse.n + columns.t1[c] * impulse.t1 + columns.t2[c] * impulse.t2;
}

}  // namespace

void add_impulses(const IslandRows& rows, std::span<double> y) {
    for (const JointRow& row : rows.joints) y[static_cast<std::size_t>(row.dof)] += row.impulse;
    for (const CouplingRow& row : rows.couplings) {
        for (std::size_t c = row.first; c < row.last; ++c)
            y[static_cast<std::size_t>(rows.coupling_columns[c].dof)] +=
                rows.coupling_columns[c].j * row.impulse;
    }
    for (const ContactRow& row : rows.contacts)
        add_columns(rows.columns, row, {row.normal.impulse, row.slip.impulse_1, row.slip.impulse_2}, y);
    for (const AngularRow& row : rows.angulars)
        add_columns(rows.columns, row, {row.spin.impulse, row.roll.impulse_1, row.roll.impulse_2}, y);
}

void set_steps(IslandRows& rows, std::span<const double> x) {
    for (JointRow& row : rows.joints) row.du = x[static_cast<std::size_t>(row.dof)];
    for (CouplingRow& row : rows.couplings) {
        row.du = 0;
        for (std::size_t c = row.first; c < row.last; ++c)
            row.du += rows.coupling_columns[c].j * x[static_cast<std::size_t>(rows.coupling_columns[c].dof)];
    }
    for (ContactRow& row : rows.contacts) {
        const Along u = along(rows.columns, row.first, row.last, x);
        row.normal.du = u.n, row.slip.du_1 = u.t1, row.slip.du_2 = u.t2;
    }
    for (AngularRow& row : rows.angulars) {
        const Along w = along(rows.columns, row.first, row.last, x);
        row.spin.du = w.n, row.roll.du_1 = w.t1, row.roll.du_2 = w.t2;
    }
}

}  // namespace roboss
