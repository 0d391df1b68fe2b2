// Mass properties of a link.
#include <algorithm>
#include <array>
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

/// SDFormat 1.10: the mass of the water that moves with the link.
void read_added_mass(const Element& inertial, const Import& import, LinkSpec& spec) {
    const Element added = inertial.child("fluid_added_mass");
    if (!added) return;
    constexpr char kAxes[] = {'x', 'y', 'z', 'p', 'q', 'r'};
    std::vector<double> numbers;
    std::array<double, 36> matrix{};
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = i; j < 6; ++j) {
            const std::string name{kAxes[i], kAxes[j]};
            numbers.push_back(import.reader.number(added, name.c_str(), 0));
            matrix[6 * i + j] = matrix[6 * j + i] = numbers.back();
        }
    if (std::ranges::all_of(numbers, [](double x) { return x == 0; })) return;
    if (is_positive_semidefinite(matrix.data())) {
        spec.added_mass = std::move(numbers);
        return;
    }
    import.diagnostics().warning(
        added.where(), "added-mass",
        "the <fluid_added_mass> of link '" + spec.name + "' would give negative energy; it is left out",
        "Write a positive (semi-)definite matrix.");
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
    read_added_mass(inertial, import, spec);
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
