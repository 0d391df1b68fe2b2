// Mass properties of a link.
#include <cstring>

#include "sdf/automatic_inertia.h"
#include "sdf/conversion.h"

namespace roboss::sdf_import {
namespace {

Mat3 rotated(const Mat3& inertia, const Quat& q) {
    const Mat3 R = to_matrix(q);
    return R * inertia * transpose(R);
}

Mat3 read_inertia(const Element& inertia, const ElementReader& reader) {
    const double xx = reader.number(inertia, "ixx", 1), yy = reader.number(inertia, "iyy", 1);
    const double zz = reader.number(inertia, "izz", 1), xy = reader.number(inertia, "ixy", 0);
    const double xz = reader.number(inertia, "ixz", 0), yz = reader.number(inertia, "iyz", 0);
    return {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
}

void read_automatic(const Element& link, const PoseInLink& pose_of, const Import& import, LinkSpec& spec) {
    const Element inertial = link.child("inertial");
    const auto automatic = automatic_inertia(link, pose_of, import);
    if (!automatic) {
        import.diagnostics().warning(
            inertial.where(), "automatic-inertia",
            "link '" + spec.name +
                "' asks for automatic inertia, but none of its collisions has a "
                "volume that is known; SDF's default is used: 1 kg, 1 kg m^2 about each axis",
            "Write its <mass> and <inertia>.");
        return;
    }
    spec.mass = automatic->mass;
    spec.p_LC = automatic->centre;
    spec.inertia_C = automatic->inertia;
    const double mass = import.reader.number(inertial, "mass", 0);
    if (mass > 0) {  // SDFormat 1.12: a given mass scales what the density gave
        spec.inertia_C = spec.inertia_C * (mass / spec.mass);
        spec.mass = mass;
    }
    import.diagnostics().note(inertial.where(), "automatic-inertia",
                              "mass and inertia of link '" + spec.name +
                                  "' are computed from its collisions: " + std::to_string(spec.mass) + " kg");
}

}  // namespace

void convert_inertial(const Element& link, const PoseInLink& pose_of, const Import& import, LinkSpec& spec) {
    const Element inertial = link.child("inertial");
    if (!inertial) {
        import.diagnostics().warning(link.where(), "missing-inertia",
                                     "link '" + spec.name +
                                         "' has no <inertial>; SDF's default is used, as in Gazebo: "
                                         "1 kg, 1 kg m^2 about each axis",
                                     "Write its <inertial> with <mass> and <inertia>.");
        return;
    }
    if (inertial.node.attribute("auto").as_bool()) return read_automatic(link, pose_of, import, spec);
    const Pose X_LI = import.reader.pose(inertial.child("pose"));
    spec.mass = import.reader.number(inertial, "mass", 1.0);
    spec.p_LC = X_LI.p;
    const Element inertia = inertial.child("inertia");
    if (!inertial.child("mass") || !inertia) {
        import.diagnostics().warning(
            inertial.where(), "missing-inertia",
            "link '" + spec.name + "' has no <" + (inertia ? "mass" : "inertia") +
                ">; SDF's default is used, as in Gazebo: " + (inertia ? "1 kg" : "1 kg m^2 about each axis"),
            "Write both <mass> and <inertia>.");
    }
    if (inertia) spec.inertia_C = rotated(read_inertia(inertia, import.reader), X_LI.q);
}

}  // namespace roboss::sdf_import
