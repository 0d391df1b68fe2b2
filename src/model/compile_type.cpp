// Builds the dynamics tree of one robot: spanning tree over the joints, links welded into bodies, all poses
// taken at the zero configuration in the SDF model frame, where every joint frame coincides in parent and
// child.
#include <algorithm>
#include <cmath>
#include <optional>

#include "model/compile_type.h"

namespace roboss {
namespace {

constexpr double kUnlimited = 1e15;  // SDF writes 1e16 for "no limit"

/// An edge of the joint graph as the tree walks it; `reversed`: from the SDF child to the SDF parent.
struct Edge {
    std::size_t joint = 0;
    std::size_t to = 0;
    bool reversed = false;
};

/// The joint graph of a ModelSpec; node links.size() is the world.
struct Graph {
    std::vector<std::vector<Edge>> edges;
    std::size_t world = 0;
};

std::optional<std::size_t> link_index(const ModelSpec& spec, const std::string& name) {
    for (std::size_t i = 0; i < spec.links.size(); ++i)
        if (spec.links[i].name == name) return i;
    return std::nullopt;
}

Graph build_graph(const ModelSpec& spec) {
    Graph graph;
    graph.world = spec.links.size();
    graph.edges.resize(spec.links.size() + 1);
    for (std::size_t j = 0; j < spec.joints.size(); ++j) {
        const JointSpec& joint = spec.joints[j];
        if (joint.kind == JointSpecKind::kGearbox) continue;  // couples joints, connects nothing
        const auto child = link_index(spec, joint.child);
        const auto parent =
            joint.parent == "world" ? std::optional(graph.world) : link_index(spec, joint.parent);
        if (!child || !parent) continue;  // reported by validate()
        graph.edges[*parent].push_back({j, *child, false});
        graph.edges[*child].push_back({j, *parent, true});
    }
    return graph;
}

/// All links connected with `start` (not walking through the world), ascending; sets `touches_world`.
std::vector<std::size_t> connected_links(const Graph& graph, std::size_t start, std::vector<char>& seen,
                                         bool& touches_world) {
    std::vector<std::size_t> found{start};
    seen[start] = 1;
    touches_world = false;
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (const Edge& edge : graph.edges[found[i]]) {
            if (edge.to == graph.world) {
                touches_world = true;
            } else if (!seen[edge.to]) {
                seen[edge.to] = 1;
                found.push_back(edge.to);
            }
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// Builds one RobotType by walking the joint graph from its root.
class PartBuilder {
  public:
    PartBuilder(const ModelSpec& spec, const Graph& graph, Diagnostics& diagnostics)
        : spec_(spec), graph_(graph), diagnostics_(diagnostics) {}

    CompiledPart build(const std::vector<std::size_t>& links, bool fixed_base, bool is_main) {
        links_ = &links;
        RobotType& type = part_.type;
        type.name = spec_.name;
        type.free_base = !fixed_base;
        type.self_collide = spec_.self_collide;
        body_of_link_.assign(spec_.links.size() + 1, kUnplaced);
        X_MB_.clear();
        joint_done_.assign(spec_.joints.size(), 0);
        const std::size_t root = fixed_base ? graph_.world : pick_root();
        const std::size_t name_link = fixed_base ? links.front() : root;
        part_.suffix = is_main ? "" : "::" + spec_.links[name_link].name;
        if (fixed_base) {
            body_of_link_[root] = -1;
        } else {
            add_free_base(root, is_main);
        }
        walk(root);
        add_links();
        finish();
        return std::move(part_);
    }

  private:
    static constexpr int kUnplaced = -2;

    std::size_t pick_root() const {
        std::optional<std::size_t> orphan;
        for (std::size_t l : *links_) {
            const bool is_child = std::any_of(graph_.edges[l].begin(), graph_.edges[l].end(),
                                              [](const Edge& e) { return e.reversed; });
            if (is_child) continue;
            if (spec_.links[l].name == spec_.canonical_link) return l;
            if (!orphan) orphan = l;
        }
        return orphan ? *orphan : links_->front();
    }

    void add_free_base(std::size_t root, bool is_main) {
        Body body;
        body.nv = 6;
        const Pose& X_ML = spec_.links[root].X_ML;
        part_.X_MR = is_main ? Pose{} : X_ML;
        part_.type.X_RB = is_main ? to_transform(X_ML) : Transform{};
        part_.type.bodies.push_back(body);
        part_.type.nv = 6;
        part_.type.dof_parent = {-1, 0, 1, 2, 3, 4};
        X_MB_.push_back(to_transform(X_ML));
        body_of_link_[root] = 0;
    }

    /// Depth first, joints in file order; parents come before children in `bodies`.
    void walk(std::size_t node) {
        for (const Edge& edge : graph_.edges[node]) {
            if (joint_done_[edge.joint]) continue;
            if (node == graph_.world && !in_part(edge.to)) continue;
            joint_done_[edge.joint] = 1;
            if (body_of_link_[edge.to] != kUnplaced || edge.to == graph_.world) {
                close_loop(edge);
                continue;
            }
            body_of_link_[edge.to] = add_joint(edge, body_of_link_[node]);
            walk(edge.to);
        }
    }

    bool in_part(std::size_t link) const { return std::binary_search(links_->begin(), links_->end(), link); }

    void close_loop(const Edge& edge) {
        const JointSpec& joint = spec_.joints[edge.joint];
        diagnostics_.warning(
            joint.where, "kinematic-loop",
            "joint '" + joint.name + "' of model '" + spec_.name + "' closes a kinematic loop; it is ignored",
            "loops are still to come: open the loop or expect these links to move apart");
    }

    int add_joint(const Edge& edge, int parent_body) {
        const JointSpec& spec = spec_.joints[edge.joint];
        Joint joint;
        joint.name = spec.name;
        joint.kind = spec.kind;
        joint.reversed = edge.reversed;
        const JointId id(part_.type.joints.size());
        int body = parent_body;
        if (spec.kind == JointSpecKind::kBall) {
            body = add_body(parent_body, spec, JointKind::kBall, AxisSpec{}, edge.reversed, id, joint);
        } else if (spec.kind != JointSpecKind::kFixed && spec.kind != JointSpecKind::kScrew) {
            const JointKind kind =
                spec.kind == JointSpecKind::kPrismatic ? JointKind::kPrismatic : JointKind::kRevolute;
            const std::size_t axes =
                spec.kind == JointSpecKind::kUniversal || spec.kind == JointSpecKind::kRevolute2 ? 2 : 1;
            for (std::size_t a = 0; a < axes && a < spec.axes.size(); ++a) {
                const std::size_t pick = edge.reversed ? std::min(axes, spec.axes.size()) - 1 - a : a;
                body = add_body(body, spec, kind, spec.axes[pick], edge.reversed, id, joint);
            }
        }
        joint.body = body == parent_body ? -1 : body;
        part_.type.joints.push_back(joint);
        return body;
    }

    int add_body(int parent, const JointSpec& spec, JointKind kind, const AxisSpec& axis, bool reversed,
                 JointId id, Joint& joint) {
        RobotType& type = part_.type;
        const Transform X_MJ = to_transform(spec.X_MJ);
        Body body;
        body.parent = parent;
        body.joint = kind;
        body.X_PJ = parent < 0 ? X_MJ : inverse(X_MB_[static_cast<std::size_t>(parent)]) * X_MJ;
        body.axis_J = reversed ? -axis.xyz : axis.xyz;
        body.q_index = type.nq;
        body.v_index = type.nv;
        body.nv = kind == JointKind::kBall ? 3 : 1;
        if (joint.v_index < 0) joint.q_index = body.q_index, joint.v_index = body.v_index;
        joint.nv += body.nv;
        const int index = static_cast<int>(type.bodies.size());
        const int parent_dof = parent < 0 ? -1 : last_dof(type.bodies[static_cast<std::size_t>(parent)]);
        for (int k = 0; k < body.nv; ++k) {
            type.dof_parent.push_back(k == 0 ? parent_dof : type.nv + k - 1);
            type.dofs.push_back(to_dof(axis, kind, spec.kind == JointSpecKind::kContinuous, index, id));
        }
        if (kind == JointKind::kBall) {
            type.initial_q.insert(type.initial_q.end(), {1.0, 0.0, 0.0, 0.0});
        } else {
            type.initial_q.push_back(axis.initial_position);
        }
        type.nq += kind == JointKind::kBall ? 4 : 1;
        type.nv += body.nv;
        type.bodies.push_back(body);
        X_MB_.push_back(X_MJ);
        return index;
    }

    static int last_dof(const Body& body) { return body.v_index + body.nv - 1; }

    static Dof to_dof(const AxisSpec& axis, JointKind kind, bool continuous, int body, JointId id) {
        Dof dof;
        dof.body = body;
        dof.joint = id;
        dof.damping = axis.damping;
        dof.friction = axis.friction;
        dof.armature = axis.armature;
        if (kind == JointKind::kBall) return dof;
        if (!continuous && axis.lower > -kUnlimited) dof.lower = axis.lower;
        if (!continuous && axis.upper < kUnlimited) dof.upper = axis.upper;
        if (axis.max_effort >= 0 && axis.max_effort < kUnlimited) dof.max_effort = axis.max_effort;
        if (axis.max_velocity >= 0 && axis.max_velocity < kUnlimited) dof.max_velocity = axis.max_velocity;
        dof.spring_stiffness = axis.spring_stiffness;
        dof.spring_reference = axis.spring_reference;
        dof.position_gain = axis.position_gain;
        dof.velocity_gain = axis.velocity_gain;
        return dof;
    }

    void add_links() {
        for (std::size_t l : *links_) {
            const LinkSpec& spec = spec_.links[l];
            const int body = body_of_link_[l];
            Link link;
            link.name = spec.name;
            link.body = body;
            link.X_BL = body < 0 ? to_transform(spec.X_ML)
                                 : inverse(X_MB_[static_cast<std::size_t>(body)]) * to_transform(spec.X_ML);
            link.p_BC = link.X_BL * spec.p_LC;
            const LinkId id(part_.type.links.size());
            if (body >= 0) add_mass(part_.type.bodies[static_cast<std::size_t>(body)], spec, link.X_BL);
            add_shapes(spec, link, id);
            if (spec.drag.acts && body >= 0)
                part_.type.drags.push_back(
                    {body, link.p_BC, link.X_BL.R, drag_area(spec), spec.drag.linear, spec.drag.wind});
            for (const SensorSpec& sensor : spec.sensors) part_.type.sensors.push_back({sensor, id});
            part_.type.links.push_back(link);
        }
    }

    /// Adds a link's inertia to its body: common centre of mass, parallel-axis theorem for both.
    static void add_mass(Body& body, const LinkSpec& link, const Transform& X_BL) {
        const Vec3 p_BC = X_BL * link.p_LC;
        const Mat3 inertia = X_BL.R * link.inertia_C * transpose(X_BL.R);
        const double total = body.mass + link.mass;
        if (total <= 0) return;
        const Vec3 centre = (body.p_BC * body.mass + p_BC * link.mass) * (1.0 / total);
        body.inertia_C = body.inertia_C + point_inertia(body.mass, body.p_BC - centre) + inertia +
                         point_inertia(link.mass, p_BC - centre);
        if (link.gravity && link.mass > 0) {
            const double felt = body.gravity_mass + link.mass;
            body.p_BG = (body.p_BG * body.gravity_mass + p_BC * link.mass) * (1.0 / felt);
            body.gravity_mass = felt;
        }
        body.p_BC = centre;
        body.mass = total;
    }

    static Mat3 point_inertia(double mass, const Vec3& d) {
        const double dd = norm_squared(d);
        return Mat3{{dd - d.x * d.x, -d.x * d.y, -d.x * d.z},
                    {-d.x * d.y, dd - d.y * d.y, -d.y * d.z},
                    {-d.x * d.z, -d.y * d.z, dd - d.z * d.z}} *
               mass;
    }

    void add_shapes(const LinkSpec& spec, const Link& link, LinkId id) {
        for (const CollisionSpec& collision : spec.collisions) {
            BodyShape shape;
            if (!to_shape(collision.geometry, shape.shape)) continue;
            shape.body = link.body;
            shape.link = id;
            shape.X_BS = link.X_BL * to_transform(collision.X_LS);
            shape.material = to_material(collision.surface);
            part_.type.shapes.push_back(shape);
        }
    }

    void finish() {
        RobotType& type = part_.type;
        for (const Body& body : type.bodies) type.mass += body.mass;
        type.reach = reach();
        if (type.self_collide) add_self_pairs();
        compute_mobility(type);
        type.hash = type_hash(type);
    }

    double reach() const {
        const RobotType& type = part_.type;
        std::vector<double> extent(type.bodies.size() + 1, 0.0);  // [0]: base frame, [1 + b]: body b
        for (const BodyShape& s : type.shapes) {
            double& e = extent[static_cast<std::size_t>(s.body + 1)];
            e = std::max(e, norm(s.X_BS.p) + bounding_radius(s.shape));
        }
        for (std::size_t b = type.bodies.size(); b-- > 0;) {
            const Body& body = type.bodies[b];
            if (body.joint == JointKind::kFree) continue;
            double slide = 0;
            if (body.joint == JointKind::kPrismatic) {
                const Dof& dof = type.dofs[static_cast<std::size_t>(body.v_index - type.base_nv())];
                slide = std::max(std::fabs(dof.lower), std::fabs(dof.upper));
            }
            double& e = extent[static_cast<std::size_t>(body.parent + 1)];
            e = std::max(e, norm(body.X_PJ.p) + slide + extent[b + 1]);
        }
        return std::max(extent[0], extent.size() > 1 && type.free_base ? extent[1] : 0.0);
    }

    void add_self_pairs() {
        RobotType& type = part_.type;
        const auto parent = [&](int b) {
            return b < 0 ? -2 : type.bodies[static_cast<std::size_t>(b)].parent;
        };
        for (std::size_t a = 0; a < type.shapes.size(); ++a) {
            for (std::size_t b = a + 1; b < type.shapes.size(); ++b) {
                const int ba = type.shapes[a].body, bb = type.shapes[b].body;
                if (ba == bb || parent(ba) == bb || parent(bb) == ba) continue;
                type.self_pairs.emplace_back(static_cast<int>(a), static_cast<int>(b));
            }
        }
    }

    const ModelSpec& spec_;
    const Graph& graph_;
    Diagnostics& diagnostics_;
    CompiledPart part_;
    const std::vector<std::size_t>* links_ = nullptr;
    std::vector<int> body_of_link_;  // last: the world
    std::vector<Transform> X_MB_;    // body frames in the model frame at the zero configuration
    std::vector<char> joint_done_;
};

}  // namespace

bool to_shape(const GeometrySpec& geometry, Shape& shape) {
    shape.radius = geometry.radius;
    shape.half_length = 0.5 * geometry.length;
    shape.half = geometry.size * 0.5;
    switch (geometry.kind) {
        case GeometryKind::kPlane:
            shape.kind = ShapeKind::kPlane;
            return true;
        case GeometryKind::kBox:
            shape.kind = ShapeKind::kBox;
            return true;
        case GeometryKind::kSphere:
            shape.kind = ShapeKind::kSphere;
            return true;
        case GeometryKind::kCylinder:
            shape.kind = ShapeKind::kCylinder;
            return true;
        case GeometryKind::kCapsule:
            shape.kind = ShapeKind::kCapsule;
            return true;
        default:
            return false;
    }
}

RobotType sensor_stand(const ModelSpec& spec) {
    RobotType type;
    type.name = spec.name;
    type.free_base = false;
    type.is_static = true;
    for (const LinkSpec& link : spec.links) {
        const LinkId id(type.links.size());
        const Transform X_BL = to_transform(link.X_ML);
        type.links.push_back({link.name, -1, X_BL, X_BL * link.p_LC});
        for (const SensorSpec& sensor : link.sensors) type.sensors.push_back({sensor, id});
    }
    type.hash = type_hash(type);
    return type;
}

std::vector<CompiledPart> compile_parts(const ModelSpec& spec, Diagnostics& diagnostics) {
    const Graph graph = build_graph(spec);
    std::vector<char> seen(spec.links.size(), 0);
    std::vector<CompiledPart> parts;
    for (std::size_t l = 0; l < spec.links.size(); ++l) {
        if (seen[l]) continue;
        bool fixed_base = false;
        const std::vector<std::size_t> links = connected_links(graph, l, seen, fixed_base);
        const bool is_main = std::any_of(links.begin(), links.end(), [&](std::size_t i) {
            return spec.links[i].name == spec.canonical_link;
        });
        parts.push_back(PartBuilder(spec, graph, diagnostics)
                            .build(links, fixed_base, is_main || spec.canonical_link.empty()));
    }
    const bool has_main =
        std::any_of(parts.begin(), parts.end(), [](const CompiledPart& p) { return p.suffix.empty(); });
    if (!has_main && !parts.empty()) parts.front().suffix.clear();
    if (parts.size() > 1)
        diagnostics.note(spec.where, "unconnected-parts",
                         "model '" + spec.name + "' has " + std::to_string(parts.size()) +
                             " parts that no joint connects; each is a robot of its own (" + spec.name +
                             parts.back().suffix + " ...)",
                         "connect them with a fixed joint if they are one body");
    return parts;
}

}  // namespace roboss
