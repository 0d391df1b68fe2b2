// See assembly.h.
#include "engines/assembly.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "core/check.h"
#include "core/union_find.h"

namespace roboss::bench {
namespace {

constexpr int kUnplaced = -2;

class Assembler {
  public:
    explicit Assembler(const ModelSpec& model)
        : model_(model), used_(model.joints.size(), 0), closes_(loop_closers(model)) {
        assembly_.body_of_link.assign(model.links.size(), kUnplaced);
        assembly_.X_BL.resize(model.links.size());
    }

    Assembly build() {
        if (model_.is_static) {
            for (std::size_t l = 0; l < model_.links.size(); ++l) put(l, -1);
        } else {
            walk("world", -1);
            place_free(true), place_free(false);
        }
        return std::move(assembly_);
    }

  private:
    /// Bodies that hang on nothing placed: first those that are no joint's child, then what is left (rings).
    void place_free(bool only_roots) {
        for (std::size_t l = 0; l < model_.links.size(); ++l) {
            if (assembly_.body_of_link[l] != kUnplaced) continue;
            if (only_roots && is_child(model_.links[l].name)) continue;
            put(l, add_body(l));
            walk(model_.links[l].name, assembly_.body_of_link[l]);
        }
    }

    /// By joint. Of a loop the last joint in the file closes it, but no fixed one where there is another: so
    /// a file tells all engines the same tree, however deep depth-first search would make it.
    static std::vector<char> loop_closers(const ModelSpec& model) {
        std::map<std::string, std::uint32_t> nodes{{"world", 0}};
        for (const LinkSpec& link : model.links)
            nodes.emplace(link.name, static_cast<std::uint32_t>(nodes.size()));
        UnionFind joined;
        joined.reset(nodes.size());
        std::vector<char> closes(model.joints.size(), 0);
        for (const bool fixed : {true, false}) {
            for (std::size_t j = 0; j < model.joints.size(); ++j) {
                const JointSpec& joint = model.joints[j];
                if (joint.kind == JointSpecKind::kGearbox || (joint.kind == JointSpecKind::kFixed) != fixed)
                    continue;
                const std::uint32_t a = nodes.at(joint.parent), b = nodes.at(joint.child);
                closes[j] = joined.find(a) == joined.find(b) ? 1 : 0;
                joined.unite(a, b);
            }
        }
        return closes;
    }

    bool is_child(const std::string& name) const {
        for (const JointSpec& joint : model_.joints)
            if (joint.child == name && joint.kind != JointSpecKind::kGearbox) return true;
        return false;
    }

    std::size_t find(const std::string& name) const {
        for (std::size_t l = 0; l < model_.links.size(); ++l)
            if (model_.links[l].name == name) return l;
        ROBOSS_CHECK(false, "no link " + name);
    }

    int add_body(std::size_t link) {
        PartBody body;
        body.name = model_.links[link].name;
        body.X_MB = model_.links[link].X_ML;
        body.inertia_C = Mat3::diagonal(0, 0, 0);
        assembly_.bodies.push_back(body);
        return static_cast<int>(assembly_.bodies.size()) - 1;
    }

    /// Everything that joints hang on the link `name` of `body`, depth first.
    void walk(const std::string& name, int body) {
        for (std::size_t j = 0; j < model_.joints.size(); ++j) {
            const JointSpec& joint = model_.joints[j];
            const bool forward = joint.parent == name, backward = joint.child == name;
            if (used_[j] || joint.kind == JointSpecKind::kGearbox || !(forward || backward)) continue;
            const std::string& other = forward ? joint.child : joint.parent;
            const bool closes = closes_[j] != 0;
            if (other == "world") {
                used_[j] = 1;
                assembly_.joints.push_back({&joint, j, body, -1, true, true});
                continue;
            }
            const std::size_t link = find(other);
            if (closes && assembly_.body_of_link[link] == kUnplaced) continue;  // it is met again from there
            used_[j] = 1;
            if (joint.kind == JointSpecKind::kFixed && !closes) {
                put(link, body);
            } else {
                if (!closes) {
                    put(link, add_body(link));
                    assembly_.bodies.back().joint = static_cast<int>(assembly_.joints.size());
                }
                assembly_.joints.push_back({&joint, j, body, assembly_.body_of_link[link], backward, closes});
            }
            if (!closes) walk(other, assembly_.body_of_link[link]);
        }
    }

    /// Makes the link part of the body: mass, inertia, shapes.
    void put(std::size_t l, int b) {
        const LinkSpec& link = model_.links[l];
        assembly_.body_of_link[l] = b;
        const Pose X_BL =
            b < 0 ? link.X_ML : inverse(assembly_.bodies[static_cast<std::size_t>(b)].X_MB) * link.X_ML;
        assembly_.X_BL[l] = X_BL;
        auto& shapes = b < 0 ? assembly_.scenery : assembly_.bodies[static_cast<std::size_t>(b)].shapes;
        for (const CollisionSpec& c : link.collisions) shapes.push_back({&c, X_BL * c.X_LS});
        if (b >= 0) add_mass(assembly_.bodies[static_cast<std::size_t>(b)], link, X_BL);
    }

    static Mat3 steiner(double mass, const Vec3& d) {
        const double dd = norm_squared(d);
        return Mat3{{dd - d.x * d.x, -d.x * d.y, -d.x * d.z},
                    {-d.x * d.y, dd - d.y * d.y, -d.y * d.z},
                    {-d.x * d.z, -d.y * d.z, dd - d.z * d.z}} *
               mass;
    }

    static void add_mass(PartBody& body, const LinkSpec& link, const Pose& X_BL) {
        const double total = body.mass + link.mass;
        if (total <= 0) return;
        const Vec3 p = X_BL * link.p_LC;
        const Vec3 centre = (body.p_BC * body.mass + p * link.mass) / total;
        const Mat3 R = to_matrix(X_BL.q);
        body.inertia_C = body.inertia_C + steiner(body.mass, body.p_BC - centre) +
                         R * link.inertia_C * transpose(R) + steiner(link.mass, p - centre);
        body.p_BC = centre;
        body.mass = total;
        body.gravity = body.gravity && link.gravity;
    }

    const ModelSpec& model_;
    std::vector<char> used_, closes_;
    Assembly assembly_;
};

/// Motion of the child frame of one axis: rotation about, or shift along it.
struct AxisMotion {
    bool slides = false;
    Vec3 axis_J;
    JointState state;
};

std::vector<AxisMotion> motions(const PartJoint& joint, const StartState& start) {
    std::vector<AxisMotion> result;
    const JointSpec& spec = *joint.spec;
    for (std::size_t a = 0; a < spec.axes.size(); ++a) {
        const std::size_t pick = joint.reversed ? spec.axes.size() - 1 - a : a;
        const Vec3 axis = joint.reversed ? -spec.axes[pick].xyz : spec.axes[pick].xyz;
        result.push_back({spec.kind == JointSpecKind::kPrismatic, axis, start.joints[joint.index][pick]});
    }
    return result;
}

}  // namespace

Assembly assemble(const ModelSpec& model) {
    return Assembler(model).build();
}

StartState start_state(const ModelSpec& model, const Pose& X_WM) {
    StartState start;
    start.X_WM = X_WM;
    for (const JointSpec& joint : model.joints) {
        start.joints.emplace_back(joint.axes.size());
        for (std::size_t a = 0; a < joint.axes.size(); ++a)
            start.joints.back()[a].position = joint.axes[a].initial_position;
    }
    return start;
}

std::vector<BodyState> forward_kinematics(const Assembly& assembly, const StartState& start) {
    std::vector<BodyState> states(assembly.bodies.size());
    for (std::size_t b = 0; b < assembly.bodies.size(); ++b) {
        const PartBody& body = assembly.bodies[b];
        if (body.joint < 0) {
            states[b] = {start.X_WM * body.X_MB, start.angular, start.linear};
            continue;
        }
        const PartJoint& joint = assembly.joints[static_cast<std::size_t>(body.joint)];
        const bool on_world = joint.parent < 0;
        const auto parent = static_cast<std::size_t>(joint.parent);
        const Pose X_MP = on_world ? Pose{} : assembly.bodies[parent].X_MB;
        const Pose X_WP = on_world ? start.X_WM : states[parent].X_WB;
        Pose X_WJ = X_WP * inverse(X_MP) * joint.spec->X_MJ;
        Vec3 angular = on_world ? Vec3{} : states[parent].angular;
        Vec3 linear;  // of the joint's origin
        if (!on_world) {
            const Vec3 centre = states[parent].X_WB * assembly.bodies[parent].p_BC;
            linear = states[parent].v_WC + cross(angular, X_WJ.p - centre);
        }
        for (const AxisMotion& motion : motions(joint, start)) {
            const Vec3 axis_W = rotate(X_WJ.q, motion.axis_J);
            if (motion.slides) {
                X_WJ.p += axis_W * motion.state.position;
                linear += cross(angular, axis_W * motion.state.position) + axis_W * motion.state.velocity;
            } else {
                angular += axis_W * motion.state.velocity;
                X_WJ.q = X_WJ.q * axis_angle(motion.axis_J, motion.state.position);
            }
        }
        const Pose X_WB = X_WJ * inverse(joint.spec->X_MJ) * body.X_MB;
        states[b] = {X_WB, angular, linear + cross(angular, X_WB * body.p_BC - X_WJ.p)};
    }
    return states;
}

PrincipalAxes principal_axes(Mat3 m) {
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
    return {V, {m(0, 0), m(1, 1), m(2, 2)}};
}

bool is_common(JointSpecKind kind) {
    return kind == JointSpecKind::kFixed || kind == JointSpecKind::kRevolute ||
           kind == JointSpecKind::kContinuous || kind == JointSpecKind::kPrismatic ||
           kind == JointSpecKind::kBall;
}

bool has_chains(const World& world) {
    for (const ModelSpec& model : world.prototypes) {
        const Assembly assembly = assemble(model);
        for (const PartJoint& joint : assembly.joints)
            if (joint.parent >= 0 && assembly.bodies[static_cast<std::size_t>(joint.parent)].joint >= 0)
                return true;
    }
    return false;
}

Vec3 surface_velocity(const ModelSpec& model, const Pose& X_WM) {
    for (const OnboardSpec& spec : model.onboard)
        if (const auto* belt = std::get_if<SurfaceVelocitySpec>(&spec.parameters))
            return rotate(X_WM.q, belt->linear);
    return {};
}

bool has_belts(const World& world) {
    return std::any_of(world.prototypes.begin(), world.prototypes.end(),
                       [](const ModelSpec& model) { return norm_squared(surface_velocity(model, {})) > 0; });
}

double body_scale(const World& world) {
    double largest = 0;
    for (const ModelSpec& model : world.prototypes)
        for (const LinkSpec& link : model.links)
            for (const CollisionSpec& c : link.collisions) {
                const GeometrySpec& g = c.geometry;
                const double size = g.kind == GeometryKind::kBox ? std::max({g.size.x, g.size.y, g.size.z})
                                                                 : std::max(2 * g.radius, g.length);
                if (!model.is_static) largest = std::max(largest, size);
            }
    return largest < 0.5 ? 0.1 : 1;
}

LinkState link_of_body(const BodyState& body, const Vec3& p_BC, const Pose& X_BL, const Vec3& p_LC) {
    const Pose X_WL = body.X_WB * X_BL;
    const Vec3 offset = X_WL * p_LC - body.X_WB * p_BC;
    return {X_WL, body.angular, body.v_WC + cross(body.angular, offset)};
}

}  // namespace roboss::bench
