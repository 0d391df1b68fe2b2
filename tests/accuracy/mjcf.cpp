// See mjcf.h. All numbers with 17 digits, so that both engines start from the same bits.
#include "mjcf.h"

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <utility>

#include "math/quat.h"
#include "world/joint_type.h"

namespace roboss::test {
namespace {

std::string numbers(std::initializer_list<double> values) {
    std::string text;
    char buffer[40];
    for (double x : values) {
        std::snprintf(buffer, sizeof buffer, "%.17g ", x);
        text += buffer;
    }
    return text;
}

std::string attribute(const char* name, std::initializer_list<double> values) {
    return std::string(" ") + name + "=\"" + numbers(values) + "\"";
}

/// Principal axes of an inertia by Jacobi's rotations to the last digit. MuJoCo's own diagonalisation of
/// `fullinertia` stops at angles of 1e-6, which would cost the comparison seven digits.
Mat3 principal_axes(Mat3 m) {
    Mat3 V = Mat3::identity();
    for (int sweep = 0; sweep < 20; ++sweep) {
        for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
            if (m(i, j) == 0) continue;
            const double angle = 0.5 * std::atan2(2 * m(i, j), m(i, i) - m(j, j));
            Mat3 R = Mat3::identity();
            R(i, i) = R(j, j) = std::cos(angle);
            R(j, i) = std::sin(angle);
            R(i, j) = -R(j, i);
            m = transpose(R) * m * R;
            V = V * R;
        }
    }
    return V;
}

std::string inertial(const LinkSpec& l) {
    const Mat3 V = principal_axes(l.inertia_C);
    const Mat3 d = transpose(V) * l.inertia_C * V;
    const Quat q = to_quat(V);
    return "<inertial" + attribute("mass", {l.mass}) + attribute("pos", {l.p_LC.x, l.p_LC.y, l.p_LC.z}) +
           attribute("quat", {q.w, q.x, q.y, q.z}) + attribute("diaginertia", {d(0, 0), d(1, 1), d(2, 2)}) +
           "/>\n";
}

class Writer {
  public:
    Writer(const ModelSpec& model, const Pose& X_WM) : model_(model), X_WM_(X_WM) {}

    std::string bodies() {
        bool fixed = false;
        for (const JointSpec& j : model_.joints) fixed |= j.parent == "world";
        if (!fixed) body(root(), nullptr, X_WM_);
        children("world", X_WM_);
        return text_;
    }

  private:
    const LinkSpec& find(const std::string& name) const {
        for (const LinkSpec& l : model_.links)
            if (l.name == name) return l;
        return model_.links.front();
    }

    const LinkSpec& root() const { return find(model_.canonical_link); }

    /// Writes the links that joints hang on `parent`; X_PM: the model frame in the parent's, all joints at
    /// zero.
    void children(const std::string& parent, const Pose& X_PM) {
        for (const JointSpec& j : model_.joints)
            if (j.parent == parent) body(find(j.child), &j, X_PM);
    }

    void body(const LinkSpec& l, const JointSpec* j, const Pose& X_PM) {
        const Pose X = X_PM * l.X_ML;
        text_ += "<body name=\"" + l.name + "\"" + attribute("pos", {X.p.x, X.p.y, X.p.z}) +
                 attribute("quat", {X.q.w, X.q.x, X.q.y, X.q.z}) + ">\n";
        if (j == nullptr) {
            text_ += "<freejoint name=\"base\"/>\n";
        } else {
            joints(l, *j);
        }
        text_ += inertial(l);
        children(l.name, inverse(l.X_ML));
        text_ += "</body>\n";
    }

    void joints(const LinkSpec& l, const JointSpec& j) {
        if (j.kind == JointSpecKind::kFixed) return;
        const Pose X_LJ = inverse(l.X_ML) * j.X_MJ;
        const std::string pos = attribute("pos", {X_LJ.p.x, X_LJ.p.y, X_LJ.p.z});
        if (j.kind == JointSpecKind::kBall) {
            text_ += "<joint type=\"ball\" name=\"" + j.name + "\"" + pos + "/>\n";
            return;
        }
        for (std::size_t a = 0; a < j.axes.size(); ++a) {
            const AxisSpec& axis = j.axes[a];
            const Vec3 d = rotate(X_LJ.q, axis.xyz);
            const char* type = j.kind == JointSpecKind::kPrismatic ? "slide" : "hinge";
            text_ += std::string("<joint type=\"") + type + "\" name=\"" + j.name + (a > 0 ? "_1" : "") +
                     "\"" + pos + attribute("axis", {d.x, d.y, d.z}) + attribute("damping", {axis.damping}) +
                     attribute("armature", {axis.armature}) +
                     attribute("stiffness", {axis.spring_stiffness}) +
                     attribute("springref", {axis.spring_reference}) + "/>\n";
        }
    }

    const ModelSpec& model_;
    const Pose& X_WM_;
    std::string text_;
};

}  // namespace

std::string to_mjcf(const ModelSpec& model, const Pose& X_WM, const Vec3& gravity) {
    return "<mujoco>\n<compiler angle=\"radian\" balanceinertia=\"false\" boundmass=\"0\" "
           "boundinertia=\"0\"/>\n<option" +
           attribute("gravity", {gravity.x, gravity.y, gravity.z}) +
           "><flag contact=\"disable\"/></option>\n<worldbody>\n" + Writer(model, X_WM).bodies() +
           "</worldbody>\n</mujoco>\n";
}

}  // namespace roboss::test
