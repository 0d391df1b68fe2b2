// See row_sweeps.h.
#include "physics/solver/row_sweeps.h"

#include <algorithm>
#include <cmath>

#include "core/pair.h"

namespace roboss {
namespace {

constexpr std::size_t kOfScalar = 1, kOfContact = 3;  // vectors of J

[[gnu::always_inline]] inline double dot(const double* x, const double* y, std::size_t count) {
    Pair sum{};
    for (std::size_t k = 0; k < count; k += 2) sum += pair_at(x + k) * pair_at(y + k);
    return sum[0] + sum[1];
}

/// y += a x
[[gnu::always_inline]] inline void add_scaled(const double* x, double a, std::size_t count, double* y) {
    for (std::size_t k = 0; k < count; k += 2) put(y + k, pair_at(y + k) + both(a) * pair_at(x + k));
}

double squared(const RowSweeps::ContactImpulse& x, double mass_n, double mass_t) {
    return x.n * x.n / mass_n + (x.t1 * x.t1 + x.t2 * x.t2) / mass_t;
}

/// Cuts friction to what the normal impulse allows.
void cut(double coefficient, RowSweeps::ContactImpulse& x) {
    const double bound = coefficient * x.n, size2 = x.t1 * x.t1 + x.t2 * x.t2;
    if (!(size2 > bound * bound)) return;
    const double share = bound / std::sqrt(size2);
    x.t1 *= share, x.t2 *= share;
}

}  // namespace

void RowSweeps::run(const Problem& p, int most, std::vector<double>& v) {
    converged_ = 1e-8;
    start(p, v.size());
    sweep_all(p, most, v);
}

void RowSweeps::go_on(const Problem& p, int most, std::vector<double>& v) {
    converged_ *= 1e-2;
    sweep_all(p, most, v);
}

void RowSweeps::sweep_all(const Problem& p, int most, std::vector<double>& v) {
    double last = 0, enough = 0;
    for (int i = 0; i < most; ++i) {
        const double change = sweep(p);
        if (i == 0) enough = converged_ * squared_impulses();
        if (i + 1 == most || change <= enough) break;
        accelerate(i > 0 && change <= last ? change / last : 0);
        last = change;
    }
    for (std::size_t r = 0; r < p.robots.size(); ++r)
        std::copy_n(v_.data() + place_[r], p.robots[r]->type->paths.size(), v.data() + p.offsets[r]);
}

/// Velocities without rows, then with what the contacts carried last.
void RowSweeps::start(const Problem& p, std::size_t n) {
    factors_.clear(), factor_first_.clear(), numbers_.clear(), scalars_.clear(), contacts_.clear();
    robot_of_.resize(n);
    place_.assign(1, 0);
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const std::size_t nv = p.robots[r]->type->paths.size();
        std::fill_n(robot_of_.begin() + p.offsets[r], nv, r);
        place_.push_back(place_.back() + ((nv + 1) & ~std::size_t{1}));
    }
    v_.assign(place_.back(), 0.0), v_direction_.assign(v_.size(), 0.0);
    for (std::size_t r = 0; r < p.robots.size(); ++r) {
        const Mechanics<double>& robot = *p.robots[r];
        factor_first_.push_back(factors_.size());
        factors_.insert(factors_.end(), robot.mass_matrix.begin(), robot.mass_matrix.end());
        double* const factor = factors_.data() + factor_first_.back();
        tree_factor(robot.type->paths, factor);
        std::copy(robot.impulse.begin(), robot.impulse.end(), v_.data() + place_[r]);
        tree_solve(robot.type->paths, factor, v_.data() + place_[r]);
    }
    joints_ = p.rows.joints.size();
    for (const JointRow& row : p.rows.joints) add_joint(p, row);
    for (const CouplingRow& row : p.rows.couplings) add_coupling(p, row);
    for (const ContactRow& row : p.rows.contacts) add_contact(p, row);
    v_free_ = v_;
    directions_.assign(scalars_.size(), 0.0);
    contact_directions_.assign(contacts_.size(), {});
    start_scalars(p, p.again);
    start_contacts(p, p.again);
}

void RowSweeps::take_up(const Problem& p, int most, std::vector<double>& v) {
    v_ = v_free_;
    start_scalars(p, true);
    start_contacts(p, true);
    sweep_all(p, most, v);
}

void RowSweeps::start_scalars(const Problem& p, bool again) {
    impulses_.assign(scalars_.size(), 0.0);
    if (!again) return;
    for (std::size_t i = 0; i < scalars_.size(); ++i) {
        impulses_[i] = i < joints_ ? p.rows.joints[i].impulse : p.rows.couplings[i - joints_].impulse;
        push(scalars_[i].sides, kOfScalar, 0, impulses_[i]);
    }
}

void RowSweeps::start_contacts(const Problem& p, bool again) {
    contact_impulses_.clear();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        const FrictionDisc& slip = p.rows.contacts[c].slip;
        ContactImpulse impulse{p.rows.contacts[c].normal.impulse, slip.impulse_1, slip.impulse_2};
        if (!again)
            impulse.t1 = slip.target_1 / slip.compliance, impulse.t2 = slip.target_2 / slip.compliance;
        cut(slip.coefficient, impulse);
        contact_impulses_.push_back(impulse);
        const Sides& sides = contacts_[c].sides;
        push(sides, kOfContact, 0, impulse.n);
        push(sides, kOfContact, 1, impulse.t1), push(sides, kOfContact, 2, impulse.t2);
    }
}

/// The side of the robot that has this degree of freedom, new if it is the first of that robot.
const RowSweeps::Side& RowSweeps::side_of(int dof, std::size_t vectors, Sides& sides) {
    const std::size_t robot = robot_of_[static_cast<std::size_t>(dof)];
    Side& side = sides.a.count == 0 || sides.a.robot == robot ? sides.a : sides.b;
    if (side.count > 0) return side;
    side = {robot, place_[robot], place_[robot + 1] - place_[robot], numbers_.size()};
    numbers_.resize(numbers_.size() + 2 * vectors * side.count);
    return side;
}

/// M^-1 J^T behind J.
void RowSweeps::respond(const Problem& p, const Sides& sides, std::size_t vectors) {
    for (const Side* side : {&sides.a, &sides.b}) {
        if (side->count == 0) continue;
        double* const first = numbers_.data() + side->jacobian;
        std::copy_n(first, vectors * side->count, first + vectors * side->count);
        for (std::size_t k = 0; k < vectors; ++k)
            tree_solve(p.robots[side->robot]->type->paths, factors_.data() + factor_first_[side->robot],
                       first + (vectors + k) * side->count);
    }
}

void RowSweeps::add_joint(const Problem& p, const JointRow& row) {
    Scalar scalar;
    const Side& side = side_of(row.dof, kOfScalar, scalar.sides);
    const auto i = static_cast<std::size_t>(row.dof - p.offsets[side.robot]);
    scalar.unknown = side.velocity + i;
    numbers_[side.jacobian + i] = 1;
    respond(p, scalar.sides, kOfScalar);
    scalar.mass = 1.0 / (numbers_[side.jacobian + side.count + i] + row.compliance);
    scalars_.push_back(scalar);
}

void RowSweeps::add_coupling(const Problem& p, const CouplingRow& row) {
    Scalar scalar;
    for (std::size_t c = row.first; c < row.last; ++c) {
        const CouplingColumn& column = p.rows.coupling_columns[c];
        const Side& side = side_of(column.dof, kOfScalar, scalar.sides);
        numbers_[side.jacobian + static_cast<std::size_t>(column.dof - p.offsets[side.robot])] += column.j;
    }
    respond(p, scalar.sides, kOfScalar);
    scalar.mass = 1.0 / (product(scalar.sides, 0, kOfScalar) + row.compliance);
    scalars_.push_back(scalar);
}

void RowSweeps::add_contact(const Problem& p, const ContactRow& row) {
    Contact contact;
    const ContactColumns& columns = p.rows.columns;
    for (std::size_t c = row.first; c < row.last; ++c) {
        const Side& side = side_of(columns.dof[c], kOfContact, contact.sides);
        const auto i = static_cast<std::size_t>(columns.dof[c] - p.offsets[side.robot]);
        double* const j = numbers_.data() + side.jacobian + i;
        j[0] = columns.n[c], j[side.count] = columns.t1[c], j[2 * side.count] = columns.t2[c];
    }
    respond(p, contact.sides, kOfContact);
    const auto mobility = [&](std::size_t i, std::size_t j) {
        return product(contact.sides, i, kOfContact + j);
    };
    contact.mass_n = 1.0 / (mobility(0, 0) + row.normal.compliance);
    contact.mass_t = 1.0 / (std::max(mobility(1, 1), mobility(2, 2)) + row.slip.compliance);
    contact.t1_n = mobility(1, 0), contact.t2_n = mobility(2, 0);
    contacts_.push_back(contact);
}

/// Product of one vector of J and another vector of the same sides.
double RowSweeps::product(const Sides& sides, std::size_t vector, std::size_t other) const {
    const auto of = [&](const Side& side) {
        const double* const first = numbers_.data() + side.jacobian;
        return dot(first + vector * side.count, first + other * side.count, side.count);
    };
    return of(sides.a) + of(sides.b);
}

/// Along one vector of J.
double RowSweeps::velocity(const Sides& sides, std::size_t vector) const {
    const auto of = [&](const Side& side) {
        return dot(numbers_.data() + side.jacobian + vector * side.count, v_.data() + side.velocity,
                   side.count);
    };
    return of(sides.a) + of(sides.b);
}

void RowSweeps::push(const Sides& sides, std::size_t vectors, std::size_t vector, double impulse) {
    const auto on = [&](const Side& side) {
        add_scaled(numbers_.data() + side.jacobian + (vectors + vector) * side.count, impulse, side.count,
                   v_.data() + side.velocity);
    };
    on(sides.a), on(sides.b);
}

double RowSweeps::sweep_scalar(const BoundedRow& row, std::size_t at, double u) {
    const Scalar& scalar = scalars_[at];
    const double before = impulses_[at];
    const double wanted = before + (row.target - u - row.compliance * before) * scalar.mass;
    const double change = std::clamp(wanted, row.low, row.high) - before;
    if (change == 0) return 0;
    push(scalar.sides, kOfScalar, 0, change);
    impulses_[at] = before + change;
    return change * change / scalar.mass;
}

double RowSweeps::sweep_contact(const ContactRow& row, std::size_t at) {
    const Contact& contact = contacts_[at];
    const Sides& sides = contact.sides;
    ContactImpulse& now = contact_impulses_[at];
    const ContactImpulse before = now;
    now.n += (row.normal.target - velocity(sides, 0) - row.normal.compliance * before.n) * contact.mass_n;
    now.n = std::clamp(now.n, row.normal.low, row.normal.high);
    if (now.n == 0 && before.n == 0 && before.t1 == 0 && before.t2 == 0) return 0;  // most do not push
    const double dn = now.n - before.n, u_1 = velocity(sides, 1) - row.slip.target_1,
                 u_2 = velocity(sides, 2) - row.slip.target_2;
    now.t1 -= (u_1 + contact.t1_n * dn + row.slip.compliance * before.t1) * contact.mass_t;
    now.t2 -= (u_2 + contact.t2_n * dn + row.slip.compliance * before.t2) * contact.mass_t;
    cut(row.slip.coefficient, now);
    const ContactImpulse change{dn, now.t1 - before.t1, now.t2 - before.t2};
    if (change.n == 0 && change.t1 == 0 && change.t2 == 0) return 0;
    for (const Side* side : {&sides.a, &sides.b}) {
        if (side->count == 0) continue;
        const double* y = numbers_.data() + side->jacobian + kOfContact * side->count;
        double* v = v_.data() + side->velocity;
        for (std::size_t k = 0; k < side->count; k += 2)
            put(v + k, pair_at(v + k) + both(change.n) * pair_at(y + k) +
                           both(change.t1) * pair_at(y + side->count + k) +
                           both(change.t2) * pair_at(y + 2 * side->count + k));
    }
    return squared(change, contact.mass_n, contact.mass_t);
}

/// One sweep; returns the squared change of the impulses, each by its effective mass.
double RowSweeps::sweep(const Problem& p) {
    v_before_ = v_, impulses_before_ = impulses_, contacts_before_ = contact_impulses_;
    double change = 0;
    for (std::size_t i = 0; i < joints_; ++i)
        change += sweep_scalar(p.rows.joints[i], i, v_[scalars_[i].unknown]);
    for (std::size_t i = joints_; i < scalars_.size(); ++i)
        change += sweep_scalar(p.rows.couplings[i - joints_], i, velocity(scalars_[i].sides, 0));
    for (std::size_t c = 0; c < contacts_.size(); ++c) change += sweep_contact(p.rows.contacts[c], c);
    return change;
}

double RowSweeps::squared_impulses() const {
    double sum = 0;
    for (std::size_t i = 0; i < scalars_.size(); ++i) sum += impulses_[i] * impulses_[i] / scalars_[i].mass;
    for (std::size_t c = 0; c < contacts_.size(); ++c)
        sum += squared(contact_impulses_[c], contacts_[c].mass_n, contacts_[c].mass_t);
    return sum;
}

/// Moves along the search direction, shortened by `share`, and adds the last sweep's change to it. Velocities
/// are linear in the impulses, so they have a search direction of their own.
void RowSweeps::accelerate(double share) {
    const auto move = [share](double before, double& now, double& direction) {
        const double change = now - before;
        direction *= share;
        now += direction;
        direction += change;
    };
    for (std::size_t i = 0; i < v_.size(); ++i) move(v_before_[i], v_[i], v_direction_[i]);
    for (std::size_t i = 0; i < impulses_.size(); ++i)
        move(impulses_before_[i], impulses_[i], directions_[i]);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        const ContactImpulse& before = contacts_before_[c];
        ContactImpulse &now = contact_impulses_[c], &direction = contact_directions_[c];
        move(before.n, now.n, direction.n);
        move(before.t1, now.t1, direction.t1), move(before.t2, now.t2, direction.t2);
    }
}

}  // namespace roboss
