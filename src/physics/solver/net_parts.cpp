// See net_parts.h.
#include "physics/solver/net_parts.h"

#include <algorithm>
#include <cmath>

#include "math/spatial_shift.h"

namespace roboss {
namespace {

/// The inertia of a body as a matrix of 6 by 6 about a point at c from O: motion to momentum.
void put_inertia(const SpatialInertia& I, const Vec3& c, double* out) {
    const auto momentum = [&](const Spatial& about_c) {
        const Spatial v{about_c.angular, about_c.linear + cross(c, about_c.angular)};
        const Spatial p = I * v;
        return force_about(p, c);
    };
    for (std::size_t k = 0; k < 6; ++k) {
        Spatial unit;
        (k < 3 ? unit.angular[k] : unit.linear[k - 3]) = 1;
        const Spatial p = momentum(unit);
        for (std::size_t i = 0; i < 3; ++i) out[i * 6 + k] = p.angular[i], out[(i + 3) * 6 + k] = p.linear[i];
    }
}

void put(const Spatial& x, double* to) {
    for (std::size_t i = 0; i < 3; ++i) to[i] = x.angular[i], to[i + 3] = x.linear[i];
}

}  // namespace

void NetParts::start(std::span<const Mechanics<double>* const> robots, std::span<const int> offsets,
                     const IslandRows& rows) {
    robots_ = robots, offsets_ = offsets;
    parts_.clear(), part_of_robot_.clear(), masses_.clear(), jacobians_.clear(), folded_.clear();
    size_ = 0;
    for (std::size_t r = 0; r < robots.size(); ++r) {
        const RobotType& type = *robots[r]->type;
        part_of_robot_.push_back(static_cast<int>(parts_.size()));
        if (!is_net(r)) {
            add_part(r, -1, static_cast<std::size_t>(type.nv));
            continue;
        }
        for (std::size_t b = 0; b < type.bodies.size(); ++b) add_part(r, static_cast<int>(b), 6);
    }
    for (std::size_t c = 0; c < rows.contacts.size(); ++c) {
        const auto [a, b] = parts_of(rows, c);
        if (a == b ? a >= 0 : std::min(a, b) < 0)
            folded_.push_back({c, false, add_contact(rows, c, a >= 0, std::max(a, b))});
    }
    for (std::size_t i = 0; i < rows.angulars.size(); ++i) {
        const auto [a, b] = parts_of(rows, rows.angulars[i].contact);
        if (a == b ? a >= 0 : std::min(a, b) < 0)
            folded_.push_back({i, true, add_angular(rows, i, a >= 0, std::max(a, b))});
    }
}

void NetParts::add_part(std::size_t robot, int body, std::size_t size) {
    const Part& part = parts_.emplace_back(Part{robot, body, size, size_, masses_.size()});
    size_ += size;
    masses_.resize(masses_.size() + size * size, 0.0);
    if (body >= 0)
        set_body(part);
    else
        set_robot(part);
}

void NetParts::set_body(const Part& part) {
    const Mechanics<double>& robot = *robots_[part.robot];
    const auto b = static_cast<std::size_t>(part.body);
    put_inertia(robot.own_inertias[b], robot.bodies[b].centre, masses_.data() + part.matrix_at);
}

void NetParts::set_robot(const Part& part) {
    const Mechanics<double>& robot = *robots_[part.robot];
    const DofPaths& paths = robot.type->paths;
    double* P = masses_.data() + part.matrix_at;
    std::fill_n(P, part.size * part.size, 0.0);
    for (std::size_t i = 0; i < part.size; ++i)
        for (std::size_t k = 0; k < paths.length(i); ++k) {
            const auto j = static_cast<std::size_t>(paths.path(i)[k]);
            P[i * part.size + j] = P[j * part.size + i] = robot.mass_matrix[paths.row(i) + k];
        }
}

int NetParts::part_of(std::size_t robot, int body) const {
    if (!is_net(robot)) return part_of_robot_[robot];
    return body < 0 ? -1 : part_of_robot_[robot] + body;
}

std::size_t NetParts::robot_of(int dof) const {
    const auto after = std::ranges::upper_bound(offsets_, dof);
    std::size_t robot = static_cast<std::size_t>(after - offsets_.begin()) - 1;
    return robot;
}

std::pair<int, int> NetParts::parts_of(const IslandRows& rows, std::size_t contact) const {
    const ContactRow& row = rows.contacts[contact];
    const ContactPlace& place = rows.places[contact];
    if (row.first == row.last) return {-1, -1};
    const auto part = [&](int body, std::size_t column) {
        return body < 0 ? -1 : part_of(robot_of(rows.columns.dof[column]), body);
    };
    return {part(place.body_a, row.first), part(place.body_b, row.last - 1)};
}

std::size_t NetParts::room(int part) {
    const std::size_t at = jacobians_.size();
    jacobians_.resize(at + size_of(part), 0.0);
    return at;
}

PartJacobian NetParts::add_wrench(int part, const Spatial& wrench, double sign) {
    if (part < 0) return {};
    const std::size_t at = room(part);
    const Part& p = parts_[static_cast<std::size_t>(part)];
    const Vec3& centre = robots_[p.robot]->bodies[static_cast<std::size_t>(p.body)].centre;
    put(force_about(wrench, centre) * sign, jacobians_.data() + at);
    return {part, at};
}

std::array<PartJacobian, 3> NetParts::add_contact(const IslandRows& rows, std::size_t contact, bool is_a,
                                                  int part) {
    const ContactPlace& place = rows.places[contact];
    const Part& p = parts_[static_cast<std::size_t>(part)];
    std::array<PartJacobian, 3> j;
    if (p.body >= 0) {
        const Vec3& arm = is_a ? place.arm_a : place.arm_b;
        for (std::size_t i = 0; i < 3; ++i)
            j[i] = add_wrench(part, {cross(arm, place.axes[i]), place.axes[i]}, is_a ? 1.0 : -1.0);
        return j;
    }
    const ContactRow& row = rows.contacts[contact];
    return add_columns(rows, row.first, row.last, part);
}

std::array<PartJacobian, 3> NetParts::add_angular(const IslandRows& rows, std::size_t angular, bool is_a,
                                                  int part) {
    const AngularRow& row = rows.angulars[angular];
    const Part& p = parts_[static_cast<std::size_t>(part)];
    if (p.body < 0) return add_columns(rows, row.first, row.last, part);
    const Vec3& normal = rows.places[row.contact].axes[0];
    Vec3 t1, t2;
    tangents(normal, t1, t2);
    const double sign = is_a ? 1.0 : -1.0;
    return {add_wrench(part, {normal, {}}, sign), add_wrench(part, {t1, {}}, sign),
            add_wrench(part, {t2, {}}, sign)};
}

/// What of these columns is the robot's.
std::array<PartJacobian, 3> NetParts::add_columns(const IslandRows& rows, std::size_t first, std::size_t last,
                                                  int part) {
    const Part& p = parts_[static_cast<std::size_t>(part)];
    const ContactColumns& columns = rows.columns;
    std::array<PartJacobian, 3> j;
    for (PartJacobian& each : j) each = {part, room(part)};
    for (std::size_t c = first; c < last; ++c) {
        const int own = columns.dof[c] - offsets_[p.robot];
        if (own < 0 || own >= static_cast<int>(p.size)) continue;
        const auto k = static_cast<std::size_t>(own);
        jacobians_[j[0].at + k] += columns.n[c];
        jacobians_[j[1].at + k] += columns.t1[c], jacobians_[j[2].at + k] += columns.t2[c];
    }
    return j;
}

void NetParts::factor(const IslandRows& rows) {
    matrices_ = masses_;
    fold_joints(rows);
    fold_couplings(rows);
    fold_contacts(rows);
    for (const Part& part : parts_) {
        double* P = matrix_of(part);
        const std::size_t n = part.size;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = P[i * n + j];
                for (std::size_t k = 0; k < j; ++k) sum -= P[i * n + k] * P[j * n + k];
                P[i * n + j] =
                    i == j ? 1.0 / std::sqrt(sum) : sum * P[j * n + j];  // reciprocals on the diagonal
            }
    }
}

/// P += d x y^T + d y x^T, or d x x^T if they are one; the lower triangle.
void NetParts::fold(const Part& part, const double* x, const double* y, double d) {
    if (d == 0) return;
    double* P = matrix_of(part);
    for (std::size_t i = 0; i < part.size; ++i)
        for (std::size_t j = 0; j <= i; ++j)
            P[i * part.size + j] += x == y ? d * x[i] * x[j] : d * (x[i] * y[j] + y[i] * x[j]);
}

/// Motors, limits and joint friction of robots that are parts.
void NetParts::fold_joints(const IslandRows& rows) {
    std::size_t robot = 0;  // joint rows come robot by robot
    for (const JointRow& row : rows.joints) {
        while (robot + 1 < offsets_.size() && row.dof >= offsets_[robot + 1]) ++robot;
        if (is_net(robot)) continue;
        const Part& part = parts_[static_cast<std::size_t>(part_of_robot_[robot])];
        const auto i = static_cast<std::size_t>(row.dof - offsets_[robot]);
        matrix_of(part)[i * part.size + i] += row.d;
    }
}

/// Their loops, gearboxes and mimic joints.
void NetParts::fold_couplings(const IslandRows& rows) {
    for (const CouplingRow& row : rows.couplings) {
        if (row.first == row.last || row.d == 0) continue;
        const std::size_t robot = robot_of(rows.coupling_columns[row.first].dof);
        if (is_net(robot)) continue;
        const Part& part = parts_[static_cast<std::size_t>(part_of_robot_[robot])];
        column_.assign(part.size, 0.0);
        for (std::size_t c = row.first; c < row.last; ++c)
            column_[static_cast<std::size_t>(rows.coupling_columns[c].dof - offsets_[robot])] +=
                rows.coupling_columns[c].j;
        fold(part, column_.data(), column_.data(), row.d);
    }
}

void NetParts::fold_point(const std::array<PartJacobian, 3>& j, double normal, const FrictionDisc& disc) {
    const Part& part = parts_[static_cast<std::size_t>(j[0].part)];
    const double *n = jacobians_.data() + j[0].at, *t1 = jacobians_.data() + j[1].at,
                 *t2 = jacobians_.data() + j[2].at;
    fold(part, n, n, normal);
    fold(part, t1, t1, disc.d_11), fold(part, t2, t2, disc.d_22);
    fold(part, t1, t2, disc.d_12);
}

void NetParts::fold_contacts(const IslandRows& rows) {
    for (const OnePart& one : folded_) {
        if (one.angular)
            fold_point(one.j, rows.angulars[one.row].spin.d, rows.angulars[one.row].roll);
        else
            fold_point(one.j, rows.contacts[one.row].normal.d, rows.contacts[one.row].slip);
    }
}

void NetParts::over_factor(int part, double* x) const {
    const Part& p = parts_[static_cast<std::size_t>(part)];
    const double* L = matrices_.data() + p.matrix_at;
    for (std::size_t i = 0; i < p.size; ++i) {
        double sum = x[i];
        for (std::size_t k = 0; k < i; ++k) sum -= L[i * p.size + k] * x[k];
        x[i] = sum * L[i * p.size + i];
    }
}

void NetParts::over_transpose(int part, double* x) const {
    const Part& p = parts_[static_cast<std::size_t>(part)];
    const double* L = matrices_.data() + p.matrix_at;
    for (std::size_t i = p.size; i-- > 0;) {
        double sum = x[i];
        for (std::size_t k = i + 1; k < p.size; ++k) sum -= L[k * p.size + i] * x[k];
        x[i] = sum * L[i * p.size + i];
    }
}

}  // namespace roboss
