// <inertial>.
#include "mjcf/orientation.h"
#include "mjcf/principal.h"
#include "mjcf/tree.h"

namespace roboss::mjcf {

Mass read_inertial(const Attributes& inertial, const Scope& scope, const Reading& reading) {
    if (!inertial.has("mass"))
        reading.diagnostics.error(inertial.where(), "missing-inertia", "<inertial> has no mass",
                                  "Write its mass.");
    const Pose X = scope.X_BF * read_pose(inertial, reading.settings);
    Mass mass;
    mass.mass = inertial.number("mass", 0);
    mass.centre = X.p;
    double full[6];
    Vec3 moments;
    if (inertial.has("fullinertia")) {
        if (!inertial.numbers("fullinertia", full)) return mass;
        const Mat3 I{{full[0], full[3], full[4]}, {full[3], full[1], full[5]}, {full[4], full[5], full[2]}};
        const Mat3 R = to_matrix(X.q);
        mass.inertia = R * I * transpose(R);
        return mass;
    }
    if (!inertial.has("diaginertia") && mass.mass > 0) {
        // As in MuJoCo, a body that stands still on another one may be a point.
        const auto body = inertial.element().node.parent();
        const bool moves = body.child("joint") || body.child("freejoint");
        reading.diagnostics.add({moves ? Severity::kError : Severity::kWarning, inertial.where(),
                                 "missing-inertia", "<inertial> has neither diaginertia nor fullinertia",
                                 "Write the moments of inertia about the centre of mass."});
    }
    moments = inertial.vector("diaginertia", {});
    mass.inertia = from_principal(moments, X.q);
    return mass;
}

}  // namespace roboss::mjcf
