// See net_hessian.h.
#include "physics/solver/net_hessian.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/spatial_shift.h"
#include "physics/dynamics/joint_complement.h"

namespace roboss {
namespace {

/// Wrenches that span the same space as the motions, each with power 1 on its own and none on the others.
void make_dual(std::span<Spatial> motions) {
    const std::size_t n = motions.size();
    double a[6][12] = {};
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) a[i][j] = dot(motions[i], motions[j]);
        a[i][n + i] = 1;
    }
    for (std::size_t c = 0; c < n; ++c) {  // positive definite: no pivoting
        const double inverse = 1.0 / a[c][c];
        for (std::size_t k = c; k < 2 * n; ++k) a[c][k] *= inverse;
        for (std::size_t i = 0; i < n; ++i) {
            if (i == c) continue;
            const double f = a[i][c];
            for (std::size_t k = c; k < 2 * n; ++k) a[i][k] -= f * a[c][k];
        }
    }
    std::array<Spatial, 6> dual;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) dual[i] += motions[j] * a[i][n + j];
    std::copy_n(dual.begin(), n, motions.begin());
}

}  // namespace

bool NetHessian::suits(std::span<const Mechanics<double>* const> robots, const IslandRows& rows) {
    constexpr std::size_t kRowsPerBody = 30;
    std::size_t bodies = 0;
    for (const Mechanics<double>* robot : robots)
        if (!robot->type->elimination.empty()) bodies += robot->type->bodies.size();
    if (bodies == 0 || rows.places.size() != rows.contacts.size()) return false;
    const auto between =
        3 * static_cast<std::size_t>(std::ranges::count_if(rows.contacts, &ContactRow::joins));
    return between <= kRowsPerBody * bodies &&
           std::ranges::none_of(rows.couplings, [](const CouplingRow& row) { return row.bond >= 0; });
}

void NetHessian::start(std::span<const Mechanics<double>* const> robots, std::span<const int> offsets,
                       const IslandRows& rows) {
    rows_.clear(), readings_.clear(), nodes_.clear(), meetings_.clear();
    parts_.start(robots, offsets, rows);
    add_joints(rows);
    add_meetings(rows);
    link_nodes();
    number_nodes(robots);
    matrix_.lay_out(*pattern_, counts_);
}

void NetHessian::add_row(Kind kind, std::size_t source, const PartJacobian& a, const PartJacobian& b) {
    rows_.push_back({kind, source, a, b, 0, 0});
    nodes_.back().last = rows_.size();
}

/// What joints bear and what acts along their degrees of freedom; nodes as in JointElimination, net by net.
void NetHessian::add_joints(const IslandRows& rows) {
    const std::size_t last = parts_.robots() - 1;
    damping_.assign(parts_.dof(last, static_cast<std::size_t>(parts_.robot(last).type->nv)), 0.0);
    has_row_.assign(damping_.size(), 0);
    for (const JointRow& row : rows.joints) has_row_[static_cast<std::size_t>(row.dof)] = 1;
    list_loop_rows(rows);
    std::size_t next = 0;  // of them
    for (std::size_t r = 0; r < parts_.robots(); ++r) {
        const RobotType& type = *parts_.robot(r).type;
        if (!parts_.is_net(r)) continue;
        for (std::size_t d = 0; d < type.dofs.size(); ++d)
            damping_[parts_.dof(r, d + static_cast<std::size_t>(type.base_nv()))] =
                parts_.robot(r).joint_inertias[d];
        for (std::size_t b = 0; b < type.bodies.size(); ++b) add_tree_joint(r, b);
        for (std::size_t i = 0; i < type.loops.size(); ++i) add_loop(r, i, rows, next);
    }
}

void NetHessian::add_tree_joint(std::size_t robot, std::size_t body) {
    const Mechanics<double>& work = parts_.robot(robot);
    const Body& info = work.type->bodies[body];
    const int a = parts_.part_of(robot, info.parent), b = parts_.part_of(robot, static_cast<int>(body));
    nodes_.push_back({rows_.size(), rows_.size(), a, b});
    const Vec3 p = work.bodies[body].X_WB.p - work.origin;
    std::array<Spatial, 6> axes;
    const auto count = static_cast<std::size_t>(info.nv);
    for (std::size_t k = 0; k < count; ++k)
        axes[k] = motion_about(work.axes[static_cast<std::size_t>(info.v_index) + k], p);
    const JointComplement complement = joint_complement(std::span(axes).first(count));
    for (std::size_t i = 0; i < complement.count; ++i) {
        const Spatial wrench = force_from(complement.wrenches[i], p);
        add_row(Kind::kHard, 0, parts_.add_wrench(a, wrench, -1), parts_.add_wrench(b, wrench, 1));
    }
    make_dual(std::span(axes).first(count));
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t dof = parts_.dof(robot, static_cast<std::size_t>(info.v_index) + k);
        const Spatial wrench = force_from(axes[k], p);
        readings_.push_back({dof, parts_.add_wrench(a, wrench, -1), parts_.add_wrench(b, wrench, 1)});
        if (has_row_[dof] != 0 || damping_[dof] != 0)
            add_row(Kind::kDof, dof, readings_.back().a, readings_.back().b);
    }
}

void NetHessian::list_loop_rows(const IslandRows& rows) {
    loop_rows_.clear();
    for (std::size_t c = 0; c < rows.couplings.size(); ++c) {
        const CouplingRow& row = rows.couplings[c];
        if (row.loop < 0 || row.first == row.last) continue;
        const std::size_t robot = parts_.robot_of(rows.coupling_columns[row.first].dof);
        if (parts_.is_net(robot)) loop_rows_.push_back({robot, row.loop, c});
    }
    std::ranges::sort(loop_rows_);
}

void NetHessian::add_loop(std::size_t robot, std::size_t loop, const IslandRows& rows, std::size_t& next) {
    const LoopJoint& joint = parts_.robot(robot).type->loops[loop];
    const int a = parts_.part_of(robot, joint.body_a), b = parts_.part_of(robot, joint.body_b);
    nodes_.push_back({rows_.size(), rows_.size(), a, b});
    for (; next < loop_rows_.size() && loop_rows_[next].robot == robot &&
           loop_rows_[next].loop == static_cast<int>(loop);
         ++next) {
        const std::size_t coupling = loop_rows_[next].coupling;
        const Spatial& wrench = rows.couplings[coupling].wrench;
        add_row(Kind::kCoupling, coupling, parts_.add_wrench(a, wrench, -1), parts_.add_wrench(b, wrench, 1));
    }
}

/// Contacts and angular rows of two parts, the parts in order.
void NetHessian::add_meetings(const IslandRows& rows) {
    const auto add = [&](std::size_t contact, std::size_t row, bool angular) {
        const auto [a, b] = parts_.parts_of(rows, contact);
        if (a >= 0 && b >= 0 && a != b) meetings_.push_back({std::min(a, b), std::max(a, b), row, angular});
    };
    for (std::size_t c = 0; c < rows.contacts.size(); ++c) add(c, c, false);
    for (std::size_t i = 0; i < rows.angulars.size(); ++i) add(rows.angulars[i].contact, i, true);
    std::ranges::sort(meetings_);
    for (std::size_t k = 0; k < meetings_.size(); ++k) {
        const Meeting& m = meetings_[k];
        if (k == 0 || meetings_[k - 1].a != m.a || meetings_[k - 1].b != m.b)
            nodes_.push_back({rows_.size(), rows_.size(), m.a, m.b});
        const std::size_t contact = m.angular ? rows.angulars[m.row].contact : m.row;
        const auto [a, b] = parts_.parts_of(rows, contact);
        const auto on_a =
            m.angular ? parts_.add_angular(rows, m.row, true, a) : parts_.add_contact(rows, m.row, true, a);
        const auto on_b =
            m.angular ? parts_.add_angular(rows, m.row, false, b) : parts_.add_contact(rows, m.row, false, b);
        add_row(m.angular ? Kind::kSpin : Kind::kNormal, m.row, on_a[0], on_b[0]);
        for (std::size_t i = 1; i < 3; ++i)
            add_row(m.angular ? Kind::kRoll : Kind::kSlip, m.row, on_a[i], on_b[i]);
    }
}

/// Nodes that are on one part are coupled.
void NetHessian::link_nodes() {
    node_first_.assign(parts_.count() + 1, 0);
    const auto sides = [&](const Node& node, const auto& visit) {
        if (node.a >= 0) visit(static_cast<std::size_t>(node.a));
        if (node.b >= 0) visit(static_cast<std::size_t>(node.b));
    };
    for (const Node& node : nodes_) sides(node, [&](std::size_t part) { ++node_first_[part + 1]; });
    for (std::size_t part = 0; part < parts_.count(); ++part) node_first_[part + 1] += node_first_[part];
    nodes_of_part_.resize(node_first_.back());
    for (std::size_t k = nodes_.size(); k-- > 0;)
        sides(nodes_[k], [&](std::size_t part) { nodes_of_part_[--node_first_[part + 1]] = k; });
    // Filling moved each end down to where its list begins.
    for (std::size_t part = 0; part < parts_.count(); ++part) node_first_[part] = node_first_[part + 1];
    node_first_[parts_.count()] = nodes_of_part_.size();
    links_.clear();
    for (std::size_t part = 0; part < parts_.count(); ++part)
        for (std::size_t i = node_first_[part]; i < node_first_[part + 1]; ++i)
            for (std::size_t j = i + 1; j < node_first_[part + 1]; ++j)
                links_.emplace_back(static_cast<int>(nodes_of_part_[i]), static_cast<int>(nodes_of_part_[j]));
}

/// In which order they are eliminated: one net without contacts between its bodies knows it.
void NetHessian::number_nodes(std::span<const Mechanics<double>* const> robots) {
    counts_.clear();
    for (const Node& node : nodes_) counts_.push_back(node.last - node.first);
    if (robots.size() == 1 && meetings_.empty()) {
        pattern_ = &robots[0]->type->elimination.pattern;
        return;
    }
    pattern_ = &own_pattern_;
    if (linked_nodes_ == nodes_.size() && linked_ == links_) return;
    linked_nodes_ = nodes_.size(), linked_ = links_;
    own_pattern_.analyse(nodes_.size(), links_);
}

void NetHessian::assemble(const IslandRows& rows, const Team& team) {
    constexpr std::size_t kBlock = 64;  // rows
    parts_.factor(rows);
    over_ = parts_.jacobians();
    const auto divide = [&](const PartJacobian& j) {
        if (j.part >= 0) parts_.over_factor(j.part, over(j));
    };
    team.run_blocks(rows_.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (rows_[i].kind != Kind::kDof) divide(rows_[i].a), divide(rows_[i].b);
    });
    team.run_blocks(readings_.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) divide(readings_[i].a), divide(readings_[i].b);
    });
    set_curvatures(rows);
    team.run_blocks(rows_.size(), kBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) scale(rows_[i]);
    });
}

void NetHessian::set_curvatures(const IslandRows& rows) {
    joint_d_.assign(damping_.size(), 0.0);
    for (const JointRow& joint : rows.joints) joint_d_[static_cast<std::size_t>(joint.dof)] += joint.d;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        Row& row = rows_[i];
        switch (row.kind) {
            case Kind::kHard:
                break;
            case Kind::kDof:
                row.d = damping_[row.source] + joint_d_[row.source];
                break;
            case Kind::kCoupling:
                row.d = rows.couplings[row.source].d;
                break;
            case Kind::kNormal:
                row.d = rows.contacts[row.source].normal.d;
                break;
            case Kind::kSpin:
                row.d = rows.angulars[row.source].spin.d;
                break;
            case Kind::kSlip:
                set_disc(rows.contacts[row.source].slip, row, rows_[i + 1]), ++i;
                break;
            case Kind::kRoll:
                set_disc(rows.angulars[row.source].roll, row, rows_[i + 1]), ++i;
                break;
        }
    }
}

/// Turns the two rows of friction to the principal directions of its curvature.
void NetHessian::set_disc(const FrictionDisc& disc, Row& first, Row& second) {
    const double half = 0.5 * (disc.d_11 - disc.d_22), mean = 0.5 * (disc.d_11 + disc.d_22);
    const double radius = std::sqrt(half * half + disc.d_12 * disc.d_12);
    first.d = mean + radius, second.d = std::max(mean - radius, 0.0);
    if (disc.d_12 == 0 && half >= 0) return;
    // (x, y): eigenvector of the larger one
    double x = half + radius, y = disc.d_12;
    if (half < 0) x = disc.d_12, y = radius - half;
    const double length = std::sqrt(x * x + y * y);
    if (!(length > 0)) return;
    x /= length, y /= length;
    const auto turn = [&](const PartJacobian& j1, const PartJacobian& j2) {
        double *o1 = over(j1), *o2 = over(j2);
        for (std::size_t k = 0; k < parts_.size_of(j1.part); ++k) {
            const double t1 = o1[k], t2 = o2[k];
            o1[k] = x * t1 + y * t2, o2[k] = x * t2 - y * t1;
        }
    };
    turn(first.a, second.a), turn(first.b, second.b);
}

double NetHessian::product(const Row& p, const Row& q, int part) const {
    const double* x = over(p.a.part == part ? p.a : p.b);
    const double* y = over(q.a.part == part ? q.a : q.b);
    double sum = 0;
    for (std::size_t k = 0; k < parts_.size_of(part); ++k) sum += x[k] * y[k];
    return sum;
}

/// So that the diagonal of the scaled matrix is 1; a row without curvature is out of it.
void NetHessian::scale(Row& row) {
    double mobility = 0;
    for (const int part : {row.a.part, row.b.part})
        if (part >= 0) mobility += product(row, row, part);
    if (row.kind == Kind::kHard)
        row.scale = mobility > 0 ? 1.0 / std::sqrt(mobility) : 0.0;
    else
        row.scale = std::sqrt(row.d / (row.d * mobility + 1));
}

void NetHessian::add_rows(std::size_t position, BlockLdlt& matrix) const {
    const std::size_t p = pattern_->node(position);
    const Node& node = nodes_[p];
    const BlockLdlt::Block own = matrix.block(position, position);
    for (std::size_t i = node.first; i < node.last; ++i) {  // of D^-1, what the scale leaves
        const Row& row = rows_[i];
        double& diagonal = own.at[(i - node.first) * (own.stride + 1)];
        if (row.scale == 0)
            diagonal += 1;
        else if (row.kind != Kind::kHard)
            diagonal += row.scale * row.scale / row.d;
    }
    for (const int part : {node.a, node.b}) {
        if (part < 0) continue;
        const auto at = static_cast<std::size_t>(part);
        for (std::size_t k = node_first_[at]; k < node_first_[at + 1]; ++k) {
            const std::size_t q = nodes_of_part_[k];
            if (pattern_->position(q) < position || nodes_[q].first == nodes_[q].last) continue;
            const BlockLdlt::Block to = matrix.block(position, pattern_->position(q));
            for (std::size_t i = node.first; i < node.last; ++i) {
                double* entries = to.at + (i - node.first) * to.stride;
                for (std::size_t j = p == q ? i : nodes_[q].first; j < nodes_[q].last; ++j)
                    entries[j - nodes_[q].first] +=
                        rows_[i].scale * rows_[j].scale * product(rows_[i], rows_[j], part);
            }
        }
    }
}

/// Generalised forces as forces on the parts, over their factors.
void NetHessian::spread_forces(std::span<const double> x) {
    forces_.assign(parts_.size(), 0.0);
    for (std::size_t r = 0; r < parts_.robots(); ++r) {
        if (parts_.is_net(r)) continue;
        const int part = parts_.robot_part(r);
        double* to = forces_.data() + parts_.first_of(part);
        for (std::size_t k = 0; k < parts_.size_of(part); ++k) to[k] = x[parts_.dof(r, k)];
        parts_.over_factor(part, to);
    }
    for (const Reading& reading : readings_) push(reading.a, x[reading.dof]), push(reading.b, x[reading.dof]);
}

/// Adds a force along a row.
void NetHessian::push(const PartJacobian& j, double force) {
    if (j.part < 0) return;
    double* to = forces_.data() + parts_.first_of(j.part);
    const double* by = over(j);
    for (std::size_t k = 0; k < parts_.size_of(j.part); ++k) to[k] += by[k] * force;
}

/// The scalar product with the forces, over the factor of the part.
double NetHessian::along(const PartJacobian& j) const {
    double sum = 0;
    if (j.part < 0) return sum;
    const double *by = over(j), *force = forces_.data() + parts_.first_of(j.part);
    for (std::size_t k = 0; k < parts_.size_of(j.part); ++k) sum += by[k] * force[k];
    return sum;
}

/// The parts' motions, which the forces over the factors are, back to degrees of freedom.
void NetHessian::read_motions(std::span<double> x) const {
    for (const Reading& reading : readings_) x[reading.dof] = along(reading.b) + along(reading.a);
}

void NetHessian::solve(std::span<double> x, const Team& team) {
    spread_forces(x);
    mu_.resize(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i)
        mu_[i] = rows_[i].scale * (along(rows_[i].a) + along(rows_[i].b));
    matrix_.solve(*this, mu_, 0, team);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const double impulse = -(rows_[i].scale * mu_[i]);
        push(rows_[i].a, impulse), push(rows_[i].b, impulse);
    }
    read_motions(x);
    for (std::size_t r = 0; r < parts_.robots(); ++r) {
        if (parts_.is_net(r)) continue;
        const int part = parts_.robot_part(r);
        double* motion = forces_.data() + parts_.first_of(part);
        parts_.over_transpose(part, motion);
        for (std::size_t k = 0; k < parts_.size_of(part); ++k) x[parts_.dof(r, k)] = motion[k];
    }
}

}  // namespace roboss
