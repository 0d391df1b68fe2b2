// Conditions of a loop joint. Translations are measured in the axes of A at the joint frame of B, so that
// each wrench is the exact derivative of its error and Newton's method closes a loop in a few steps.
#include "model/loop_closure.h"

#include <cmath>

#include "model/joint_motion.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

/// Both joint frames and how B moves against A.
class Relative {
  public:
    Relative(const LoopJoint& loop, const BodyKinematics& a, const BodyKinematics& b) : loop_(loop) {
        const Transform A = a.X_OB * loop.X_AJ, B = b.X_OB * loop.X_BJ;
        R_A_ = A.R, R_B_ = B.R;
        p_ = B.p, apart_ = B.p - A.p;
        w_A_ = a.velocity.angular, w_B_ = b.velocity.angular;
        turning_ = b.bias.angular - a.bias.angular;
        const Vec3 v_A = a.velocity.linear + cross(w_A_, p_), v_B = b.velocity.linear + cross(w_B_, p_);
        const Vec3 a_A = a.bias.linear + cross(a.bias.angular, p_) + cross(w_A_, v_A);
        const Vec3 a_B = b.bias.linear + cross(b.bias.angular, p_) + cross(w_B_, v_B);
        moving_ = a_B - a_A - cross(w_A_, v_B - v_A) * 2.0;
    }

    /// B's joint frame stays at A's in the direction u (A's axes).
    void keep_together(const Vec3& u_A) {
        const Vec3 u = R_A_ * u_A;
        ClosureRow& row = add(loop_.inverse_mass);
        row.error = dot(u, apart_);
        row.wrench = {cross(p_, u), u};
        row.curvature = dot(u, moving_);
    }

    /// a (fixed in B) times b (fixed in A) stays at `value`.
    void keep_product(const Vec3& a_B, const Vec3& b_A, double value) {
        ClosureRow& row = add(loop_.inverse_inertia);
        row.error = -value;
        add_product(row, a_B, b_A, 1.0);
    }

    /// No turn about the k-th axis, where there is none about the others either.
    void keep_angle(std::size_t k) {
        Vec3 x, y;
        x[(k + 1) % 3] = 1, y[(k + 2) % 3] = 1;
        ClosureRow& row = add(loop_.inverse_inertia);
        add_product(row, x, y, 0.5);
        add_product(row, y, x, -0.5);
    }

    /// The way along the screw's axis is its pitch times its angle, whatever the number of turns.
    void keep_thread(double angle) {
        const Vec3 u = R_A_ * loop_.axis_J;
        ClosureRow& row = add(loop_.inverse_mass + loop_.pitch * loop_.pitch * loop_.inverse_inertia);
        const double turn = 2.0 * kPi * loop_.pitch;
        const double error = dot(u, apart_) - loop_.pitch * angle;
        row.error = error - turn * std::floor(error / turn + 0.5);
        row.wrench = {cross(p_, u) - u * loop_.pitch, u};
        row.curvature = dot(u, moving_) - loop_.pitch * (dot(turning_, u) + dot(w_B_ - w_A_, cross(w_A_, u)));
    }

    ClosureRows rows;

  private:
    ClosureRow& add(double mobility) {
        ClosureRow& row = rows.rows[rows.count++];
        row.mobility = mobility;
        return row;
    }

    void add_product(ClosureRow& row, const Vec3& a_B, const Vec3& b_A, double factor) const {
        const Vec3 a = R_B_ * a_B, b = R_A_ * b_A;
        row.error += factor * dot(a, b);
        row.wrench.angular += cross(a, b) * factor;
        const Vec3 rate = cross(cross(w_B_, a), b) + cross(a, cross(w_A_, b));
        row.curvature += factor * (dot(turning_, cross(a, b)) + dot(w_B_ - w_A_, rate));
    }

    const LoopJoint& loop_;
    Mat3 R_A_, R_B_;
    Vec3 p_, apart_;         // B's joint frame from O; from A's
    Vec3 w_A_, w_B_;         // rad/s
    Vec3 turning_, moving_;  // acceleration of B's frame against A, seen from A, by the biases
};

/// Angle about the unit vector `axis` from x to y (both need not be at right angles to it).
double angle_about(const Vec3& axis, const Vec3& x, const Vec3& y) {
    const Vec3 side = cross(axis, x);
    return fixed_atan2(dot(side, y), dot(x, y) - dot(axis, x) * dot(axis, y));
}

double hinge_angle(const Vec3& axis_J, const Mat3& R_AJ, const Mat3& R_BJ) {
    Vec3 x, y;
    tangents(axis_J, x, y);
    return angle_about(R_AJ * axis_J, R_AJ * x, R_BJ * x);
}

Vec3 axis_of(const LoopJoint& loop, std::size_t k) {
    return k == 0 ? loop.axis_J : k == 1 ? loop.axis2_J : cross(loop.axis_J, loop.axis2_J);
}

/// What a joint leaves free, counted over the motions that it consists of.
struct Freedom {
    explicit Freedom(const LoopJoint& loop) : motions(joint_type(loop.kind).motions) {
        for (std::size_t k = 0; k < motions.size(); ++k) {
            const JointTraits& traits = joint_traits(motions[k]);
            if (traits.slides) ++slides, slide_axis = axis_of(loop, k);
            if (traits.turns) turns += traits.nv, turn_axis = axis_of(loop, k);
            has_pitch |= traits.has_pitch;
        }
    }
    std::span<const JointKind> motions;
    int slides = 0, turns = 0;
    bool has_pitch = false;
    Vec3 slide_axis, turn_axis;  // of the last one
};

void add_universal(const LoopJoint& loop, const Mat3& R_AJ, const Mat3& R_BJ, FreeDirections& out) {
    const Vec3 a1 = R_AJ * loop.axis_J, a2 = R_BJ * loop.axis2_J;
    const double slant = dot(a1, a2), inverse = 1.0 / (1.0 - slant * slant);
    out.directions[0] = {angle_about(a1, R_AJ * loop.axis2_J, a2), {(a1 - a2 * slant) * inverse, {}}};
    out.directions[1] = {-angle_about(a2, R_BJ * loop.axis_J, a1), {(a2 - a1 * slant) * inverse, {}}};
    out.count = 2;
}

}  // namespace

ClosureRows closure_rows(const LoopJoint& loop, const BodyKinematics& a, const BodyKinematics& b) {
    Relative relative(loop, a, b);
    const Freedom freedom(loop);
    Vec3 side, up;
    if (freedom.slides == 0) {
        for (const Vec3& u : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) relative.keep_together(u);
    } else if (freedom.slides == 1) {
        tangents(freedom.slide_axis, side, up);
        relative.keep_together(side), relative.keep_together(up);
    } else {
        relative.keep_together(cross(loop.axis_J, loop.axis2_J));
    }
    if (freedom.turns == 0) {
        for (std::size_t k = 0; k < 3; ++k) relative.keep_angle(k);
    } else if (freedom.turns == 1) {
        const Vec3& axis = freedom.turn_axis;
        tangents(axis, side, up);
        if (freedom.has_pitch)
            relative.keep_thread(hinge_angle(axis, a.X_OB.R * loop.X_AJ.R, b.X_OB.R * loop.X_BJ.R));
        relative.keep_product(axis, side, 0), relative.keep_product(axis, up, 0);
    } else if (freedom.turns == 2) {
        relative.keep_product(loop.axis2_J, loop.axis_J, dot(loop.axis_J, loop.axis2_J));
    }
    return relative.rows;
}

FreeDirections free_directions(const LoopJoint& loop, const Transform& X_OA, const Transform& X_OB) {
    const Transform A = X_OA * loop.X_AJ, B = X_OB * loop.X_BJ;
    const Freedom freedom(loop);
    FreeDirections out;
    if (freedom.turns == 2) {
        add_universal(loop, A.R, B.R, out);
    } else if (freedom.turns == 3) {
        const Vec3 turn = logarithm(to_quat(transpose(A.R) * B.R));
        for (std::size_t k = 0; k < 3; ++k) out.directions[k] = {turn[k], {A.R.col(k), {}}};
        out.count = 3;
    } else {
        for (const JointKind motion : freedom.motions) {
            const Vec3 axis_J = axis_of(loop, out.count), axis = A.R * axis_J;
            FreeDirection& direction = out.directions[out.count++];
            if (joint_traits(motion).turns)
                direction = {hinge_angle(axis_J, A.R, B.R), {axis, {}}};
            else
                direction = {dot(axis, B.p - A.p), {cross(B.p, axis), axis}};
        }
    }
    return out;
}

}  // namespace roboss
