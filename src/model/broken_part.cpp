// What compile guarantees and the step, the sensors and the orders rely on without looking again.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "model/accuracy.h"
#include "model/compile_type.h"
#include "model/joint_motion.h"
#include "model/seal.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

bool finite(const Transform& X) {
    return is_finite(X.p) && is_finite(X.R.r0) && is_finite(X.R.r1) && is_finite(X.R.r2);
}

/// The index of one of `count` things, or `none`.
bool within(int index, std::size_t count, int lowest = 0) {
    return index >= lowest && (index < 0 || static_cast<std::size_t>(index) < count);
}

bool sensible(const Shape& shape, bool scenery) {
    if (shape.kind > ShapeKind::kSurface || (shape.kind == ShapeKind::kHull) != (shape.hull != nullptr) ||
        (shape.kind == ShapeKind::kSurface) != (shape.surface != nullptr))
        return false;
    if (shape.kind == ShapeKind::kSurface && !scenery) return false;
    for (const double size : {shape.half.x, shape.half.y, shape.half.z, shape.radius, shape.half_length})
        if (!(size >= 0 && size < 1e9)) return false;
    return true;
}

bool sensible(const std::vector<double>& added_mass) {
    if (added_mass.empty()) return true;
    if (added_mass.size() != kAddedMassNumbers) return false;
    std::array<double, 36> matrix{};
    for (std::size_t i = 0, k = 0; i < 6; ++i)
        for (std::size_t j = i; j < 6; ++j) matrix[6 * i + j] = matrix[6 * j + i] = added_mass[k++];
    return std::ranges::all_of(matrix, [](double x) { return std::isfinite(x); }) &&
           is_positive_semidefinite(matrix.data());
}

bool sensible(const FluidLayers& fluid) {
    if (fluid.densities.empty()) return fluid.heights.empty();
    const auto finite = [](double x) { return std::isfinite(x); };
    return fluid.densities.size() == fluid.heights.size() + 1 &&
           std::ranges::all_of(fluid.densities, finite) && std::ranges::all_of(fluid.heights, finite) &&
           std::ranges::is_sorted(fluid.heights);
}

bool known(JointSpecKind kind) {
    return static_cast<std::size_t>(kind) < joint_types().size();
}

/// Coordinates and velocities of a joint in the tree.
struct Width {
    int q = 0, v = 0;
};

Width width_of(JointSpecKind kind) {
    Width width;
    for (const JointKind motion : joint_type(kind).motions)
        width.q += joint_traits(motion).nq, width.v += joint_traits(motion).nv;
    return width;
}

constexpr std::size_t kEntriesMax = 1u << 26;

/// One robot type, part by part; each question is asked when those before were answered.
class TypeCheck {
  public:
    explicit TypeCheck(const RobotType& type) : t_(type) {}

    std::string broken() const {
        if (!bodies_fit()) return "its bodies are no tree, or their coordinates do not follow each other";
        if (!coordinates_fit()) return "its coordinates do not fit its degrees of freedom";
        if (!links_fit()) return "a link stands on a body that is not there";
        if (!loops_fit()) return "a joint that closes a loop is impossible";
        if (!joints_fit()) return "a joint is impossible";
        if (!couplings_fit()) return "a gearbox couples coordinates that are not there";
        if (!shapes_fit()) return "a shape is impossible";
        if (!sensors_fit()) return "a sensor is impossible";
        if (!onboard_fits(t_)) return "an on-board controller is impossible";
        return {};
    }

  private:
    bool bodies_fit() const {
        int nq = 7, nv = 0;
        for (std::size_t i = 0; i < t_.bodies.size(); ++i) {
            const Body& body = t_.bodies[i];
            const bool base = t_.free_base && i == 0;
            if (!within(body.parent, i, -1) || !finite(body.X_PJ)) return false;
            if (base ? body.joint != JointKind::kFree || body.nv != 6 || body.q_index != 0
                     : body.joint == JointKind::kFree || body.joint > kLastJointKind || body.q_index != nq)
                return false;
            const JointTraits& traits = joint_traits(body.joint);
            if (body.v_index != nv || body.nv != traits.nv) return false;
            if (t_.free_base && !base && body.parent < 0) return false;
            nv += body.nv;
            nq += base ? 0 : traits.nq;
        }
        return (!t_.free_base || !t_.bodies.empty()) && nq == t_.nq && nv == t_.nv;
    }

    bool coordinates_fit() const {
        const auto nv = static_cast<std::size_t>(t_.nv);
        if (t_.dof_parent.size() != nv || t_.initial_q.size() + 7 != static_cast<std::size_t>(t_.nq))
            return false;
        if (t_.dofs.size() + static_cast<std::size_t>(t_.base_nv()) != nv) return false;
        std::size_t entries =
            0;  // of a matrix on the tree (dof_paths.h): a chain has the square of its length
        std::vector<std::size_t> depth(nv, 1);
        for (std::size_t i = 0; i < nv; ++i) {
            if (!within(t_.dof_parent[i], i, -1)) return false;
            if (t_.dof_parent[i] >= 0) depth[i] += depth[static_cast<std::size_t>(t_.dof_parent[i])];
            entries += depth[i];
        }
        if (entries > kEntriesMax) return false;
        for (std::size_t b = t_.free_base ? 1 : 0; b < t_.bodies.size(); ++b)
            for (int k = 0; k < t_.bodies[b].nv; ++k) {
                const Dof& dof = t_.dofs[static_cast<std::size_t>(t_.bodies[b].v_index + k - t_.base_nv())];
                if (dof.body != static_cast<int>(b) || dof.joint.index() >= t_.joints.size()) return false;
            }
        return true;
    }

    bool on_body(int body) const { return within(body, t_.bodies.size(), t_.free_base ? 0 : -1); }

    /// A link of the body, or the world, which is the fixed base's.
    bool on_link(int link, int body) const {
        return within(link, t_.links.size(), -1) &&
               (link < 0 ? body < 0 : t_.links[static_cast<std::size_t>(link)].body == body);
    }

    bool links_fit() const {
        return !t_.links.empty() && std::all_of(t_.links.begin(), t_.links.end(), [&](const Link& link) {
            return on_body(link.body) && finite(link.X_BL) && is_finite(link.p_BC) &&
                   within(link.carrier, t_.joints.size(), -1) && hangs_on_a_root(link);
        });
    }

    /// Its way to the root has an end.
    bool hangs_on_a_root(const Link& link) const {
        int parent = link.parent;
        for (std::size_t steps = 0; parent != -1; ++steps) {
            if (!within(parent, t_.links.size()) || steps == t_.links.size()) return false;
            parent = t_.links[static_cast<std::size_t>(parent)].parent;
        }
        return true;
    }

    bool loops_fit() const {
        std::size_t motors = t_.dofs.size();
        for (std::size_t i = 0; i < t_.loops.size(); ++i) {
            const LoopJoint& loop = t_.loops[i];
            if (!known(loop.kind) || loop.joint.index() >= t_.joints.size()) return false;
            if (t_.joints[loop.joint.index()].loop != static_cast<int>(i)) return false;
            if (!on_body(loop.body_a) || !on_body(loop.body_b) || loop.body_a == loop.body_b) return false;
            if (!on_link(loop.link_a, loop.body_a) || !on_link(loop.link_b, loop.body_b)) return false;
            if (!finite(loop.X_AJ) || !finite(loop.X_BJ)) return false;
            if (loop.dofs.size() != static_cast<std::size_t>(width_of(loop.kind).v)) return false;
            if (loop.motor_index < 0 || static_cast<std::size_t>(loop.motor_index) != motors) return false;
            for (const Dof& dof : loop.dofs)
                if (dof.body != loop.body_b || dof.joint != loop.joint) return false;
            motors += loop.dofs.size();
        }
        return true;
    }

    bool joints_fit() const {
        for (std::size_t i = 0; i < t_.joints.size(); ++i) {
            const Joint& joint = t_.joints[i];
            if (!known(joint.kind) || !within(joint.body, t_.bodies.size(), -1) || !is_finite(joint.p_BJ))
                return false;
            if (joint.loop != -1) {
                if (!within(joint.loop, t_.loops.size())) return false;
                const LoopJoint& loop = t_.loops[static_cast<std::size_t>(joint.loop)];
                if (loop.joint != JointId(i) || joint.nv != static_cast<int>(loop.dofs.size())) return false;
            } else if (!tree_joint_fits(joint)) {
                return false;
            }
        }
        return true;
    }

    bool tree_joint_fits(const Joint& joint) const {
        if (joint.nv == 0) return true;
        const Width width = width_of(joint.kind);
        if (joint.nv != width.v || joint.body < 0) return false;
        if (joint.v_index < t_.base_nv() || joint.v_index > t_.nv - joint.nv) return false;
        return joint.q_index >= 7 && joint.q_index <= t_.nq - width.q;
    }

    bool couplings_fit() const {
        return std::all_of(t_.couplings.begin(), t_.couplings.end(), [&](const CoordinateCoupling& c) {
            return c.joint.index() < t_.joints.size() && within(c.follower, t_.dofs.size()) &&
                   within(c.leader, t_.dofs.size());
        });
    }

    bool shapes_fit() const {
        for (const BodyShape& s : t_.shapes)
            if (!on_body(s.body) || !within(s.direction_body, t_.bodies.size(), -1) ||
                s.link.index() >= t_.links.size() || !finite(s.X_BS) || !sensible(s.shape, false))
                return false;
        for (const LinkDrag& drag : t_.drags)
            if (drag.link.index() >= t_.links.size() || t_.links[drag.link.index()].body < 0) return false;
        for (const LinkFluid& fluid : t_.fluids)
            if (fluid.link.index() >= t_.links.size() || t_.links[fluid.link.index()].body < 0 ||
                !sensible(fluid.added_mass))
                return false;
        if (!t_.scenery.empty() &&
            (!t_.is_static || !is_finite(t_.scenery.min) || !is_finite(t_.scenery.max)))
            return false;
        if (t_.kinematic && (t_.free_base || t_.nv > 0)) return false;
        for (const auto& [a, b] : t_.self_pairs)
            if (!within(a, t_.shapes.size()) || !within(b, t_.shapes.size()) || a == b) return false;
        return true;
    }

    bool sensors_fit() const {
        return std::all_of(t_.sensors.begin(), t_.sensors.end(), [&](const SensorInfo& info) {
            return info.link.index() < t_.links.size() && problems_of(info.spec).empty();
        });
    }

    const RobotType& t_;
};

std::string broken_static(const Model& model, const StaticShape& s) {
    if (!sensible(s.shape, true) || !finite(s.X_WS)) return "is impossible";
    for (const Vec3& v : {s.flow.linear, s.flow.angular, s.flow.belt, s.flow.at})
        if (!is_finite(v)) return "moves with a velocity that is not finite";
    if (!s.robot.valid()) return s.driven ? "is moved by a robot that is not there" : "";
    if (s.robot.index() >= model.robots.size()) return "belongs to a robot that is not there";
    return s.link.index() < model.type_of(s.robot).links.size() ? "" : "belongs to a link that is not there";
}

/// A start of its own has a number for each coordinate or velocity.
bool start_fits(const Robot& robot, const RobotType& type) {
    const auto finite_numbers = [](const std::vector<double>& all) {
        return std::all_of(all.begin(), all.end(), [](double x) { return std::isfinite(x); });
    };
    return (robot.start_q.empty() || robot.start_q.size() == type.initial_q.size()) &&
           (robot.start_v.empty() || robot.start_v.size() == static_cast<std::size_t>(type.nv)) &&
           finite_numbers(robot.start_q) && finite_numbers(robot.start_v);
}

bool accuracy_fits(const Accuracy& accuracy) {
    const auto numbers = accuracy_numbers();
    return std::all_of(numbers.begin(), numbers.end(), [&](const AccuracyNumber& number) {
        return number.get(accuracy) >= number.low && number.get(accuracy) <= number.high;
    });
}

}  // namespace

std::string broken_part(const Model& model) {
    if (!(model.dt_s > 0 && model.dt_s <= 1)) return "its step is not in (0, 1] s";
    if (!is_finite(model.gravity) || !is_finite(model.wind)) return "its gravity or wind is not finite";
    if (!sensible(model.fluid)) return "its fluids have no layers";
    if (!accuracy_fits(model.accuracy)) return "its accuracy is out of range";
    if (model.precision > Precision::kFloat) return "its precision is unknown";
    for (const RobotType& type : model.types)
        if (const std::string broken = TypeCheck(type).broken(); !broken.empty())
            return "robot type '" + type.name + "': " + broken;
    for (const Robot& robot : model.robots) {
        if (robot.type.index() >= model.types.size()) return "robot '" + robot.name + "' has no type";
        if (!is_finite(robot.X_WR)) return "robot '" + robot.name + "' stands nowhere";
        if (!start_fits(robot, model.types[robot.type.index()]))
            return "robot '" + robot.name + "' has an impossible start";
    }
    for (const StaticShape& s : model.statics)
        if (const std::string broken = broken_static(model, s); !broken.empty())
            return "scenery '" + s.name + "' " + broken;
    return {};
}

}  // namespace roboss
