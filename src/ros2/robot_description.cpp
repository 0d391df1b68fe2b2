// See robot_description.h.
#include "ros2/robot_description.h"

#include <array>
#include <charconv>
#include <cmath>

#include "core/markup.h"
#include "model/robot_state.h"
#include "world/joint_kind.h"

namespace roboss::ros2 {

namespace {

std::string text(double number) {
    std::array<char, 32> digits;
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number + 0.0);
    return std::string(digits.data(), error == std::errc() ? end : digits.data());
}
std::string text(const Vec3& v) {
    return text(v.x) + " " + text(v.y) + " " + text(v.z);
}
std::string quoted(const std::string& name) {
    return "\"" + escaped(name) + "\"";
}

/// Roll, pitch and yaw about fixed axes, rad.
Vec3 rpy(const Mat3& R) {
    const double across = std::hypot(R(0, 0), R(1, 0)), pitch = std::atan2(-R(2, 0), across);
    if (across < 1e-9) return {0, pitch, std::atan2(-R(0, 1), R(1, 1))};  // roll and yaw turn about one axis
    return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}
std::string origin(const Transform& X) {
    return "<origin xyz=\"" + text(X.p) + "\" rpy=\"" + text(rpy(X.R)) + "\"/>";
}
bool is_identity(const Transform& X) {
    return X.p == Vec3{} && rpy(X.R) == Vec3{};
}

/// The shape as URDF has it, at its pose in the link; several: a capsule; none: URDF has no such shape.
std::vector<std::string> geometries(const Shape& shape, const Transform& X_LS) {
    const auto placed = [&](const Vec3& p_S, const std::string& geometry) {
        return origin(X_LS * Transform{Mat3::identity(), p_S}) + "<geometry>" + geometry + "</geometry>";
    };
    const std::string sphere = "<sphere radius=\"" + text(shape.radius) + "\"/>";
    const std::string cylinder =
        "<cylinder radius=\"" + text(shape.radius) + "\" length=\"" + text(2 * shape.half_length) + "\"/>";
    const Vec3 end{0, 0, shape.half_length};
    switch (shape.kind) {
        case ShapeKind::kSphere:
            return {placed({}, sphere)};
        case ShapeKind::kBox:
            return {placed({}, "<box size=\"" + text(2.0 * shape.half) + "\"/>")};
        case ShapeKind::kCylinder:
            return {placed({}, cylinder)};
        case ShapeKind::kCapsule:
            return {placed({}, cylinder), placed(end, sphere), placed(-1.0 * end, sphere)};
        case ShapeKind::kPlane:
        case ShapeKind::kEllipsoid:
        case ShapeKind::kHull:
        case ShapeKind::kSurface:
            break;
    }
    return {};
}

class Writer {
  public:
    Writer(const RobotType& type, const std::vector<std::string>& frames) : type_(type), frames_(frames) {}

    std::string write(const std::string& name, const Transform& X_WB) {
        out_ = "<?xml version=\"1.0\"?>\n<robot name=" + quoted(name) + ">\n";
        if (!type_.free_base) out_ += "  <link name=\"world\"/>\n";
        for (std::size_t l = 0; l < type_.links.size(); ++l) add_link(l);
        const std::string world = "world";
        for (std::size_t l = 0; l < type_.links.size(); ++l) {
            const int parent = type_.links[l].parent;
            if (parent >= 0) {
                const Link& from = type_.links[static_cast<std::size_t>(parent)];
                add_joints(l, {frames_[static_cast<std::size_t>(parent)], from.body, inverse(from.X_BL)});
            } else if (!type_.free_base) {
                add_joints(l, {world, -1, X_WB});
            }
        }
        return out_ + "</robot>\n";
    }

  private:
    /// A link on which a joint hangs.
    struct Holder {
        const std::string& link;  // its name
        int body;                 // -1: the fixed base
        Transform X_LB;           // the body in the link
    };

    const std::vector<Body>& bodies() const { return type_.bodies; }

    void add_link(std::size_t l) {
        const Link& link = type_.links[l];
        out_ += "  <link name=" + quoted(frames_[l]) + ">\n";
        if (link.mass > 0) {
            const Transform X_LB = inverse(link.X_BL);
            const Mat3& I = link.inertia_C;
            out_ += "    <inertial>" + origin({X_LB.R, X_LB * link.p_BC}) + "<mass value=\"" +
                    text(link.mass) + "\"/><inertia ixx=\"" + text(I(0, 0)) + "\" ixy=\"" + text(I(0, 1)) +
                    "\" ixz=\"" + text(I(0, 2)) + "\" iyy=\"" + text(I(1, 1)) + "\" iyz=\"" + text(I(1, 2)) +
                    "\" izz=\"" + text(I(2, 2)) + "\"/></inertial>\n";
        }
        for (const BodyShape& shape : type_.shapes) {
            if (shape.link.index() != l) continue;
            for (const std::string& geometry : geometries(shape.shape, inverse(link.X_BL) * shape.X_BS))
                for (const char* element : {"visual", "collision"})
                    out_ += std::string("    <") + element + ">" + geometry + "</" + element + ">\n";
        }
        out_ += "  </link>\n";
    }

    void add_joint(const std::string& name, const char* kind, const std::string& parent,
                   const std::string& child, const Transform& X_PC, const std::string& more) {
        out_ += "  <joint name=" + quoted(name) + " type=\"" + kind + "\"><parent link=" + quoted(parent) +
                "/><child link=" + quoted(child) + "/>" + origin(X_PC) + more + "</joint>\n";
    }

    /// The joint between a link and its parent: one of URDF for each body that it moves, and a fixed one
    /// where the link is not where its body is.
    void add_joints(std::size_t l, const Holder& from) {
        const Link& link = type_.links[l];
        const std::string name = link.carrier < 0 ? frames_[l] + "_mount"
                                                  : type_.joints[static_cast<std::size_t>(link.carrier)].name;
        if (link.body == from.body) {
            add_joint(name, "fixed", from.link, frames_[l], from.X_LB * link.X_BL, "");
            return;
        }
        std::vector<int> chain;  // bodies from the one it hangs on, which is not in it, to the link's
        for (int body = link.body; body != from.body; body = bodies()[static_cast<std::size_t>(body)].parent)
            chain.insert(chain.begin(), body);
        const bool is_there = is_identity(link.X_BL);
        std::string at = from.link;
        Transform X = from.X_LB;
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const Body& body = bodies()[static_cast<std::size_t>(chain[i])];
            const bool is_last = i + 1 == chain.size();
            const std::string next =
                is_last && is_there ? frames_[l] : frames_[l] + "_axis_" + std::to_string(i + 1);
            if (!is_last || !is_there) out_ += "  <link name=" + quoted(next) + "/>\n";
            const std::string own = chain.size() == 1 ? name : name + "_" + std::to_string(i + 1);
            add_joint(own, kind_of(body), at, next, X * body.X_PJ, axis_of(body));
            at = next, X = {};
        }
        if (!is_there) add_joint(frames_[l] + "_mount", "fixed", at, frames_[l], link.X_BL, "");
    }

    const Dof& dof_of(const Body& body) const {
        return type_.dofs[static_cast<std::size_t>(body.v_index - type_.base_nv())];
    }
    const char* kind_of(const Body& body) const {
        if (body.joint == JointKind::kPrismatic) return "prismatic";
        if (body.joint != JointKind::kRevolute) return "floating";
        const Dof& dof = dof_of(body);
        return std::isfinite(dof.lower) && std::isfinite(dof.upper) ? "revolute" : "continuous";
    }
    std::string axis_of(const Body& body) const {
        if (body.joint != JointKind::kPrismatic && body.joint != JointKind::kRevolute) return "";
        const Dof& dof = dof_of(body);
        const auto bounded = [](double value) { return text(std::isfinite(value) ? value : 1e9); };
        std::string more = "<axis xyz=\"" + text(body.axis_J) + "\"/><limit ";
        if (std::string_view(kind_of(body)) != "continuous")
            more += "lower=\"" + text(std::max(dof.lower, -1e9)) + "\" upper=\"" +
                    text(std::min(dof.upper, 1e9)) + "\" ";
        more += "effort=\"" + bounded(dof.max_effort) + "\" velocity=\"" + bounded(dof.max_velocity) + "\"/>";
        if (dof.damping != 0 || dof.friction != 0)
            more +=
                "<dynamics damping=\"" + text(dof.damping) + "\" friction=\"" + text(dof.friction) + "\"/>";
        for (const CoordinateCoupling& coupling : type_.couplings)
            if (&type_.dofs[static_cast<std::size_t>(coupling.follower)] == &dof && !coupling.is_curved())
                more += "<mimic joint=" + quoted(name_of(coupling.leader)) + " multiplier=\"" +
                        text(coupling.multiplier) + "\" offset=\"" + text(coupling.offset) + "\"/>";
        return more;
    }
    std::string name_of(int dof) const {
        return type_.joints[type_.dofs[static_cast<std::size_t>(dof)].joint.index()].name;
    }

    const RobotType& type_;
    const std::vector<std::string>& frames_;
    std::string out_;
};

}  // namespace

std::string urdf_of(const Model& model, RobotId robot, const std::string& name,
                    const std::vector<std::string>& frames) {
    const RobotType& type = model.type_of(robot);
    return Writer(type, frames).write(name, to_transform(base_pose(initial_state(model, robot))));
}

}  // namespace roboss::ros2
