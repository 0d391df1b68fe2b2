// Rows of patches with robots with joints.
#include <algorithm>

#include "physics/soft/soft_solver.h"

namespace roboss::soft {
namespace {

/// m/s, of a point of a body of a robot that moves.
Vec3 point_velocity(const RobotWork& robot, int body, const Vec3& p) {
    if (body < 0) return {};
    const Spatial& v = robot.bodies[static_cast<std::size_t>(body)].velocity;
    return v.linear + cross(v.angular, p - robot.origin);
}

TreeRow free_row(const Body& body, const Push& push, double sign) {
    const Vec3 force = push.turns ? Vec3{} : push.direction * sign,
               turn = body.turned_by(push.turns ? push.direction * sign
                                                : cross(push.point - body.centre, force));
    return {{force.x, force.y, force.z, turn.x, turn.y, turn.z}};
}

TreeRow side_row(const JointedSide& side, const Push& push, double sign) {
    return side.free != nullptr ? free_row(*side.free, push, sign)
                                : soft::row_of(*side.tree, side.path, push, sign);
}

double product(const TreeRow& x, const TreeRow& y, const JointedSide& side) {
    double first = 0, sum = 0;
    for (std::size_t c = 0; c < 3; ++c) first += x.x[c] * y.x[c];
    for (std::size_t c = 3; c < 6 + static_cast<std::size_t>(side.path.further()); ++c)
        sum += x.x[c] * y.x[c];
    return first * side.inverse_mass + sum;
}

}  // namespace

double Solver::inverse_mass(int slot) const {
    if (slot < 0) return 0;
    const auto at = static_cast<std::size_t>(slot);
    return at < bodies_.size() ? bodies_[at].inverse_mass : 1;
}

JointedSide Solver::jointed_side(int slot, const RobotWork& robot, int body, int other) const {
    JointedSide side;
    side.robot = &robot, side.slot = slot, side.body = body, side.inverse_mass = inverse_mass(slot);
    const auto at = static_cast<std::size_t>(slot);
    if (at < bodies_.size()) {
        side.free = &bodies_[at];
    } else {
        side.tree = &trees_[tree_of_[at - bodies_.size()]];
        side.path = path_to(*robot.type, body, other);
    }
    return side;
}

JointedPair Solver::jointed_pair(const Island& island, const Pair& pair) const {
    const Contact& c = *island.contacts[pair.first];
    const auto robot = [&](int r) -> const RobotWork& { return island.robots[static_cast<std::size_t>(r)]; };
    JointedPair sides;
    sides.swapped = pair.swapped, sides.itself = pair.itself;
    if (pair.swapped) {
        sides.a = jointed_side(pair.a, robot(c.robot_b), c.body_b, -1);
        return sides;
    }
    sides.a = jointed_side(pair.a, robot(c.robot_a), c.body_a, pair.itself ? c.body_b : -1);
    if (pair.b >= 0) sides.b = jointed_side(pair.b, robot(c.robot_b), c.body_b, -1);
    if (pair.itself) sides.b.body = c.body_b;
    return sides;
}

void Solver::set_row(const JointedPair& pair, const Push& push, const Vec3& shift_b, JointedRow& row) const {
    Push there = push;
    there.point = push.point + shift_b;
    if (pair.itself) {
        row.a = row_between(*pair.a.tree, pair.a.path, pair.a.body, push, pair.b.body, there);
        return;
    }
    row.a = side_row(pair.a, pair.swapped ? there : push, 1);
    if (pair.b.slot >= 0) row.b = side_row(pair.b, there, -1);
}

double product(const JointedRow& x, const JointedRow& y, const JointedPair& pair) {
    const double a = product(x.a, y.a, pair.a);
    return pair.b.slot >= 0 ? a + product(x.b, y.b, pair.b) : a;
}

/// Speed at which the sides come together along n, before the tick.
double Solver::approach_of(const JointedPair& pair, const Vec3& n, const Contact& c) const {
    const Vec3 there = c.p_W + c.shift_b;
    Vec3 v = point_velocity(*pair.a.robot, pair.a.body, pair.swapped ? there : c.p_W);
    if (pair.itself)
        v -= point_velocity(*pair.a.robot, pair.b.body, there);
    else if (pair.b.slot >= 0)
        v -= point_velocity(*pair.b.robot, pair.b.body, there);
    return -dot(n, v);
}

void Solver::clear_columns(const Batch& batch) {
    const auto zero = [&](const Path& path) {
        std::fill_n(problem_.places.begin() + static_cast<std::ptrdiff_t>(path.first), 8 * path.further,
                    static_cast<int>(8 * (problem_.velocity.size() - 1)));
    };
    zero(batch.path_a), zero(batch.path_b);
    std::fill_n(problem_.columns.begin() + static_cast<std::ptrdiff_t>(batch.first_column),
                (static_cast<std::size_t>(batch.points) + 3) * batch.columns(), Eight{});
}

/// True if each place of the batch's columns will be written.
bool Solver::is_full(std::size_t batch) const {
    const Batch& b = problem_.batches[batch];
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(b.patches); ++lane) {
        const Pair& pair = pair_at(batch, lane);
        if (static_cast<int>(pair.points) < b.points || pair.further_a < b.path_a.further ||
            (!b.scenery && pair.further_b < b.path_b.further))
            return false;
    }
    return b.patches == 8;
}

void Solver::put_places(const JointedPair& pair, std::size_t lane, const Batch& batch) {
    const auto put = [&](const JointedSide& side, const Path& path) {
        for (int k = side.path.within; k < side.path.count; ++k)
            problem_.places[path.first + static_cast<std::size_t>(k - side.path.within) * 8 + lane] =
                8 * side.slot + side.path.dofs[k];
    };
    put(pair.a, batch.path_a);
    if (pair.b.slot >= 0) put(pair.b, batch.path_b);
}

void Solver::put_columns(const JointedRow& row, const JointedPair& pair, std::size_t k, std::size_t lane,
                         const Batch& batch) {
    Eight* to = problem_.columns.data() + batch.first_column + k * batch.columns();
    const auto put = [&](const TreeRow& from, const JointedSide& side, std::size_t count) {
        const auto own = 6 + static_cast<std::size_t>(side.path.further());
        for (std::size_t c = 0; c < count; ++c) to[c].x[lane] = c < own ? from.x[c] : 0.0;
        to += count;
    };
    put(row.a, pair.a, batch.columns_a());
    if (!batch.scenery) put(row.b, pair.b, batch.columns_b());
}

Solver::FrictionRows Solver::put_jointed_friction(const Pair& pair, const Contact& contact,
                                                  const ContactFrame& frame, std::size_t lane,
                                                  const Batch& batch) {
    const JointedPair& sides = jointed_[pair.sides];
    const auto first = static_cast<std::size_t>(batch.points);
    JointedRow t1, t2, twist;
    set_row(sides, {frame.t1, pair.middle, false}, contact.shift_b, t1);
    set_row(sides, {frame.t2, pair.middle, false}, contact.shift_b, t2);
    set_row(sides, {frame.n, pair.middle, true}, contact.shift_b, twist);
    put_columns(t1, sides, first, lane, batch), put_columns(t2, sides, first + 1, lane, batch);
    put_columns(twist, sides, first + 2, lane, batch);
    return {product(t1, t1, sides), product(t1, t2, sides), product(t2, t2, sides),
            product(twist, twist, sides)};
}

}  // namespace roboss::soft
